"""A packet in a ring of masses, by the sum over all waves of the ring: where its energy is.

    u_n(0) = Re c_n,   v_n(0) = Re(-i w0 c_n),   c_n = exp(2 pi i kappa n - (n - n0)^2 / 2 w^2)

Each wave of the discrete Fourier transform oscillates with its own omega = 2 sqrt(k/m) |sin(q/2)|. Prints the cells that
the middle of the energy goes in 40 s, and sqrt(2) times its standard deviation then.
"""

import cmath
import math

CELLS, START, WIDTH, KAPPA, STIFFNESS, MASS, TIME = 650, 150, 25, 0.1, 40, 0.5, 40
ROOTS = [cmath.exp(-2j * math.pi * j / CELLS) for j in range(CELLS)]


def transformed(x):
    return [sum(x[n] * ROOTS[n * j % CELLS] for n in range(CELLS)) for j in range(CELLS)]


def back(x):
    return [(sum(x[j] * ROOTS[-n * j % CELLS] for j in range(CELLS)) / CELLS).real for n in range(CELLS)]


def where(u, v):
    energy = []
    for n in range(CELLS):
        after, before = u[(n + 1) % CELLS] - u[n], u[n] - u[n - 1]
        energy.append(MASS * v[n] ** 2 / 2 + STIFFNESS * (after**2 + before**2) / 4)
    middle = sum(n * e for n, e in enumerate(energy)) / sum(energy)
    return middle, math.sqrt(2 * sum((n - middle) ** 2 * e for n, e in enumerate(energy)) / sum(energy))


def omega(kappa):
    return 2 * math.sqrt(STIFFNESS / MASS) * abs(math.sin(math.pi * kappa))


away = [n - START - CELLS * round((n - START) / CELLS) for n in range(CELLS)]
packet = [cmath.exp(2j * math.pi * KAPPA * (START + d) - d * d / 2 / WIDTH**2) for d in away]
u, v = [c.real for c in packet], [(-1j * omega(KAPPA) * c).real for c in packet]
first, _ = where(u, v)
waves = list(zip(transformed(u), transformed(v), (omega(j / CELLS) for j in range(CELLS))))
u = back([a * math.cos(w * TIME) + b * (math.sin(w * TIME) / w if w else TIME) for a, b, w in waves])
v = back([b * math.cos(w * TIME) - a * w * math.sin(w * TIME) for a, b, w in waves])
last, width = where(u, v)
print(last - first, width)
