"""Reference values for the moments of a power of the gap over flat facets.

Needs mpmath. Writes crates/gyration/tests/data/facet_kernel.csv and facet_moments.csv:

    python3 validation/oracles/facet_moments.py crates/gyration/tests/data

Method: Hermite-Genocchi. Over a triangle with corner gaps d0, d1, d2 and |a| = a0 + a1 + a2,

    int l0^a0 l1^a1 l2^a2 kappa(d) dA = 2 A a0! a1! a2! g[d0^(a0+1), d1^(a1+1), d2^(a2+1)],   g^(|a|+2) = kappa,

the divided difference with each gap repeated as shown; the same formula with two gaps serves the segment. Repeated nodes are moved
apart and exponents moved off the integers by a relative 1e-40, and 420 digits absorb the cancellation of the differences
and of the polynomials that they annihilate. This is another route than the program's, which splits the triangle and recurs.

Inputs are dyadic rationals for which the gaps are exact in double precision (asserted), so that the comparison
measures the integrals and not the rounding of g0 + m.X.
"""

import csv
import itertools
import random
import sys
from fractions import Fraction
from math import factorial
from pathlib import Path

from mpmath import log, mp, mpf, nstr, quad

mp.dps = 420
APART = mpf(10) ** -40


def as_mpf(x):
    """A float or a fraction, without rounding beyond the working precision."""
    x = Fraction(x)
    return mpf(x.numerator) / x.denominator


class Antiderivative:
    """g with g^(order) = kappa; `kernel` is an exponent nu of d^-nu or the word log."""

    def __init__(self, kernel, order):
        # ln d is the limit of (d^s - 1)/s, s -> 0; the constant is annihilated but for the order-th derivative.
        self.log = kernel == "log"
        self.power = APART if self.log else -(as_mpf(kernel) + APART)
        self.order = order
        self.factor = mpf(1)
        for i in range(1, order + 1):
            self.factor *= self.power + i

    def __call__(self, d):
        value = d ** (self.power + self.order) / self.factor
        if self.log:
            value = (value - d**self.order / factorial(self.order)) / self.power
        return value


def divided_difference(function, nodes):
    """The divided difference over nodes, moved apart where they coincide."""
    nodes = [d * (1 + i * APART) for i, d in enumerate(sorted(nodes))]
    table = [function(d) for d in nodes]
    for width in range(1, len(nodes)):
        for i in range(len(nodes) - width):
            table[i] = (table[i + 1] - table[i]) / (nodes[i + width] - nodes[i])
    return table[0]


def segment(kernel, c, e, k):
    """int_0^1 x^k kappa(c + (e - c) x) dx."""
    nodes = [as_mpf(c)] + [as_mpf(e)] * (k + 1)
    return factorial(k) * divided_difference(Antiderivative(kernel, k + 1), nodes)


def triangle_weights(kernel, gaps, n):
    """{a: int l^a kappa dA / 2A} over all a with |a| = n."""
    function = Antiderivative(kernel, n + 2)
    weights = {}
    for a in itertools.product(range(n + 1), repeat=3):
        if sum(a) == n:
            nodes = [gaps[i] for i in range(3) for _ in range(a[i] + 1)]
            scale = factorial(a[0]) * factorial(a[1]) * factorial(a[2])
            weights[a] = scale * divided_difference(function, nodes)
    return weights


COMPONENTS = [[()]] + [list(itertools.combinations_with_replacement(range(3), n)) for n in (1, 2, 3)]


def moments(kernel, triangles, height, direction):
    """A0, A1, A2 (6), A3 (10) over triangles given by their corners."""
    sums = [mpf(0)] * 20
    for corners in triangles:
        points = [[as_mpf(x) for x in corner] for corner in corners]
        gaps = [as_mpf(exact_gap(height, direction, corner)) for corner in corners]
        e1 = [points[1][i] - points[0][i] for i in range(3)]
        e2 = [points[2][i] - points[0][i] for i in range(3)]
        cross = [e1[i - 2] * e2[i - 1] - e1[i - 1] * e2[i - 2] for i in range(3)]
        twice_area = sum(x * x for x in cross) ** mpf("0.5")
        place = 0
        for n in range(4):
            weights = triangle_weights(kernel, gaps, n)
            for component in COMPONENTS[n]:
                total = mpf(0)
                for choice in itertools.product(range(3), repeat=n):
                    term = weights[tuple(choice.count(v) for v in range(3))]
                    for axis, vertex in zip(component, choice):
                        term *= points[vertex][axis]
                    total += term
                sums[place] += twice_area * total
                place += 1
    return sums


def exact_gap(height, direction, point):
    """The gap; asserts that double precision gives the same."""
    exact = Fraction(height) + sum(Fraction(m) * Fraction(x) for m, x in zip(direction, point))
    (mx, my, mz), (x, y, z) = direction, point
    rounded = height + ((mx * x + my * y) + mz * z)
    assert Fraction(rounded) == exact and exact > 0, (height, direction, point)
    return exact


def dyadic(x, bits):
    return round(x * 2**bits) / 2.0**bits


def box(edges):
    a, b, c = (x / 2 for x in edges)
    p = [(x, y, z) for x in (-a, a) for y in (-b, b) for z in (-c, c)]
    quads = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    return [[p[q[i]] for i in t] for q in quads for t in ((0, 1, 2), (0, 2, 3))]


