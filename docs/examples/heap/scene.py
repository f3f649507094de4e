"""Writes heap.toml: N dice (10 if not said) of 2 cm poured into a bin of five planes, 8 cm wide."""

import random
import sys

count = int(sys.argv[1]) if len(sys.argv) > 1 else 10
chance = random.Random(1)

PLANES = {
    "floor": ([0, 0, 0], [0, 0, 1]),
    "left": ([-0.04, 0, 0], [1, 0, 0]),
    "right": ([0.04, 0, 0], [-1, 0, 0]),
    "front": ([0, -0.04, 0], [0, 1, 0]),
    "back": ([0, 0.04, 0], [0, -1, 0]),
}

LAWS = """repulsion = { alpha = "245 Pa", nu = 6, d0 = "0.6 mm" }
damping = { beta = 1e4, nu = 3, d0 = "0.6 mm" }
friction = { beta = 3e4, nu = 3, d0 = "0.6 mm" }
"""

HEAD = """title = "{count} dice poured into a bin"
time = {{ end = 3, sample = 0.01, stop_at_rest = {{ speed = "1 mm/s", hold = 0.05 }} }}
solver = {{ rtol = 1e-4, atol = 1e-6 }}
"""

DIE = """
[[body]]
name = "die-{k}"
group = "dice"
shape = {{ box = {{ size = ["2 cm", "2 cm", "2 cm"] }} }}
density = 1250
position = {position}
orientation = {{ quaternion = {quaternion} }}
velocity = [0, 0, -0.5]
angular_velocity = {spin}
"""

with open("heap.toml", "w") as scene:
    scene.write(HEAD.format(count=count))
    for name, (origin, normal) in PLANES.items():
        scene.write(f'\n[[support]]\nname = "{name}"\nplane = {{ origin = {origin}, normal = {normal} }}\n')
        scene.write(f'\n[[contact]]\nsupport = "{name}"\n{LAWS}')
    scene.write(f'\n[[contact]]\nbetween = ["dice", "dice"]\nreach = "5 mm"\n{LAWS}')
    for k in range(count):
        # Four to a layer: whatever their attitude, they are clear of each other and of the walls.
        layer, place = divmod(k, 4)
        position = [0.0205 * (2 * (place % 2) - 1), 0.0205 * (2 * (place // 2) - 1), 0.03 + 0.041 * layer]
        quaternion = [chance.gauss(0, 1) for _ in range(4)]
        spin = [chance.gauss(0, 10) for _ in range(3)]
        scene.write(DIE.format(k=k, position=position, quaternion=quaternion, spin=spin))
