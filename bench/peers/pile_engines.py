"""One pile of dice or balls in MuJoCo, Rapier, Drake and ours: `run(engine, scene, end)` gives a `Track` of each.

The scene is that of `docs/examples/heap/scene.py`, read from what it writes: places, attitudes, velocities, spins, five
planes. A track has places, rotations and energies every LOOK, and the seconds of the processor up to each of them.
Friction is Coulomb's with MU in the engines; nothing bounces, since 0.3 % of the speed is what ours returns at 1 m/s.
"""

import json
import pathlib
import resource
import subprocess
import tempfile
import time
import tomllib
from dataclasses import dataclass

import numpy as np

LOOK, GRAVITY, MU = 0.01, 9.81, 0.5
SIDE, MASS = 0.02, 0.01
HEAP = pathlib.Path(__file__).parents[2] / "docs/examples/heap/scene.py"
STOP = ', stop_at_rest = { speed = "1 mm/s", hold = 0.05 }'


@dataclass
class Track:
    places: np.ndarray  # samples, bodies, 3
    turns: np.ndarray  # samples, bodies, 3, 3
    energies: np.ndarray  # kinetic and in the field of gravity, heights from the floor
    seconds: np.ndarray  # of the processor, from the start of the motion
    steps: int
    note: str = ""


@dataclass
class Scene:
    text: str
    ball: bool
    planes: list
    bodies: list


def scene(count, ball=False, changes=()):
    """The heap of so many dice; as balls of the same width, a little off the columns in which they would fall."""
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run(["python3", HEAP, str(count)], cwd=folder, check=True)
        text = pathlib.Path(folder, "heap.toml").read_text()
    changes = [(STOP, ""), *changes]
    if ball:
        changes += [('box = { size = ["2 cm", "2 cm", "2 cm"] }', f"sphere = {{ radius = {SIDE / 2} }}")]
        changes += [("density = 1250", f"mass = {MASS}")]
    for old, new in changes:
        assert old in text, old
        text = text.replace(old, new)
    if ball:
        for body in tomllib.loads(text)["body"]:
            x, y, z = body["position"]
            _, a, b, _ = body["orientation"]["quaternion"]
            text = text.replace(f"position = {body['position']}", f"position = {[x + 2e-3 * a, y + 2e-3 * b, z]}", 1)
    read = tomllib.loads(text)
    planes = [(np.array(s["plane"]["origin"], float), np.array(s["plane"]["normal"], float)) for s in read["support"]]
    return Scene(text, ball, planes, read["body"])


def quaternion(body):
    q = np.array(body["orientation"]["quaternion"])
    return q / np.linalg.norm(q)


def energy(scene, places, velocities, spins):
    """Kinetic and in the field of gravity; a die and a ball turn about every axis alike."""
    moment = MASS * SIDE**2 * (0.1 if scene.ball else 1 / 6)
    kinetic = 0.5 * MASS * np.sum(velocities**2) + 0.5 * moment * np.sum(spins**2)
    return kinetic + MASS * GRAVITY * np.sum(places[:, 2])


def follow(end, advance, look, steps):
    """Advances by LOOK until `end`; only what `advance` takes counts."""
    rows, seconds = [look()], [0.0]
    for _ in range(round(end / LOOK)):
        began = time.process_time()
        advance()
        seconds.append(seconds[-1] + time.process_time() - began)
        rows.append(look())
    places, turns, energies = (np.array(each) for each in zip(*rows))
    return Track(places, turns, energies, np.array(seconds), steps())


class Mujoco:
    """Step h; contacts are springs of a time constant that does not follow the step, damped critically."""

    SOFT = 8e-3

    def __init__(self, h):
        self.h, self.name = h, f"MuJoCo, {1e3 * h:g} ms"

    def run(self, scene, end):
        import mujoco

        bodies, geometry = "", f'type="box" size="{SIDE / 2} {SIDE / 2} {SIDE / 2}"'
        if scene.ball:
            geometry = f'type="sphere" size="{SIDE / 2}"'
        for origin, normal in scene.planes:
            bodies += f'<geom type="plane" size="1 1 .1" pos="{text(origin)}" zaxis="{text(normal)}"/>'
        for body in scene.bodies:
            bodies += f'<body pos="{text(body["position"])}" quat="{text(quaternion(body))}"><freejoint/>'
            bodies += f'<geom {geometry} mass="{MASS}"/></body>'
        model = mujoco.MjModel.from_xml_string(
            f'<mujoco><option timestep="{self.h}" gravity="0 0 {-GRAVITY}" cone="elliptic" integrator="implicitfast"/>'
            f'<default><geom friction="{MU} 0 0" condim="3" solref="{self.SOFT} 1"/></default>'
            f"<worldbody>{bodies}</worldbody></mujoco>"
        )
        data, count, each = mujoco.MjData(model), len(scene.bodies), round(LOOK / self.h)
        mujoco.mj_forward(model, data)
        velocities = data.qvel.reshape(count, 6)
        for k, body in enumerate(scene.bodies):
            # The spin of a free joint is in axes of the body.
            velocities[k, 3:] = data.xmat[k + 1].reshape(3, 3).T @ body["angular_velocity"]
            velocities[k, :3] = body["velocity"]

        def look():
            mujoco.mj_kinematics(model, data)
            places, turns = data.xpos[1:].copy(), data.xmat[1:].reshape(-1, 3, 3).copy()
            return places, turns, energy(scene, places, velocities[:, :3], velocities[:, 3:])

        return follow(end, lambda: mujoco.mj_step(model, data, nstep=each), look, lambda: round(end / self.h))


