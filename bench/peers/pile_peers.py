"""Dice poured into a bin in MuJoCo, Rapier, Drake and ours: cost, overlap, energy, and whether the motion converges.

The heap of `docs/examples/heap/scene.py N`, with the same places, attitudes, velocities and spins in all of them. A
setting is compared with a finer one, which is the step halved or the tolerance made 100 times smaller: how many dice
are then more than 1 mm elsewhere. `balls` are as many balls of the same width, each setting against the finest one of
its engine.

    pip install mujoco rapier3d drake numpy
    python pile_peers.py target/release/gyration 20        # dice, to 2 s
    python pile_peers.py target/release/gyration 40 1 MuJoCo ours   # to another end, from 0.5 s on; not all engines
    python pile_peers.py target/release/gyration balls 64  # errors at 0.1 and 0.2 s against cost

One thread; seconds are those of the processor.
"""

import sys
from itertools import combinations

import numpy as np
from pile_engines import LOOK, SIDE, Drake, Mujoco, Ours, Rapier, scene

FAR = 1e-3  # m
PHASES = (("impact", 0.0, 0.3), ("settling", 0.3, 1.0), ("rest", 1.0, 2.0))
# Friction is viscous below 1.2 mm/s then, c = 408 s/m, as that of Drake is below 1 mm/s.
BOUND = "friction = { beta = 3e4, nu = 3,", "friction = { beta = 1e5, nu = 6, mu = 0.5,"


def dice_engines(program, heap, end):
    """Rows of engine, a finer one, and the scene that both get."""
    stops = [to for _, _, to in PHASES if to <= end]
    bound = scene(len(heap.bodies), changes=[BOUND])
    rows = [(Mujoco(h), Mujoco(h / 2), heap) for h in (2e-3, 2.5e-4)]
    rows += [(Rapier(parts), Rapier(2 * parts), heap) for parts in (4, 32)]
    rows += [(Rapier(4, metres=True), Rapier(8, metres=True), heap)]
    rows += [(Drake(accuracy), Drake(accuracy / 100), heap) for accuracy in (1e-3, 1e-5)]
    rows += [(Ours(program, 1e-4, stops, note), Ours(program, 1e-6, (), note), each)
             for note, each in (("", heap), (", mu = 0.5", bound))]
    return rows


def chosen(engine, names):
    return not names or any(name in engine.name for name in names)


def widths(turns, axes):
    """Half the width of each cube along its axis."""
    return 0.5 * SIDE * np.abs(np.einsum("nij,ni->nj", turns, axes)).sum(axis=1)


def least_gap(heap, places, turns):
    """The least separation of two dice, or of a die and a plane, by the axes of boxes; overlaps are negative."""
    least = np.inf
    for origin, normal in heap.planes:
        along = (places - origin) @ normal - widths(turns, np.tile(normal, (len(places), 1)))
        least = min(least, along.min())
    pairs = np.array(list(combinations(range(len(places)), 2)))
    apart = places[pairs[:, 1]] - places[pairs[:, 0]]
    near = np.linalg.norm(apart, axis=1) < 1.8 * SIDE
    (first, second), apart = pairs[near].T, apart[near]
    if not len(apart):
        return least
    best = np.full(len(apart), -np.inf)
    a, b = turns[first], turns[second]
    axes = [a[:, :, k] for k in range(3)] + [b[:, :, k] for k in range(3)]
    axes += [np.cross(a[:, :, k], b[:, :, j]) for k in range(3) for j in range(3)]
    for axis in axes:
        length = np.linalg.norm(axis, axis=1)
        unit = axis / np.maximum(length, 1e-6)[:, None]
        along = np.abs(np.sum(apart * unit, axis=1)) - widths(a, unit) - widths(b, unit)
        best = np.where(length > 1e-6, np.maximum(best, along), best)
    return min(least, best.min())


def moved(track, finer, at):
    """The dice that are FAR from where the finer run has them."""
    k = round(at / LOOK)
    return int(np.sum(np.linalg.norm(track.places[k] - finer.places[k], axis=1) > FAR))


def time_apart(track, finer):
    """The first sample in which 5 % of the dice are FAR from where the finer run has them."""
    apart = np.linalg.norm(track.places - finer.places, axis=2) > FAR
    late = np.nonzero(apart.mean(axis=1) >= 0.05)[0]
    return late[0] * LOOK if len(late) else np.inf


def dice(program, count, end, names):
    heap = scene(count)
    print(f"{count} dice to {end} s: processor time a simulated second; least gap; largest rise of the energy;")
    print("dice over 1 mm from where a finer run has them, and the time at which 5 % are")
    heads = "".join(f"{name:>9s}" for name, _, to in PHASES if to <= end)
    print(f"{'engine':30s}{heads}  gap [mm]     rise  0.2 s  0.5 s  5 % at [s]")
    rows = dice_engines(program, heap, end)
    for engine, finer, each in (row for row in rows if chosen(row[0], names)):
        track = engine.run(each, end)
        other = finer.run(each, min(end, 0.5))
        other.places = other.places[: len(track.places)]
        costs = ""
        for _, since, to in PHASES:
            if to <= end:
                spent = track.seconds[round(to / LOOK)] - (track.seconds[round(since / LOOK)] if since else 0.0)
                costs += f"{spent / (to - since):9.3g}"
        gap = min(least_gap(each, *sample) for sample in zip(track.places, track.turns))
        low = np.minimum.accumulate(track.energies)
        rise = (track.energies - low).max() / track.energies[0]
        track.places = track.places[: len(other.places)]
        changes = "".join(f"{moved(track, other, at):7d}" for at in (0.2, 0.5))
        late = time_apart(track, other)
        print(f"{engine.name:30s}{costs}{1e3 * gap:10.3f}{rise:9.1e}{changes}{late:12.2f}", flush=True)
        if track.note:
            print(f"    {track.note}", flush=True)


def balls(program, count, names):
    heap = scene(count, ball=True, changes=[BOUND])
    families = [
        [Drake(accuracy) for accuracy in (1e-2, 1e-3, 1e-4, 1e-5, 1e-7)],
        [Drake(accuracy, point=True) for accuracy in (1e-2, 1e-3, 1e-4, 1e-5, 1e-7)],
        [Ours(program, rtol, (), ", balls") for rtol in (1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-9)],
    ]
    print(f"{count} balls: seconds to 0.2 s; steps; root mean square of the errors of places at 0.1 and 0.2 s [m]")
    for family in (each for each in families if chosen(each[0], names)):
        tracks = [engine.run(heap, 0.2) for engine in family]
        for engine, track in zip(family, tracks):
            apart = np.linalg.norm(track.places - tracks[-1].places, axis=2)
            errors = "".join(f"{np.sqrt(np.mean(apart[round(at / LOOK)] ** 2)):10.1e}" for at in (0.1, 0.2))
            print(f"{engine.name:28s}{track.seconds[-1]:9.3g}{track.steps:8d}{errors}", flush=True)


def main():
    program, rest = sys.argv[1], sys.argv[2:]
    if rest[0] == "balls":
        balls(program, int(rest[1]), rest[2:])
    else:
        dice(program, int(rest[0]), float(rest[1]) if len(rest) > 1 else 2.0, rest[2:])


main()
