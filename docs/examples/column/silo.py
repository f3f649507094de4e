"""Writes silo.toml: grains of 9 and 12 mm between two rough walls that rise at 2 cm/s.

The number behind it says how many stand one above the other (10 if not), five side by side.
"""

import sys

rows = int(sys.argv[1]) if len(sys.argv) > 1 else 10

ACROSS, PITCH, EDGE = 5, 0.0125, 0.0065

HEAD = """title = "{rows} rows of grains between walls that rise"
time = {{ end = 4, sample = 0.02 }}
solver = {{ rtol = 1e-4, atol = 1e-6 }}
[[support]]
name = "floor"
plane = {{ origin = [0, 0, 0], normal = [0, 0, 1] }}
[[support]]
name = "left"
plane = {{ origin = [0, 0, 0], normal = [1, 0, 0] }}
motion = {{ velocity = [0, 0, "2 cm/s"] }}
[[support]]
name = "right"
plane = {{ origin = [{width}, 0, 0], normal = [-1, 0, 0] }}
motion = {{ velocity = [0, 0, "2 cm/s"] }}
"""

LAWS = """repulsion = { alpha = "400 Pa", nu = 6, d0 = "0.5 mm" }
damping = { beta = 6e4, nu = 6, d0 = "0.5 mm" }
friction = { beta = 6e4, nu = 6, d0 = "0.5 mm", mu = 0.5 }
"""

GRAINS = """
[[body]]
name = "{name}-{row}"
group = "grain"
shape = {{ sphere = {{ radius = {radius} }} }}
density = 1000
position = [{x}, 0, {z}]
keep = {{ plane = [0, 1, 0] }}
copies = {{ grid = {{ count = [{count}, 1, 1], spacing = [{spacing}, 1, 1] }} }}
"""

with open("silo.toml", "w") as scene:
    scene.write(HEAD.format(rows=rows, width=2 * EDGE + PITCH * (ACROSS - 1)))
    for support in ("floor", "left", "right"):
        scene.write(f'[[contact]]\nsupport = "{support}"\n' + LAWS)
    scene.write('[[contact]]\nbetween = ["grain", "grain"]\nreach = "4 mm"\n' + LAWS)
    for row in range(rows):
        for name, radius, first in (("large", 0.006, row % 2), ("small", 0.0045, 1 - row % 2)):
            count = (ACROSS - first + 1) // 2
            place = {"x": EDGE + PITCH * first, "z": EDGE + PITCH * row}
            scene.write(GRAINS.format(name=name, row=row, radius=radius, count=count, spacing=2 * PITCH, **place))
