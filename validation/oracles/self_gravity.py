"""Figures of equilibrium of homogeneous fluid ellipsoids, pi G rho = 1, by quadrature with thirty digits.

Source: Chandrasekhar, Ellipsoidal Figures of Equilibrium (1969), chs. 5, 6 and 8. Rotation about the third axis, a
tide along the first one, p the mass of the moon over that of the planet:

    A_i = a1 a2 a3 int_0^oo du/((a_i^2 + u) D),  D^2 = prod (a_i^2 + u)
    Jacobi   W a_i^2 = 2 (A_i a_i^2 - A_3 a_3^2), i = 1, 2
    Roche    ((3 + p) a_1^2 + a_3^2) W = 2 (A_1 a_1^2 - A_3 a_3^2),  (p a_2^2 + a_3^2) W = 2 (A_2 a_2^2 - A_3 a_3^2)
"""

from mpmath import asin, diff, elliprd, findroot, mp, mpf, sqrt

mp.dps = 30


def weights(a, b, c):
    """A_i."""
    d = lambda x, y, z: mpf(2) / 3 * a * b * c * elliprd(x**2, y**2, z**2)
    return d(b, c, a), d(c, a, b), d(a, b, c)


def excess(a, b, c):
    """2 (A_i a_i^2 - A_3 a_3^2), i = 1, 2."""
    first, second, third = weights(a, b, c)
    return 2 * (first * a**2 - third * c**2), 2 * (second * b**2 - third * c**2)


def maclaurin(e):
    """W of the spheroid of this eccentricity."""
    c = sqrt(1 - e**2)
    return 2 * c / e**3 * (3 - 2 * e**2) * asin(e) - 6 * (1 - e**2) / e**2


def jacobi(b):
    """c/a and W of the ellipsoid of this b/a."""
    def balance(c):
        first, second = excess(mpf(1), b, c)
        return first * b**2 - second

    c = findroot(balance, mpf("0.58") * sqrt(b))
    return c, excess(mpf(1), b, c)[0]


def roche(c, p=mpf(0)):
    """b/a and W of the moon of this c/a."""
    def balance(b):
        first, second = excess(mpf(1), b, c)
        return first * (p * b**2 + c**2) - second * (3 + p + c**2)

    b = findroot(balance, mpf("1.06") * c)
    return b, excess(mpf(1), b, c)[0] / (3 + p + c**2)


e = findroot(lambda e: diff(maclaurin, e), mpf("0.93")).real
print("Maclaurin, largest W", mp.nstr(maclaurin(e).real, 16), "at e", mp.nstr(e, 16))
# Where the ellipsoids leave the spheroids.
c = jacobi(1 - mpf(10) ** -10)[0]
print("Jacobi begins at e", mp.nstr(sqrt(1 - c**2), 12), "W", mp.nstr(maclaurin(sqrt(1 - c**2)), 12))
for b in ("0.6", "0.4"):
    print("Jacobi, b/a", b, [mp.nstr(value, 16) for value in jacobi(mpf(b))])
c = findroot(lambda c: diff(lambda c: roche(c)[1], c), mpf("0.48"))
print("Roche, largest W", mp.nstr(roche(c)[1], 16), "at b/a", mp.nstr(roche(c)[0], 16), "c/a", mp.nstr(c, 16))
for c in ("0.7", "0.6"):
    print("Roche, c/a", c, [mp.nstr(value, 16) for value in roche(mpf(c))])
