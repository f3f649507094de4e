"""Writes column.toml: grains of 9 and 12 mm stacked beside a smooth wall, to fall apart on a rough floor.

The numbers behind it say how many stand side by side (6 if not) and one above the other (10 if not).
"""

import sys

across = int(sys.argv[1]) if len(sys.argv) > 1 else 6
rows = int(sys.argv[2]) if len(sys.argv) > 2 else 10

PITCH, EDGE = 0.0125, 0.0065

HEAD = """title = "A column of {across} by {rows} grains"
time = {{ end = 1.5, sample = 0.01, stop_at_rest = {{ speed = "5 mm/s", hold = 0.05 }} }}
solver = {{ rtol = 1e-4, atol = 1e-6 }}
[[support]]
name = "floor"
plane = {{ origin = [0, 0, 0], normal = [0, 0, 1] }}
[[support]]
name = "wall"
plane = {{ origin = [0, 0, 0], normal = [1, 0, 0] }}
"""

SMOOTH = """repulsion = { alpha = "400 Pa", nu = 6, d0 = "0.5 mm" }
damping = { beta = 6e4, nu = 6, d0 = "0.5 mm" }
"""

ROUGH = SMOOTH + """friction = { beta = 6e5, nu = 6, d0 = "0.5 mm", mu = 1 }
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

with open("column.toml", "w") as scene:
    scene.write(HEAD.format(across=across, rows=rows))
    scene.write('[[contact]]\nsupport = "floor"\n' + ROUGH)
    scene.write('[[contact]]\nsupport = "wall"\n' + SMOOTH)
    scene.write('[[contact]]\nbetween = ["grain", "grain"]\nreach = "4 mm"\n' + ROUGH)
    for row in range(rows):
        for name, radius, first in (("large", 0.006, row % 2), ("small", 0.0045, 1 - row % 2)):
            count = (across - first + 1) // 2
            place = {"x": EDGE + PITCH * first, "z": EDGE + PITCH * row}
            if count:
                scene.write(GRAINS.format(name=name, row=row, radius=radius, count=count, spacing=2 * PITCH, **place))
