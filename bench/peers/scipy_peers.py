"""The cube by SciPy, the right-hand side compiled: DOP853, Radau, LSODA; and the reference states.

    scipy_peers.py LIBRARY reference FILE     writes the states at t = 10, one line a rule
    scipy_peers.py LIBRARY measure FILE       prints a line a run: solver rule rtol error milliseconds calls

The reference is DOP853 at rtol 3e-14; `reference` also prints how far it is from the same at 1e-13, which bounds what
errors can be told by it. The compiled function is called through ctypes with raw addresses, the cheapest way there is.
"""

import ctypes
import sys

import numpy as np
from scipy.integrate import solve_ivp

RULES = ["gauss-8", "graded-16", "gauss-48"]
END = 10.0


class Cube:
    """The compiled right-hand side."""

    def __init__(self, library):
        self.library = ctypes.CDLL(library)
        self.size = self.library.cube_dimension()
        self.call = self.library.cube_rates
        self.call.argtypes = [ctypes.c_double, ctypes.c_void_p, ctypes.c_void_p]
        self.library.cube_calls.restype = ctypes.c_long
        self.library.cube_seconds.restype = ctypes.c_double

    def choose(self, rule):
        self.library.cube_choose(rule)

    def start(self):
        y = np.empty(self.size)
        self.library.cube_start(ctypes.c_void_p(y.ctypes.data))
        return y

    def rates(self, t, y):
        y = np.ascontiguousarray(y)
        dy = np.empty(self.size)
        self.call(t, y.ctypes.data, dy.ctypes.data)
        return dy

    def seconds(self):
        return self.library.cube_seconds()

    def calls(self):
        return self.library.cube_calls()


def solve(cube, method, rtol):
    with np.errstate(all="ignore"):
        solution = solve_ivp(cube.rates, (0.0, END), cube.start(), method=method, rtol=max(rtol, 3e-14), atol=rtol)
    if not solution.success:
        raise RuntimeError(solution.message)
    return solution.y[:, -1]


def write_reference(cube, path):
    with open(path, "w", encoding="utf-8") as file:
        for rule, name in enumerate(RULES):
            cube.choose(rule)
            fine, coarse = solve(cube, "DOP853", 3e-14), solve(cube, "DOP853", 1e-13)
            print(f"# reference {name}: {np.abs(fine - coarse).max():.1e} from one step coarser")
            file.write(" ".join(f"{value:.17g}" for value in fine) + "\n")


def measure(cube, path):
    references = np.loadtxt(path)
    plans = [("DOP853", range(4, 14), 3), ("LSODA", range(5, 13), 3), ("Radau", range(4, 10), 1)]
    for rule, name in enumerate(RULES):
        cube.choose(rule)
        for method, exponents, runs in plans:
            for k in exponents:
                fastest = np.inf
                for _ in range(runs):
                    cube.calls()
                    start = cube.seconds()
                    try:
                        y = solve(cube, method, 10.0**-k)
                    except (RuntimeError, ValueError):
                        y = np.full(cube.size, np.nan)
                    fastest = min(fastest, cube.seconds() - start)
                    calls = cube.calls()
                error = np.abs(y - references[rule]).max()
                print(f"scipy-{method} {name} 1e-{k:02d} {error:.3e} {1e3 * fastest:.4f} {calls}", flush=True)


if __name__ == "__main__":
    library, what, path = sys.argv[1:]
    {"reference": write_reference, "measure": measure}[what](Cube(library), path)
