"""Writes hopper.toml: 16 rows of grains of 1 cm above a neck between two rollers, as wide as said [m] (0.026 if not).

Rollers of 3 cm stand at the walls, and what falls through is not caught.
"""

import sys

width = float(sys.argv[1]) if len(sys.argv) > 1 else 0.026

ROLLER, ROWS, PITCH, RISE = 0.03, 16, 0.011, 0.0095
wall = 0.5 * width + ROLLER
across = int((2 * wall - 0.012) / PITCH) + 1

LAWS = """repulsion = { alpha = "400 Pa", nu = 6, d0 = "0.5 mm" }
damping = { beta = 4e3, nu = 6, d0 = "0.5 mm" }
friction = { beta = 4e3, nu = 6, d0 = "0.5 mm", mu = 0.5 }
"""

HEAD = """title = "Grains and a neck of {width} m"
time = {{ end = 3, sample = 0.005 }}
solver = {{ rtol = 1e-4, atol = 1e-6 }}
[[contact]]
between = ["grain", "grain"]
reach = "4 mm"
"""

WALL = """
[[support]]
name = "wall-{name}"
plane = {{ origin = [{x}, 0, 0], normal = [{inward}, 0, 0] }}
[[contact]]
support = "wall-{name}"
"""

ROLLERS = """
[[support]]
name = "roller-{name}"
shape = {{ sphere = {{ radius = {radius} }} }}
position = [{x}, 0, {z}]
[[contact]]
support = "roller-{name}"
reach = "4 mm"
"""

GRAINS = """
[[body]]
name = "row-{row}"
group = "grain"
shape = {{ sphere = {{ radius = "5 mm" }} }}
density = 1000
position = [{x}, 0, {z}]
keep = {{ plane = [0, 1, 0] }}
copies = {{ grid = {{ count = [{count}, 1, 1], spacing = [{pitch}, 1, 1] }} }}
"""

with open("hopper.toml", "w") as scene:
    scene.write(HEAD.format(width=width) + LAWS)
    for name, side in (("left", -1), ("right", 1)):
        scene.write(WALL.format(name=name, x=side * wall, inward=-side) + LAWS)
        scene.write(ROLLERS.format(name=name, radius=ROLLER, x=side * wall, z=-ROLLER) + LAWS)
    for row in range(ROWS):
        count = across - row % 2
        # Half a millimetre off the middle: an arch that is its own mirror image stands for longer.
        x = -0.5 * PITCH * (count - 1) - 0.0005
        scene.write(GRAINS.format(row=row, x=x, z=0.0055 + RISE * row, count=count, pitch=PITCH))
