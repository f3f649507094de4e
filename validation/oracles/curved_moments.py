"""High-precision moments of d^-nu and ln d over curved surfaces, for crates/gyration/tests/curved_moments.rs.

Formulation, on purpose not that of the code. Bodies of revolution: the azimuth first, in closed form,

  a - b cos(phi) = l (1 - 2 q cos(phi) + q^2),  l = (a + s)/2,  q = b/(a + s),  s^2 = a^2 - b^2,
  integral of cos(n phi) (1 - 2 q cos(phi) + q^2)^-nu dphi
    = 2 pi ((nu)_n/n!) q^n (1 - q^2)^(1 - 2 nu) 2F1(1 - nu, n + 1 - nu; n + 1; q^2)

then the meridian by Gauss-Legendre on panels that shrink towards the nearest point. A triaxial ellipsoid: by spherical
angles about its longest axis (the code's are about the lowest point), with such panels and a trapezoid in azimuth,
doubled until the values stand still.

Usage: python3 curved_moments.py > ../../crates/gyration/tests/data/curved_moments.csv     (needs mpmath; some minutes)
"""

import itertools

from mpmath import atan2, cos, factorial, hyp2f1, hypot, log, matrix, mp, mpf, pi, rf, sin, sqrt

mp.dps = 22
POINTS = 28
MONOMIALS = [()] + [(i,) for i in range(3)]
MONOMIALS += list(itertools.combinations_with_replacement(range(3), 2))
MONOMIALS += list(itertools.combinations_with_replacement(range(3), 3))


def harmonics(kernel, a, b):
    """Integrals of kappa(a - b cos phi) cos(n phi) over the circle, n = 0 .. 3."""
    s = sqrt(a * a - b * b)
    scale, q = (a + s) / 2, b / (a + s)
    if kernel == "log":
        return [2 * pi * log(scale)] + [-2 * pi * q**n / n for n in (1, 2, 3)]
    nu = mpf(kernel)
    front = 2 * pi * scale**-nu * (1 - q * q) ** (1 - 2 * nu)
    return [front * rf(nu, n) / factorial(n) * q**n * hyp2f1(1 - nu, n + 1 - nu, n + 1, q * q) for n in range(4)]


def ring(kernel, a, b, rho, z):
    """Moments over the circle (rho cos phi, rho sin phi, z), per radian of phi, in the order of MONOMIALS."""
    h = harmonics(kernel, a, b)
    c = [h[0], h[1], (h[0] + h[2]) / 2, (3 * h[1] + h[3]) / 4]
    values = []
    for monomial in MONOMIALS:
        x, y, k = (monomial.count(axis) for axis in range(3))
        if y % 2:
            values.append(mpf(0))
        else:
            trig = c[x] if y == 0 else c[x] - c[x + 2]
            values.append(trig * rho ** (x + y) * z**k)
    return matrix(values)


def revolution(kernel, height, m, meridian, ends, peaks, finest):
    """Moments over a surface of revolution; meridian(t) = (rho, z, dA/(dt dphi))."""
    across = hypot(m[0], m[1])

    def integrand(t):
        rho, z, area = meridian(t)
        return area * ring(kernel, height + m[2] * z, across * rho, rho, z)

    points = {ends[0], ends[1]}
    for peak in peaks:
        width = ends[1] - ends[0]
        while width > finest:
            points.update(p for p in (peak - width, peak + width) if ends[0] < p < ends[1])
            width /= 4
        if ends[0] < peak < ends[1]:
            points.add(peak)
    total = matrix([0] * len(MONOMIALS))
    points = sorted(points)
    for left, right in zip(points, points[1:]):
        total += vector_quad(integrand, left, right)
    # e_x of the computation points where the gap falls.
    angle = atan2(-m[1], -m[0]) if across else mpf(0)
    return turned(total, angle)


NODES = []


def legendre(x):
    """P_n and its derivative, n = POINTS."""
    before, value = mpf(1), x
    for k in range(2, POINTS + 1):
        before, value = value, ((2 * k - 1) * x * value - (k - 1) * before) / k
    return value, POINTS * (x * value - before) / (x * x - 1)


def vector_quad(f, left, right):
    """Gauss-Legendre, 28 points: singularities stay a panel's width away, so that some 18 digits are right."""
    if not NODES:
        for k in range(POINTS):
            x = cos(pi * (k + mpf(3) / 4) / (POINTS + mpf(1) / 2))
            for _ in range(6):
                value, slope = legendre(x)
                x -= value / slope
            NODES.append((x, 2 / ((1 - x * x) * legendre(x)[1] ** 2)))
    half, middle = (right - left) / 2, (right + left) / 2
    total = matrix([0] * len(MONOMIALS))
    for x, w in NODES:
        total += w * half * f(middle + half * x)
    return total


