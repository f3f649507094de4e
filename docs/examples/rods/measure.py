"""What a gas of rods does: `gyration export rods.gyr --format npz`, then `python measure.py rods.npz`.

Prints s and tau of the energy E0 (1 + t/tau)^s that comes nearest in its logarithm, and of the last half of the
samples the energy of a freedom of translation over that of one of turning about the short axes, and the mean cos^2 of
the angle between a rod and its velocity (1/3 if they have nothing to do with each other).
"""

import sys

import numpy as np

RADIUS, LENGTH = 0.5, 3.0

data = np.load(sys.argv[1])
time, energy = data["time"], data["energy_kinetic"]


def fit(tau):
    """The square error of the best line of ln E over ln(1 + t/tau), and its slope."""
    (slope, _), error = np.polyfit(np.log1p(time / tau), np.log(energy), 1, full=True)[:2]
    return error[0], slope


taus = np.geomspace(0.03, 300, 2000)
tau = min(taus, key=lambda tau: fit(tau)[0])
print(f"E falls {energy[0] / energy[-1]:.0f}-fold, E0 (1 + t/{tau:.2f})^{fit(tau)[1]:.3f}")

half = len(time) // 2
turns, velocities, rates = (data[name][half:] for name in ("placement_gradient", "velocity", "gradient_rate"))
axes = turns[..., 2]
cylinder, ball = np.pi * RADIUS**2 * LENGTH, 4 / 3 * np.pi * RADIUS**3
# About a short axis; its ends are half balls whose centres are 3/8 of their radius off.
moment = cylinder * (RADIUS**2 / 4 + LENGTH**2 / 12)
moment += ball * (0.4 * RADIUS**2 + LENGTH**2 / 4 + 3 / 8 * RADIUS * LENGTH)
# The end of the axis moves as the two spins across it say.
across = np.sum(rates[..., 2] ** 2)
translation = (cylinder + ball) * np.sum(velocities**2) / 3
print(f"a freedom of translation has {translation / (moment * across / 2):.3f} of the energy of one of turning")
cosines = np.sum(axes * velocities, axis=-1) ** 2 / np.sum(velocities**2, axis=-1)
print(f"the mean of cos^2 is {cosines.mean():.3f}")
