"""The moons of the scene roche-limit: figures of fluid under gravity, tide and turn, by a fourth-order method.

    P" = (w^2 (3 n n - 1) - 4 pi G rho K) P + l P^-T,   n = (cos wt, sin wt, 0),   l such that det P stays

K has the values int_0^oo du/(2 (a_i^2 + u) D) in the axes of P P^T. Prints the long axis at the end, in radii, with half
the steps too. P turns about z alone: [[a, b], [c, d]] and z.
"""

from math import atan2, cos, pi, sin, sqrt

GRAVITY = pi * 6.674e-11 * 1000
START = [1.59431732125, 0.0, 0.0, 0.815242689947, 0.769375446375]
END = 32400


def rd(x, y, z):
    """Carlson's R_D."""
    total, factor = 0.0, 1.0
    while max(abs(x - y), abs(x - z)) > 1e-4 * x:
        shift = sqrt(x * y) + sqrt(y * z) + sqrt(z * x)
        total += factor / (sqrt(z) * (z + shift))
        factor /= 4
        x, y, z = (x + shift) / 4, (y + shift) / 4, (z + shift) / 4
    mean = (x + y + 3 * z) / 5
    dx, dy = (mean - x) / mean, (mean - y) / mean
    dz = -(dx + dy) / 3
    second = dx * dy - 6 * dz * dz
    return 3 * total + factor * (1 - 3 * second / 14) / mean**1.5


def potential(p):
    """K as (xx, xy, yy, zz)."""
    a, b, c, d, z = p
    xx, yy, xy = a * a + b * b, c * c + d * d, a * c + b * d
    angle = atan2(2 * xy, xx - yy) / 2
    cosine, sine = cos(angle), sin(angle)
    one = cosine**2 * xx + 2 * cosine * sine * xy + sine**2 * yy
    two, three = xx + yy - one, z * z
    k = rd(two, three, one) / 3, rd(three, one, two) / 3, rd(one, two, three) / 3
    mixed = cosine * sine * (k[0] - k[1])
    return cosine**2 * k[0] + sine**2 * k[1], mixed, sine**2 * k[0] + cosine**2 * k[1], k[2]


def acceleration(time, p, v, w):
    a, b, c, d, z = p
    n, k = (cos(w * time), sin(w * time)), potential(p)
    square, pull = w * w, 4 * GRAVITY
    xx, xy = square * (3 * n[0] ** 2 - 1) - pull * k[0], square * 3 * n[0] * n[1] - pull * k[1]
    yy, zz = square * (3 * n[1] ** 2 - 1) - pull * k[2], -square - pull * k[3]
    force = [xx * a + xy * c, xx * b + xy * d, xy * a + yy * c, xy * b + yy * d, zz * z]
    area = a * d - b * c
    across = [d / area, -c / area, -b / area, a / area, 1 / z]
    # L = P' P^-1.
    lxx, lxy = (v[0] * d - v[1] * c) / area, (v[1] * a - v[0] * b) / area
    lyx, lyy = (v[2] * d - v[3] * c) / area, (v[3] * a - v[2] * b) / area
    asked = lxx**2 + 2 * lxy * lyx + lyy**2 + (v[4] / z) ** 2
    push = (asked - sum(f * x for f, x in zip(force, across))) / sum(x * x for x in across)
    return [f + push * x for f, x in zip(force, across)]


def long_axis(w, steps):
    p = START
    y = p + [-w * p[2], -w * p[3], w * p[0], w * p[1], 0.0]
    h = END / steps
    for step in range(steps):
        rate = lambda t, y: y[5:] + acceleration(t, y[:5], y[5:], w)
        along = lambda k, f: [u + f * x for u, x in zip(y, k)]
        t = step * h
        first = rate(t, y)
        second = rate(t + h / 2, along(first, h / 2))
        third = rate(t + h / 2, along(second, h / 2))
        fourth = rate(t + h, along(third, h))
        y = [u + h / 6 * (a + 2 * b + 2 * c + d) for u, a, b, c, d in zip(y, first, second, third, fourth)]
    a, b, c, d, _ = y[:5]
    square, area = a * a + b * b + c * c + d * d, a * d - b * c
    return sqrt((square + sqrt(square**2 - 4 * area**2)) / 2)


for name, w in (("outer", 0.000135404000035), ("inner", 0.000139527805288)):
    print(name, [f"{long_axis(w, steps):.12f}" for steps in (4000, 8000)])