EXPONENTS = [1.0, 1 + 1e-12, 1.01, 1.5, 2.0, 2 - 1e-9, 2.5, 3.0, 3 + 1e-6, 3.49, 3.51, 4.0, 4 + 1e-3, 4.7, 5.0, 5 - 1e-12,
             6.0, 6.3, 7.0, 7.5, 8.0, 9.25, 10.0, 12.0, 12.6, 14.0, 16.0, 15.9, 17.0, 16.7, 0.0, 0.3, -0.5, -1.0, "log"]
GAPS = [1e-6, 1e-4, 1e-2, 0.1, 0.6, 3.0, 1e3]
TILTS = ["generic", "generic", "flat", 1e-3, 1e-6, 1e-10, 1e-14, "edge", "vertex"]


def direction_of(tilt, draw):
    if tilt == "flat":
        return (0.0, 0.0, 1.0)
    if tilt == "edge":
        return (0.0, 0.6015625, 0.798828125)
    if tilt == "vertex":
        return (0.577392578125, 0.5771484375, 0.577392578125)
    if tilt == "generic":
        v = [draw.gauss(0, 1) for _ in range(3)]
        r = sum(x * x for x in v) ** 0.5
        return tuple(dyadic(x / r, 20) for x in v)
    bits = 20 if tilt > 1e-6 else 46
    return (dyadic(tilt, bits), dyadic(-0.7 * tilt, bits), 1.0)


def cases(count):
    """Rows of the table: kernel, shape, triangles, height, direction."""
    draw = random.Random(7)
    for i in range(count):
        kernel = EXPONENTS[i % len(EXPONENTS)]
        tilt = TILTS[(i // 2) % len(TILTS)]
        gap = GAPS[(i // 3) % len(GAPS)]
        # Small tilts need coarse coordinates for their products to be exact.
        bits = 5 if isinstance(tilt, float) and tilt <= 1e-6 else 9
        if i % 2 == 0:
            numbers = [dyadic(draw.uniform(-0.4, 0.4), bits) for _ in range(9)]
            if isinstance(tilt, float) or tilt == "flat":
                numbers[2] = numbers[5] = numbers[8] = -0.25
            triangles = [[tuple(numbers[j : j + 3]) for j in (0, 3, 6)]]
        else:
            numbers = [dyadic(draw.uniform(0.1, 0.8), bits) + 2.0**-bits for _ in range(3)]
            triangles = box(numbers)
        direction = direction_of(tilt, draw)
        lowest = min(sum(m * x for m, x in zip(direction, p)) for t in triangles for p in t)
        if isinstance(tilt, float) and tilt <= 1e-6:
            gap = min(gap, 0.6)  # a tilt of 1e-14 is below the rounding of larger gaps
        if kernel == "log" and 0.02 < gap < 1:
            gap = 1e-2  # ln d keeps its sign, so that its integral is also that of |ln d|
        height = dyadic(gap, 50 if gap < 2 else 40) - lowest
        yield kernel, numbers, triangles, height, direction


def write_kernel(path):
    ratios = [1.0, 1 + 2.0**-50, 1 + 1e-9, 1.0003, 1.01, 1.1, 1.25, 1.4, 1.6, 1.7, 1.74, 1.8, 1.87, 2.1, 2.9, 3.6, 6.0, 30.0, 1e3, 1e6, 1e9]
    exponents = EXPONENTS + [4 - 1e-7, 6 - 1e-10, 2.26, 3.26, 3.74, 4.26, 5.26, 11.0]
    with path.open("w", newline="") as file:
        out = csv.writer(file, lineterminator="\n")
        out.writerow(["exponent", "near", "far"] + [f"m{k}" for k in range(6)])
        for i, kernel in enumerate(exponents):
            for j, ratio in enumerate(ratios):
                if (i + j) % 3 == 0:
                    near = [1e-9, 1e-3, 0.037, 1.0][(i + j // 3) % 4]
                    if kernel == "log" and near < 1 < near * ratio:
                        near = 1.0
                    far = near * ratio
                    row = [nstr(segment(kernel, near, far, k), 17) for k in range(6)]
                    out.writerow([kernel, repr(near), repr(far)] + row)


def write_moments(path, count):
    with path.open("w", newline="") as file:
        out = csv.writer(file, lineterminator="\n")
        out.writerow(["exponent", "shape", "height", "direction", "moments"])
        for kernel, numbers, triangles, height, direction in cases(count):
            values = moments(kernel, triangles, height, direction)
            words = [" ".join(repr(x) for x in numbers), repr(height), " ".join(repr(x) for x in direction)]
            out.writerow([kernel] + words + [" ".join(nstr(v, 17) for v in values)])


def check():
    """The method against quadrature at a few points."""
    for kernel, kappa in ((3.3, lambda d: d ** mpf(-3.3)), (2.0, lambda d: d**-2), ("log", log)):
        with mp.workdps(30):
            expected = quad(lambda x: x**2 * kappa(mpf(0.25) + x * mpf(0.5)), [0, 0.5, 1])
            inner = lambda x: quad(lambda y: x * y**2 * kappa(mpf(1) + x - y / 2), [0, 1 - x])
            area = quad(inner, [0, 1])
        assert abs(segment(kernel, 0.25, 0.75, 2) / expected - 1) < 1e-15
        assert abs(triangle_weights(kernel, [mpf(1), mpf(2), mpf(0.5)], 3)[(0, 1, 2)] / area - 1) < 1e-12


if __name__ == "__main__":
    folder = Path(sys.argv[1])
    check()
    write_kernel(folder / "facet_kernel.csv")
    write_moments(folder / "facet_moments.csv", 266)
