"""The part of the volume that tetrahedra fill: `gyration export tetrahedra.gyr --format npz`, then `python measure.py
tetrahedra.npz`.

Counted are points of a lattice that lie in a die of the last sample, within boxes that keep a margin from the five
planes and end three quarters up the heap; half of the gap at rest counts to the dice.
"""

import sys

import numpy as np

EDGE, WIDTH, GAP, STEP = 0.02, 0.0512, 0.2e-3, 0.4e-3
# From the centre of a die to its faces, and half of the gap.
INWARD = EDGE / 24**0.5 + GAP / 2
NORMALS = np.array([[1, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]]) / -(3**0.5)

data = np.load(sys.argv[1])
places, turns = data["position"][-1], data["placement_gradient"][-1]
print(f"{len(places)} dice at {data['time'][-1]} s, the highest centre at {places[:, 2].max()} m")
top = 0.75 * (np.sort(places[:, 2])[-4:].mean() + EDGE / 24**0.5)
for margin in (0.0, 0.002, 0.004, 0.006):
    side, low, high = WIDTH / 2 - margin, margin, top
    level, height = (np.arange(start + STEP / 2, end, STEP) for start, end in ((-side, side), (low, high)))
    points = np.stack(np.meshgrid(level, level, height, indexing="ij"), axis=-1).reshape(-1, 3)
    within = np.zeros(len(points), bool)
    for place, turn in zip(places, turns):
        within |= ((points - place) @ turn @ NORMALS.T <= INWARD).all(axis=1)
    print(f"margin {1e3 * margin:.0f} mm: {within.mean():.3f}")