def turned(values, angle):
    """The moments after a rotation by `angle` about z."""
    c, s = cos(angle), sin(angle)
    rotation = [[c, -s, 0], [s, c, 0], [0, 0, 1]]
    given = {monomial: values[i] for i, monomial in enumerate(MONOMIALS)}
    result = []
    for monomial in MONOMIALS:
        total = mpf(0)
        for source in itertools.product(range(3), repeat=len(monomial)):
            weight = mpf(1)
            for i, j in zip(monomial, source):
                weight *= rotation[i][j]
            if weight:
                total += weight * given[tuple(sorted(source))]
        result.append(total)
    return matrix(result)


def cylinder(kernel, g, m, p, eps):
    r, h = p
    wall = revolution(kernel, g, m, lambda t: (r, t, r), (-h / 2, h / 2), (-h / 2, h / 2), h * eps)
    for z in (-h / 2, h / 2):
        wall += revolution(kernel, g, m, lambda t: (t, z, t), (mpf(0), r), (r,), r * eps)
    return wall


def cone(kernel, g, m, p, eps):
    r, h = p
    slant = hypot(r, h)
    wall = lambda t: (r * t, h / 2 - h * t, slant * r * t)
    total = revolution(kernel, g, m, wall, (mpf(0), mpf(1)), (mpf(0), mpf(1)), eps)
    return total + revolution(kernel, g, m, lambda t: (t, -h / 2, t), (mpf(0), r), (r,), r * eps)


def capsule(kernel, g, m, p, eps):
    r, h = p
    total = revolution(kernel, g, m, lambda t: (r, t, r), (-h / 2, h / 2), (-h / 2, h / 2), h * eps)
    lowest = atan2(hypot(m[0], m[1]), abs(m[2]))
    for side in (-1, 1):
        cap = lambda t: (r * sin(t), side * (h / 2 + r * cos(t)), r * r * sin(t))
        total += revolution(kernel, g, m, cap, (mpf(0), pi / 2), (lowest, pi / 2), sqrt(eps) / 4)
    return total


def torus(kernel, g, m, p, eps):
    big, small = p
    lowest = atan2(-m[2], hypot(m[0], m[1]))
    tube = lambda t: (big + small * cos(t), small * sin(t), small * (big + small * cos(t)))
    peaks = (lowest, pi - lowest, -pi - lowest)
    return revolution(kernel, g, m, tube, (lowest - pi, lowest + pi), peaks, sqrt(eps) / 4)


def spheroid(kernel, g, m, p, eps):
    a, c = p
    lowest = atan2(a * hypot(m[0], m[1]), -c * m[2])
    area = lambda t: a * sin(t) * sqrt((a * cos(t)) ** 2 + (c * sin(t)) ** 2)
    meridian = lambda t: (a * sin(t), c * cos(t), area(t))
    width = min(a, c) / max(a, c)
    return revolution(kernel, g, m, meridian, (mpf(0), pi), (lowest, pi / 2, mpf(0), pi), min(sqrt(eps), width) / 4)


def sphere(kernel, g, m, p, eps):
    return spheroid(kernel, g, m, (p[0], p[0]), eps)


def ellipsoid(kernel, g, m, p, eps):
    """By spherical angles about the first, longest axis: X = A s, dA = |cof(A) s| dOmega."""
    axes = [mpf(x) for x in p]
    cofactor = [axes[1] * axes[2], axes[2] * axes[0], axes[0] * axes[1]]

    def point(w, s):
        x = [a * v for a, v in zip(axes, s)]
        d = g + sum(u * v for u, v in zip(m, x))
        w *= (log(d) if kernel == "log" else d ** -mpf(kernel)) * sqrt(sum((b * v) ** 2 for b, v in zip(cofactor, s)))
        return matrix([w] + [w * product(x[i] for i in monomial) for monomial in MONOMIALS[1:]])

    def circle(theta, count, shift):
        total = matrix([0] * len(MONOMIALS))
        sine, cosine = sin(theta), cos(theta)
        for k in range(count):
            phi = 2 * pi * (k + shift) / count
            total += point(2 * pi * sine / count, [cosine, sine * cos(phi), sine * sin(phi)])
        return total

    def settled(theta):
        # Doubling adds the points halfway between; the last change is about the square root of the error that is left.
        count, value = 16, circle(theta, 16, mpf(0))
        while True:
            finer = (value + circle(theta, count, mpf(1) / 2)) / 2
            largest = max(abs(v) for v in finer)
            if max(abs(v) for v in finer - value) <= mpf("1e-9") * largest:
                return finer
            count, value = 2 * count, finer

    image = [a * x for a, x in zip(axes, m)]
    lowest = atan2(hypot(image[1], image[2]), -image[0])
    finest = min(sqrt(eps), min(axes) / max(axes)) / 2
    points = {mpf(0), pi}
    for peak in (mpf(0), lowest, pi):
        width = pi
        while width > finest:
            points.update(x for x in (peak - width, peak + width) if 0 < x < pi)
            width /= 3
    points = sorted(points)
    total = matrix([0] * len(MONOMIALS))
    for left, right in zip(points, points[1:]):
        total += vector_quad(settled, left, right)
    return total


