"""Throws of a die in MuJoCo and Rapier: how many a second, and how many final faces change when the step is halved.

The die of `studies/dice-fairness.toml`: side 2 cm, 10 g, friction 0.3, from 0.1 to 0.3 m in any attitude, spinning up to 40 rad/s,
until every point has been slower than 1 cm/s for 0.1 s (MuJoCo trembles at some 5 mm/s for ever). Restitution 0.5: as a coefficient in Rapier, as the damping
ratio of the contact's spring in MuJoCo (e = exp(-pi z / sqrt(1 - z^2)), time constant four steps).

    pip install mujoco rapier3d numpy
    python dice_peers.py [throws]

One thread; seconds are those of the processor.
"""

import sys
import time

import mujoco
import numpy as np
import rapier3d

SIDE, MASS, FRICTION, RESTITUTION, GRAVITY = 0.02, 0.01, 0.3, 0.5, 9.81
SLOW, HOLD, LONGEST = 1e-2, 0.1, 20.0
LOOK = 0.01


def starts(count, seed=0):
    """Heights, quaternions (w first) and spins."""
    random = np.random.default_rng(seed)
    heights = random.uniform(0.1, 0.3, count)
    quaternions = random.normal(size=(count, 4))
    quaternions /= np.linalg.norm(quaternions, axis=1, keepdims=True)
    axes = random.normal(size=(count, 3))
    axes /= np.linalg.norm(axes, axis=1, keepdims=True)
    return heights, quaternions, axes * random.uniform(0, 40, (count, 1))


def lowest_face(matrix):
    """0 to 5: twice the material axis nearest to straight down, plus one for its positive sense."""
    down = -matrix[2]
    axis = int(np.argmax(np.abs(down)))
    return 2 * axis + int(down[axis] > 0)


def matrix_of(w, x, y, z):
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
    )


def scaled_axis(quaternion):
    """The rotation vector of a unit quaternion (w first)."""
    w, vector = quaternion[0], quaternion[1:]
    sine = np.linalg.norm(vector)
    return [float(x) for x in vector / sine * 2 * np.arctan2(sine, w)]


def until_rest(advance, speed):
    """Advances by LOOK until the speed has been below SLOW for HOLD; whether it came to rest."""
    slow = 0.0
    for _ in range(round(LONGEST / LOOK)):
        advance()
        slow = slow + LOOK if speed() < SLOW else 0.0
        if slow >= HOLD:
            return True
    return False


class Mujoco:
    """Step h; bodies are soft where they touch."""

    steps = (5e-4, 2.5e-4, 1.25e-4)

    def __init__(self, h):
        logarithm = np.log(RESTITUTION)
        ratio = -logarithm / np.hypot(np.pi, logarithm)
        self.model = mujoco.MjModel.from_xml_string(
            f"""
            <mujoco>
              <option timestep="{h}" gravity="0 0 {-GRAVITY}" cone="elliptic" integrator="implicitfast"/>
              <default><geom friction="{FRICTION} 0 0" condim="3" solref="{4 * h} {ratio}"/></default>
              <worldbody>
                <geom type="plane" size="1 1 0.1"/>
                <body><freejoint/><geom type="box" size="{SIDE / 2} {SIDE / 2} {SIDE / 2}" mass="{MASS}"/></body>
              </worldbody>
            </mujoco>"""
        )
        self.data = mujoco.MjData(self.model)
        self.substeps = round(LOOK / h)

    def throw(self, height, quaternion, spin):
        data = self.data
        mujoco.mj_resetData(self.model, data)
        data.qpos[:] = [0, 0, height, *quaternion]
        # The spin of a free joint is in axes of the body.
        data.qvel[3:] = matrix_of(*quaternion).T @ spin
        rested = until_rest(
            lambda: mujoco.mj_step(self.model, data, nstep=self.substeps),
            lambda: np.linalg.norm(data.qvel[:3]) + np.linalg.norm(data.qvel[3:]) * SIDE * 0.87,
        )
        return lowest_face(matrix_of(*data.qpos[3:])), rested


class Rapier:
    """Step h; restitution by a coefficient."""

    steps = (1 / 400, 1 / 800, 1 / 1600)

    def __init__(self, h):
        self.h = h

    def throw(self, height, quaternion, spin):
        r = rapier3d
        world = r.PhysicsWorld(gravity=r.Vec3(0, 0, -GRAVITY))
        world.integration_parameters.dt = self.h
        world.integration_parameters.length_unit = SIDE
        floor = world.add_body(r.RigidBody.fixed().translation(r.Vec3(0, 0, -1)))
        world.add_collider(r.Collider.cuboid(5, 5, 1).friction(FRICTION).restitution(RESTITUTION), parent=floor)
        die = world.add_body(
            r.RigidBody.dynamic()
            .translation(r.Vec3(0, 0, float(height)))
            .rotation(r.Vec3(*scaled_axis(quaternion)))
            .angvel(r.Vec3(*map(float, spin)))
            .gyroscopic_forces(True)
            .can_sleep(False)
        )
        half = SIDE / 2
        collider = r.Collider.cuboid(half, half, half).mass(MASS).friction(FRICTION).restitution(RESTITUTION)
        world.add_collider(collider, parent=die)
        substeps = round(LOOK / self.h)
        body = world.rigid_bodies[die]

        def advance():
            for _ in range(substeps):
                world.step()

        def speed():
            v, s = body.linvel, body.angvel
            return np.hypot(np.hypot(v.x, v.y), v.z) + np.hypot(np.hypot(s.x, s.y), s.z) * SIDE * 0.87

        rested = until_rest(advance, speed)
        return lowest_face(np.reshape(body.rotation.to_matrix(), (3, 3))), rested


def main():
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 300
    throws = list(zip(*starts(count)))
    print(f"{count} throws; faces from 0 to 5; a fair die that is thrown anew changes 5 of 6")
    print("engine        step [s]  throws/s  changed  at rest  faces")
    for engine in (Mujoco, Rapier):
        before = None
        for h in engine.steps:
            thrower = engine(h)
            began = time.process_time()
            ends = [thrower.throw(*start) for start in throws]
            seconds = time.process_time() - began
            faces = np.array([face for face, _ in ends])
            rested = np.mean([rested for _, rested in ends])
            changed = "       " if before is None else f"{np.mean(faces != before):7.3f}"
            counts = " ".join(f"{n:4d}" for n in np.bincount(faces, minlength=6))
            print(f"{engine.__name__:8s} {h:13.3e} {count / seconds:9.1f}  {changed} {rested:8.3f}  {counts}", flush=True)
            before = faces


main()
