"""Milliseconds and calls at given errors, from the lines of the programs beside this file.

    table.py RESULTS

Between two runs the logarithm of time goes linearly with that of the error; where a looser tolerance happens to give
the smaller error, the dearer run is left out of the curve only if a cheaper one is at least as good.
"""

import collections
import math
import sys

ERRORS = [1e-4, 1e-6, 1e-8]


def read(path):
    curves = collections.defaultdict(list)
    with open(path, encoding="utf-8") as file:
        for line in file:
            words = line.split()
            if len(words) == 6 and not line.startswith("#"):
                error, milliseconds, calls = float(words[3]), float(words[4]), float(words[5])
                if math.isfinite(error) and error > 0:
                    curves[words[0], words[1]].append((error, milliseconds, calls))
    return curves


def frontier(points):
    """The runs that no cheaper run (in calls, which have no noise) beats, from coarse to fine."""
    kept = []
    for point in sorted(points, key=lambda point: point[2]):
        if not kept or point[0] < kept[-1][0]:
            kept.append(point)
    return kept


def at(points, wanted, column):
    for (error, *coarse), (finer, *fine) in zip(points, points[1:]):
        if error >= wanted >= finer:
            part = math.log(error / wanted) / math.log(error / finer)
            return coarse[column] * (fine[column] / coarse[column]) ** part
    return None


def main(path):
    curves = {key: frontier(points) for key, points in read(path).items()}
    ours = at(curves.get(("gyration", "exact"), []), ERRORS[-1], 0)
    print(f"| solver | rule | ms at {' / '.join(f'{e:.0e}' for e in ERRORS)} | calls | ratio to ours at {ERRORS[-1]:.0e} |")
    print("|---|---|---|---|---|")
    for (solver, rule), points in sorted(curves.items(), key=lambda item: item[0][::-1]):
        times = [at(points, error, 0) for error in ERRORS]
        calls = [at(points, error, 1) for error in ERRORS]
        show = lambda values, digits: " / ".join("–" if v is None else f"{v:.{digits}f}" for v in values)
        ratio = f"{times[-1] / ours:.2f}" if ours and times[-1] else "–"
        print(f"| {solver} | {rule} | {show(times, 2)} | {show(calls, 0)} | {ratio} |")


if __name__ == "__main__":
    main(sys.argv[1])
