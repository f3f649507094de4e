"""Writes dice.toml: N dice (10,000 if not said) of 2 cm above one table, each thrown in its own way."""

import math
import random
import sys

count = int(sys.argv[1]) if len(sys.argv) > 1 else 10_000
chance = random.Random(1)

HEAD = """title = "{count} dice on one table"
time = {{ end = 0.4, sample = 0.05 }}
[[support]]
name = "table"
plane = {{}}
[[contact]]
support = "table"
repulsion = {{ alpha = "245 Pa", nu = 6, d0 = "0.6 mm" }}
damping = {{ beta = 1e4, nu = 3, d0 = "0.6 mm" }}
friction = {{ beta = 1e4, nu = 3, d0 = "0.6 mm" }}
"""

DIE = """
[[body]]
name = "die-{k}"
shape = {{ box = {{ size = ["2 cm", "2 cm", "2 cm"] }} }}
density = 1250
position = {position}
orientation = {{ quaternion = {quaternion} }}
velocity = [0.3, 0, -0.2]
angular_velocity = {spin}
"""

with open("dice.toml", "w") as scene:
    scene.write(HEAD.format(count=count))
    side = math.isqrt(count - 1) + 1
    for k in range(count):
        position = [0.06 * (k % side), 0.06 * (k // side), chance.uniform(0.06, 0.12)]
        quaternion = [chance.gauss(0, 1) for _ in range(4)]
        spin = [chance.gauss(0, 15) for _ in range(3)]
        scene.write(DIE.format(k=k, position=position, quaternion=quaternion, spin=spin))