def product(factors):
    result = mpf(1)
    for factor in factors:
        result *= factor
    return result


def support(shape, p, m):
    """max -m.X, to place the body at a wanted gap."""
    across, along = hypot(m[0], m[1]), abs(m[2])
    if shape == "cylinder":
        return p[0] * across + p[1] / 2 * along
    if shape == "cone":
        return max(-m[2] * p[1] / 2, p[0] * across + m[2] * p[1] / 2)
    if shape == "capsule":
        return p[0] * hypot(across, along) + p[1] / 2 * along
    if shape == "torus":
        return p[0] * across + p[1] * hypot(across, along)
    axes = {"sphere": (p[0],) * 3, "spheroid": (p[0], p[0], p[-1]), "ellipsoid": p}[shape]
    return sqrt(sum((a * x) ** 2 for a, x in zip(axes, m)))


FUNCTIONS = dict(sphere=sphere, spheroid=spheroid, cylinder=cylinder, cone=cone, capsule=capsule, torus=torus,
                 ellipsoid=ellipsoid)
KERNELS = ["6", "3", "12", "1", "2.5", "4", "0", "13", "-1", "7.3", "log", "2", "0.5", "9.75", "8", "1.25"]
GAPS = [1e-4, 1e-3, 0.03, 0.4, 5.0]
# Axis up, down, lying, nearly lying, nearly upright, tilted, and deformed (|m| is then not 1).
DIRECTIONS = [(0, 0, 1), (0, 0, -1), (0.8, -0.6, 0), (0.6, 0.8, 1e-3), (1e-3, 0, 1), (0.48, 0.36, 0.8),
              (-0.3, 0.5, -0.9), (0.7, 0, -0.72)]
SHAPES = [("sphere", (0.5,), 1), ("cylinder", (0.5, 1.0), 2), ("cylinder", (0.5, 0.05), 1), ("cone", (0.4, 1.0), 2),
          ("capsule", (0.25, 0.5), 2), ("torus", (0.35, 0.15), 2), ("torus", (0.48, 0.02), 1),
          ("spheroid", (0.5, 0.3), 1), ("spheroid", (0.5, 0.05), 1), ("spheroid", (0.05, 0.5), 1)]


def write(shape, p, kernel, gap, m):
    m = [mpf(float(x)) for x in m]
    g = mpf(float(gap + support(shape, [mpf(x) for x in p], m)))
    values = FUNCTIONS[shape](kernel, g, m, [mpf(x) for x in p], mpf(gap))
    numbers = [*p, *[0.0] * (3 - len(p))]
    row = [shape, *map(repr, numbers), kernel, repr(float(g)), *(repr(float(x)) for x in m)]
    row += [mp.nstr(v, 15) if v else "0" for v in values]
    print(",".join(row), flush=True)


def main():
    names = ["shape", "p1", "p2", "p3", "kernel", "height", "mx", "my", "mz"]
    print(",".join(names + ["A" + "".join("xyz"[i] for i in monomial) for monomial in MONOMIALS]))
    turn = 0
    for shape, p, repeats in SHAPES:
        for m in DIRECTIONS[::3] if shape == "sphere" else DIRECTIONS:
            for gap in GAPS[: 5 if repeats == 2 or shape == "sphere" else 4]:
                write(shape, p, KERNELS[turn % len(KERNELS)], gap, m)
                turn += 1
    for p, gap, m in [((0.5, 0.35, 0.2), 0.03, (0.48, 0.36, 0.8)), ((0.5, 0.35, 0.2), 1e-3, (0.7, 0.1, -0.72)),
                      ((0.2, 0.03, 0.02), 0.01, (0.1, -0.05, 0.99)), ((0.5, 0.35, 0.2), 0.4, (-0.3, 0.5, -0.9))]:
        for kernel in ("6", "2.5", "1"):
            write("ellipsoid", p, kernel, gap, m)


if __name__ == "__main__":
    main()
