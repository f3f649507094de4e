"""Writes tetrahedra.toml: N smooth tetrahedral dice (40 if not said) of 2 cm poured into a bin of five planes.

The bin is 5 cm wide, and a die that lies on a face keeps a gap of some 0.2 mm.
"""

import random
import sys

count = int(sys.argv[1]) if len(sys.argv) > 1 else 40
chance = random.Random(1)

EDGE, WIDTH = 0.02, 0.0512
CORNER = EDGE / 8**0.5
VERTICES = [[CORNER * sign for sign in signs] for signs in ([1, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1])]

PLANES = {
    "floor": ([0, 0, 0], [0, 0, 1]),
    "left": ([-WIDTH / 2, 0, 0], [1, 0, 0]),
    "right": ([WIDTH / 2, 0, 0], [-1, 0, 0]),
    "front": ([0, -WIDTH / 2, 0], [0, 1, 0]),
    "back": ([0, WIDTH / 2, 0], [0, -1, 0]),
}

LAWS = """repulsion = { alpha = "245 Pa", nu = 6, d0 = "0.2 mm" }
damping = { beta = 1e4, nu = 6, d0 = "0.2 mm" }
"""

HEAD = """title = "{count} tetrahedral dice poured into a bin"
time = {{ end = 3, sample = 0.02, stop_at_rest = {{ speed = "5 mm/s", hold = 0.05 }} }}
solver = {{ rtol = 1e-3, atol = 1e-5 }}
"""

DIE = """
[[body]]
name = "die-{k}"
group = "dice"
shape = {{ polyhedron = {{ vertices = {vertices} }} }}
density = 1250
position = {position}
orientation = {{ quaternion = {quaternion} }}
velocity = [0, 0, -1]
"""

with open("tetrahedra.toml", "w") as scene:
    scene.write(HEAD.format(count=count))
    for name, (origin, normal) in PLANES.items():
        scene.write(f'\n[[support]]\nname = "{name}"\nplane = {{ origin = {origin}, normal = {normal} }}\n')
        scene.write(f'\n[[contact]]\nsupport = "{name}"\n{LAWS}')
    scene.write(f'\n[[contact]]\nbetween = ["dice", "dice"]\nreach = "4 mm"\n{LAWS}')
    for k in range(count):
        # Four to a layer: whatever their attitude, they are clear of each other and of the walls.
        layer, place = divmod(k, 4)
        position = [0.0126 * (2 * (place % 2) - 1), 0.0126 * (2 * (place // 2) - 1), 0.014 + 0.0255 * layer]
        quaternion = [chance.gauss(0, 1) for _ in range(4)]
        scene.write(DIE.format(k=k, vertices=VERTICES, position=position, quaternion=quaternion))
