"""Reference motion of a tumbling box under three contact laws, independent of the Rust code.

Equations (docs/theory-rigid.md): the tractions are summed point by point over the six faces,

    q = alpha (d/d0)^-nu n - beta_d (d/d0)^-nu_d (w.n) n - beta_f (d/d0)^-nu_f (w - (w.n) n),   w = velocity of the point,
    m v' = m g + int q dA,     (R I R^T w)' = int (x - p0) x q dA,     R' = [w]x R,

with n = e_z and d the height of the point. The unknowns are p0, v, the angular momentum and all nine entries of R: no
quaternion, no body axes, no surface moments. Each face is integrated by a product of Gauss rules, uniform in the
logarithm of the gap from its lowest corner; time by Gragg's modified midpoint rule with Richardson extrapolation.
The spread between two quadratures and between this integrator and SciPy's DOP853 is printed: it is the error of
the numbers written to tumbling_box.csv.

Run: python tumbling_box.py   (needs numpy and scipy; a few minutes)
"""

import pathlib

import numpy as np
from scipy.integrate import solve_ivp

SIZE = np.array([0.10, 0.06, 0.03])  # m
DENSITY = 1200.0  # kg/m3
GRAVITY = np.array([0.0, 0.0, -9.81])
REPULSION = (600.0, 4.6, 0.01)  # alpha [Pa], nu, d0 [m]
DAMPING = (150.0, 3.3, 0.01)  # beta [Pa s/m], nu, d0 [m]
FRICTION = (100.0, 2.7, 0.01)
START = dict(
    position=[0.0, 0.0, 0.12],
    axis=[1.0, 2.0, 0.5],
    angle=0.7,
    velocity=[0.4, -0.2, 0.0],
    angular_velocity=[5.0, -3.0, 8.0],
)
TIMES = np.linspace(0.0, 0.35, 15)

MASS = DENSITY * SIZE.prod()
EULER = MASS / 12.0 * SIZE**2
INERTIA = EULER.sum() - EULER


def cross_matrix(a):
    return np.array([[0, -a[2], a[1]], [a[2], 0, -a[0]], [-a[1], a[0], 0]])


def rotation(axis, angle):
    k = cross_matrix(np.array(axis) / np.linalg.norm(axis))
    return np.eye(3) + np.sin(angle) * k + (1 - np.cos(angle)) * k @ k


def faces():
    """Origin corner and two edge vectors of each face."""
    result = []
    for axis in range(3):
        a, b = [i for i in range(3) if i != axis]
        for side in (-0.5, 0.5):
            corner = -0.5 * SIZE.copy()
            corner[axis] = side * SIZE[axis]
            edges = np.zeros((2, 3))
            edges[0, a], edges[1, b] = SIZE[a], SIZE[b]
            result.append((corner, edges[0], edges[1]))
    return result


FACES = faces()


def graded(low, rise, nodes, weights):
    """Points u in [0, 1] and weights, uniform in log(low + rise u); low may be an array."""
    low = np.asarray(low)[..., None]
    if rise <= 1e-9 * np.min(low):  # level: nothing to grade
        return nodes + 0 * low, weights + 0 * low
    span = np.log1p(rise / low)
    grown = np.expm1(nodes * span)
    return grown * low / rise, weights * span * (grown + 1) * low / rise


def face_points(corner, e1, e2, height, slope, rule):
    """Material points and area weights of one face; the gap is height + slope.X."""
    lowest, rises = corner.copy(), []
    directions = []
    for edge in (e1, e2):
        rise = slope @ edge
        if rise < 0:
            lowest, edge, rise = lowest + edge, -edge, -rise
        directions.append(edge)
        rises.append(rise)
    u, wu = graded(height + slope @ lowest, rises[0], *rule)
    v, wv = graded(height + slope @ lowest + rises[0] * u, rises[1], *rule)
    points = lowest + u[:, None, None] * directions[0] + v[:, :, None] * directions[1]
    area = np.linalg.norm(e1) * np.linalg.norm(e2)
    return points.reshape(-1, 3), (area * wu[:, None] * wv).reshape(-1)


def power(law, gap):
    factor, exponent, reference = law
    return factor * (gap / reference) ** -exponent


def unpack(y):
    turn = y[6:15].reshape(3, 3)
    spin = turn @ ((turn.T @ y[15:18]) / INERTIA)
    return y[0:3], y[3:6], turn, spin


