"""Writes rods.toml: 16 N rods (N = 2 if not said) that fly about in a box without gravity and rub, and do not damp.

Capsules of radius 0.5 m and 4 m long, side by side in N layers of 4 by 4 at first, with speeds of some 1 m/s; two that
meet turn back at a gap of some 5 mm. The bound of friction is reached where they slip by more than 0.5 mm/s.
"""

import math
import sys

layers = int(sys.argv[1]) if len(sys.argv) > 1 else 2

RADIUS, LENGTH, PITCH, RISE = 0.5, 3.0, 2.3, 4.6
WIDTH, HEIGHT = 4 * PITCH, layers * RISE
LAWS = """repulsion = { alpha = 3e5, nu = 6, d0 = "5 mm" }
friction = { beta = 3e8, nu = 6, d0 = "5 mm", mu = 0.5 }
"""

HEAD = """title = "A gas of rods that rub"
world = { gravity = [0, 0, 0] }
time = { end = 300, sample = 1 }
solver = { rtol = 1e-5, atol = 1e-7 }
[[contact]]
between = ["rod", "rod"]
reach = "12 cm"
"""

WALL = """
[[support]]
name = "wall-{k}"
plane = {{ origin = {origin}, normal = {normal} }}
[[contact]]
support = "wall-{k}"
"""

ROD = """
[[body]]
name = "rod-{k}"
group = "rod"
shape = {{ capsule = {{ radius = {radius}, height = {length} }} }}
density = 1
position = {position}
velocity = {velocity}
angular_velocity = {spin}
"""


def scattered(k, phase):
    """Three numbers between -1 and 1 that follow no order."""
    return [math.sin(12.9898 * (3 * k + axis + 1) + phase) for axis in range(3)]


with open("rods.toml", "w") as scene:
    scene.write(HEAD + LAWS)
    for k in range(6):
        normal = [0, 0, 0]
        normal[k // 2] = 1 - 2 * (k % 2)
        origin = [WIDTH, WIDTH, HEIGHT] if k % 2 else [0, 0, 0]
        scene.write(WALL.format(k=k, origin=origin, normal=normal) + LAWS)
    for k in range(16 * layers):
        cell = (k % 4, k // 4 % 4, k // 16)
        position = [(place + 0.5) * pitch for place, pitch in zip(cell, (PITCH, PITCH, RISE))]
        spin = [0.5 * each for each in scattered(k, 2.0)]
        rod = {"position": position, "velocity": scattered(k, 1.0), "spin": spin}
        scene.write(ROD.format(k=k, radius=RADIUS, length=LENGTH, **rod))