class Rapier:
    """Step h; restitution 0; bodies may sleep. A die is the unit of length, unless `metres`: 2 cm are too small."""

    def __init__(self, parts, metres=False):
        self.parts, self.scale = parts, 1.0 if metres else 1.0 / SIDE
        self.name = f"Rapier, 1/{100 * parts} s" + (", in metres" if metres else "")

    def run(self, scene, end):
        import rapier3d as r

        def vector(values):
            return r.Vec3(*map(float, values))

        scale = self.scale
        world = r.PhysicsWorld(gravity=r.Vec3(0, 0, -GRAVITY * scale))
        world.integration_parameters.dt = LOOK / self.parts
        world.integration_parameters.length_unit = SIDE * scale
        for origin, normal in scene.planes:
            fixed = world.add_body(r.RigidBody.fixed().translation(vector(scale * origin)))
            world.add_collider(r.Collider.halfspace(vector(normal)).friction(MU).restitution(0), parent=fixed)
        handles = []
        for body in scene.bodies:
            q = quaternion(body)
            sine = np.linalg.norm(q[1:])
            place, velocity = (vector(scale * np.array(body[name])) for name in ("position", "velocity"))
            builder = r.RigidBody.dynamic().translation(place).linvel(velocity).gyroscopic_forces(True)
            builder = builder.rotation(vector(q[1:] / sine * 2 * np.arctan2(sine, q[0])))
            handles.append(world.add_body(builder.angvel(vector(body["angular_velocity"]))))
            half = SIDE / 2 * scale
            collider = r.Collider.ball(half) if scene.ball else r.Collider.cuboid(half, half, half)
            world.add_collider(collider.mass(MASS).friction(MU).restitution(0), parent=handles[-1])
        dice = [world.rigid_bodies[handle] for handle in handles]

        def rows(name):
            vectors = [getattr(die, name) for die in dice]
            return np.array([[v.x, v.y, v.z] for v in vectors])

        def look():
            places = rows("translation") / scale
            turns = np.array([np.reshape(die.rotation.to_matrix(), (3, 3)) for die in dice])
            return places, turns, energy(scene, places, rows("linvel") / scale, rows("angvel"))

        def advance():
            for _ in range(self.parts):
                world.step()

        return follow(end, advance, look, lambda: round(end / LOOK) * self.parts)