def rates(y, rule):
    position, velocity, turn, spin = unpack(y)
    if smallest_gap(y) <= 0:
        raise ValueError("a trial state beyond the plane")
    force, torque = np.zeros(3), np.zeros(3)
    for corner, e1, e2 in FACES:
        points, weights = face_points(corner, e1, e2, position[2], turn[2], rule)
        arm = points @ turn.T
        gap = position[2] + arm[:, 2]
        speed = velocity + np.cross(spin, arm)
        traction = -power(FRICTION, gap)[:, None] * speed
        traction[:, 2] = power(REPULSION, gap) - power(DAMPING, gap) * speed[:, 2]
        traction *= weights[:, None]
        force += traction.sum(axis=0)
        torque += np.cross(arm, traction).sum(axis=0)
    turning = cross_matrix(spin) @ turn
    return np.concatenate([velocity, GRAVITY + force / MASS, turning.reshape(-1), torque])


def start():
    turn = rotation(START["axis"], START["angle"])
    spin = np.array(START["angular_velocity"])
    momentum = turn @ (INERTIA * (turn.T @ spin))
    return np.concatenate([START["position"], START["velocity"], turn.reshape(-1), momentum])


def smallest_gap(y):
    return y[2] - 0.5 * np.abs(y[6:15].reshape(3, 3)[2]) @ SIZE


SCALE = np.concatenate([np.full(3, 0.1), np.full(3, 1.0), np.full(9, 1.0), np.full(3, 1e-3)])


def extrapolated_step(f, y, h, tolerance):
    """One step of Gragg's modified midpoint rule, extrapolated in h^2; (value, error) or None."""
    table, counts = [], []
    for stage in range(1, 11):
        n = 2 * stage
        small = h / n
        before, now = y, y + small * f(y)
        for _ in range(n - 1):
            before, now = now, before + 2 * small * f(now)
        row = [0.5 * (before + now + small * f(now))]
        counts.append(n)
        for k in range(1, stage):
            ratio = (counts[-1] / counts[-1 - k]) ** 2
            row.append(row[k - 1] + (row[k - 1] - table[-1][k - 1]) / (ratio - 1))
        if stage > 3:
            error = np.max(np.abs(row[-1] - row[-2]) / SCALE)
            if error < tolerance:
                return row[-1], stage
        table.append(row)
    return None


def integrate(rule, tolerance):
    """States at TIMES by extrapolation, and the smallest gap after every step."""
    f = lambda y: rates(y, rule)
    y, t, h = start(), 0.0, 1e-3
    states, gaps = [y], []
    for target in TIMES[1:]:
        while t < target:
            h = min(h, 0.01)
            step = min(h, target - t)
            try:
                result = extrapolated_step(f, y, step, tolerance)
            except ValueError:
                result = None
            if result is None:
                h = 0.5 * step
                continue
            y, stage = result
            t = target if step == target - t else t + step
            gaps.append((t, smallest_gap(y)))
            if stage <= 7:
                h = 1.3 * max(h if step < h else step, step)
            elif stage > 8:
                h = 0.7 * step
        states.append(y)
    return np.array(states), gaps


def gauss(n):
    nodes, weights = np.polynomial.legendre.leggauss(n)
    return 0.5 * (nodes + 1), 0.5 * weights


def main():
    fine, gaps = integrate(gauss(24), 1e-13)
    minima = [g[1] for g in zip(gaps, gaps[1:], gaps[2:]) if g[1][1] < g[0][1] and g[1][1] < g[2][1]]
    print("closest approaches (t, gap):", [f"{t:.5f}: {d:.3e}" for t, d in minima])
    coarse, _ = integrate(gauss(18), 1e-12)
    spread = lambda other: (np.abs(fine - other) / SCALE).max(axis=0)
    print("18 points, looser steps: position", spread(coarse)[:3].max() * 0.1, "rotation", spread(coarse)[6:15].max())
    pair = solve_ivp(
        lambda t, y: rates(y, gauss(24)), (TIMES[0], TIMES[-1]), start(), "DOP853", TIMES, rtol=1e-13, atol=1e-15 * SCALE
    )
    other = spread(pair.y.T)
    print("DOP853: position", other[:3].max() * 0.1, "rotation", other[6:15].max(), "evaluations", pair.nfev)
    orthogonality = max(np.abs(y[6:15].reshape(3, 3) @ y[6:15].reshape(3, 3).T - np.eye(3)).max() for y in fine)
    print("orthogonality of R:", orthogonality)
    columns = ["t", "x", "y", "z", "vx", "vy", "vz"] + [f"R_{a}{b}" for a in "xyz" for b in "xyz"]
    with open(pathlib.Path(__file__).with_suffix(".csv"), "w") as out:
        out.write(",".join(columns) + "\n")
        for t, y in zip(TIMES, fine):
            out.write(",".join(f"{value:.15e}" for value in [t, *y[:15]]) + "\n")


if __name__ == "__main__":
    main()
