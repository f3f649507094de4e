"""Writes gas.toml: N balls (1,000 if not said) of radius 1 m that fly about in a box at 1 m/s, a tenth of its volume.

Two balls that meet head-on at 1 m/s turn back at a gap of 2 mm; nothing is lost, unless a second number c [s/m] says
how much: slow ones return 1 - (2/3) c v of their speed v.
"""

import math
import random
import sys

count = int(sys.argv[1]) if len(sys.argv) > 1 else 1_000
lossy = float(sys.argv[2]) if len(sys.argv) > 2 else 0.0
chance = random.Random(1)

DENSITY, FILLED, GAP, NU = 1.0, 0.1, 2e-3, 6
mass = 4 / 3 * math.pi * DENSITY
side = (count * 4 / 3 * math.pi / FILLED) ** (1 / 3)
# U = alpha 2 pi R* d0^2/((nu - 1)(nu - 2)) at d0, R* half a radius, is the energy of the impact, half the reduced mass.
alpha = 0.25 * mass * (NU - 1) * (NU - 2) / (math.pi * GAP**2)
LAW = f"repulsion = {{ alpha = {alpha}, nu = {NU}, d0 = {GAP} }}"
LOSS = f"damping = {{ beta = {lossy * alpha}, nu = {NU}, d0 = {GAP} }}" if lossy else ""

HEAD = f"""title = "{count} balls in a box"
world = {{ gravity = [0, 0, 0] }}
time = {{ end = 1, sample = 0.1 }}
solver = {{ rtol = 1e-7, atol = 1e-10 }}
[[contact]]
between = ["balls", "balls"]
reach = {25 * GAP}
{LAW}
{LOSS}
"""

WALL = """
[[support]]
name = "wall-{k}"
plane = {{ origin = {origin}, normal = {normal} }}
[[contact]]
support = "wall-{k}"
{law}
"""

BALL = """
[[body]]
name = "ball-{k}"
group = "balls"
shape = {{ sphere = {{ radius = 1 }} }}
mass = {mass}
position = {position}
velocity = {velocity}
"""

with open("gas.toml", "w") as scene:
    scene.write(HEAD)
    for k in range(6):
        inward = [0, 0, 0]
        inward[k // 2] = 1 - 2 * (k % 2)
        scene.write(WALL.format(k=k, origin=[side * (k % 2)] * 3, normal=inward, law=LAW))
    cells = math.ceil(count ** (1 / 3) - 1e-9)
    for k in range(count):
        position = [side * (cell + 0.5) / cells for cell in (k % cells, k // cells % cells, k // cells**2)]
        way = [chance.gauss(0, 1) for _ in range(3)]
        velocity = [each / math.hypot(*way) for each in way]
        scene.write(BALL.format(k=k, mass=mass, position=position, velocity=velocity))
