"""Writes compaction.toml: N smooth soft balls (8 if not said) of 2 cm in a box whose six planes close in, for 2 s.

They fill 0.18 of the box at first and would fill 0.9 of it at the end if they kept their volume.
"""

import math
import sys

count = int(sys.argv[1]) if len(sys.argv) > 1 else 8

RADIUS, END = 0.01, 2.0
volume = count * 4 / 3 * math.pi * RADIUS**3
wide, narrow = ((volume / filled) ** (1 / 3) for filled in (0.18, 0.9))
pace = (wide - narrow) / (2 * END)
room = wide / 2 - RADIUS - 0.5e-3

LAWS = """repulsion = { alpha = "200 Pa", nu = 6, d0 = "0.1 mm" }
damping = { beta = 2e3, nu = 6, d0 = "0.1 mm" }
"""

HEAD = f"""title = "{count} soft balls in a box that closes in"
world = {{ gravity = [0, 0, 0] }}
time = {{ end = {END}, sample = 0.02 }}
solver = {{ rtol = 1e-4, atol = 1e-6 }}
[[contact]]
between = ["ball", "ball"]
reach = "2 mm"
"""

WALL = """
[[support]]
name = "wall-{k}"
plane = {{ origin = {origin}, normal = {normal} }}
motion = {{ velocity = {velocity} }}
[[contact]]
support = "wall-{k}"
"""

BALLS = f"""
[[body]]
name = "ball"
shape = {{ sphere = {{ radius = {RADIUS} }} }}
density = 1000
affine = {{ material = {{ neo_hookean_log = {{ youngs_modulus = 3e4, poissons_ratio = 0.45 }} }}, viscosity = 100 }}
copies = {{ random = {{ count = {count}, box = [{[-room] * 3}, {[room] * 3}], gap = "0.2 mm", seed = 1 }} }}
"""

with open("compaction.toml", "w") as scene:
    scene.write(HEAD + LAWS)
    for k in range(6):
        normal = [0, 0, 0]
        normal[k // 2] = 1 - 2 * (k % 2)
        origin, velocity = ([factor * each for each in normal] for factor in (-wide / 2, pace))
        scene.write(WALL.format(k=k, origin=origin, normal=normal, velocity=velocity) + LAWS)
    scene.write(BALLS)