class Drake:
    """Continuous, by CENIC under error control to an accuracy.

    Bodies are hydroelastic, of 1 MPa, between rigid planes; or `point`: a spring of 10 N/mm where two are deepest.
    Dissipation of 10 s/m returns a tenth of 1 m/s.
    """

    MODULUS, STIFFNESS, DISSIPATION = 1e6, 1e4, 10.0

    def __init__(self, accuracy, point=False):
        self.accuracy, self.point = accuracy, point
        self.name = f"Drake, {'point' if point else 'hydroelastic'}, {accuracy:.0e}"

    def run(self, scene, end):
        import logging

        import pydrake.all as d

        logging.getLogger("drake").setLevel(logging.ERROR)
        builder = d.DiagramBuilder()
        plant, _ = d.AddMultibodyPlantSceneGraph(builder, time_step=0.0)
        model = d.ContactModel.kPoint if self.point else d.ContactModel.kHydroelasticWithFallback
        plant.set_contact_model(model)

        def properties(rigid):
            made = d.ProximityProperties()
            if self.point:
                made.AddProperty("material", "point_contact_stiffness", self.STIFFNESS)
            elif rigid:
                d.AddRigidHydroelasticProperties(made)
            else:
                d.AddCompliantHydroelasticProperties(SIDE / 2, self.MODULUS, made)
            friction = d.CoulombFriction(MU, MU)
            d.AddContactMaterial(dissipation=self.DISSIPATION, friction=friction, properties=made)
            return made

        for k, (origin, normal) in enumerate(scene.planes):
            pose = d.HalfSpace.MakePose(normal, origin)
            plant.RegisterCollisionGeometry(plant.world_body(), pose, d.HalfSpace(), f"plane-{k}", properties(True))
        shape = d.Sphere(SIDE / 2) if scene.ball else d.Box(SIDE, SIDE, SIDE)
        moment = d.UnitInertia.SolidBox(SIDE, SIDE, SIDE)
        if scene.ball:
            moment = d.UnitInertia.SolidSphere(SIDE / 2)
        dice = []
        for body in scene.bodies:
            dice.append(plant.AddRigidBody(body["name"], d.SpatialInertia(MASS, np.zeros(3), moment)))
            plant.RegisterCollisionGeometry(dice[-1], d.RigidTransform(), shape, body["name"], properties(False))
        plant.Finalize()
        simulator = d.Simulator(builder.Build())
        context = simulator.get_mutable_context()
        state = plant.GetMyMutableContextFromRoot(context)
        for die, body in zip(dice, scene.bodies):
            pose = d.RigidTransform(d.Quaternion(quaternion(body)), np.array(body["position"]))
            plant.SetFreeBodyPose(state, die, pose)
            velocity = d.SpatialVelocity(np.array(body["angular_velocity"], float), np.array(body["velocity"], float))
            plant.SetFreeBodySpatialVelocity(context=state, body=die, V_JpJc=velocity)
        config = d.SimulatorConfig(
            integration_scheme="cenic", accuracy=self.accuracy, max_step_size=LOOK, use_error_control=True
        )
        d.ApplySimulatorConfig(config, simulator)
        simulator.Initialize()

        def look():
            poses = [plant.EvalBodyPoseInWorld(state, die) for die in dice]
            places = np.array([pose.translation() for pose in poses])
            turns = np.array([pose.rotation().matrix() for pose in poses])
            return places, turns, plant.CalcKineticEnergy(state) + plant.CalcPotentialEnergy(state)

        def advance():
            simulator.AdvanceTo(context.get_time() + LOOK)

        return follow(end, advance, look, lambda: simulator.get_integrator().get_num_steps_taken())


class Ours:
    """The program, at a relative tolerance; seconds are known only at `stops`, to each of which it runs anew."""

    def __init__(self, program, rtol, stops=(), note=""):
        self.program, self.rtol, self.stops, self.name = program, rtol, stops, f"ours{note}, {rtol:.0e}"

    def run(self, scene, end):
        seconds = np.full(round(end / LOOK) + 1, np.nan)
        for stop in sorted({*(stop for stop in self.stops if stop < end), end}):
            arrays, seconds[round(stop / LOOK)], steps = self.once(scene, stop)
        energies = arrays["energy_kinetic"] + arrays["energy_gravity"]
        total = energies + arrays["energy_contact"]
        residual = np.abs(arrays["energy_residual"]).max() / total[0]
        rise = (total - np.minimum.accumulate(total)).max() / total[0]
        note = f"with that of contacts it rises by {rise:.1e}; residual of the ledger {residual:.1e}"
        return Track(arrays["position"], arrays["placement_gradient"], energies, seconds, steps, note)

    def once(self, scene, end):
        """The arrays of a run to an end, its seconds of the processor, and its steps."""
        with tempfile.TemporaryDirectory() as folder:
            solver = f"rtol = {self.rtol}, atol = {self.rtol / 100}"
            pathlib.Path(folder, "pile.toml").write_text(scene.text.replace("rtol = 1e-4, atol = 1e-6", solver))

            def call(*arguments):
                command = [self.program, *arguments]
                return subprocess.run(command, cwd=folder, check=True, capture_output=True, text=True).stdout

            before = resource.getrusage(resource.RUSAGE_CHILDREN)
            told = call("run", "pile.toml", "--threads", "1", "--json", "-o", "pile.gyr", "--set", f"time.end={end}")
            after = resource.getrusage(resource.RUSAGE_CHILDREN)
            call("export", "pile.gyr", "-o", "pile.npz")
            arrays = dict(np.load(pathlib.Path(folder, "pile.npz")))
        statistics = json.loads(told)["statistics"]
        steps = statistics["explicit_steps"] + statistics["implicit_steps"]
        return arrays, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime, steps


def text(values):
    return " ".join(repr(float(value)) for value in values)
