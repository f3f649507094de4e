"""Stepping by hand: the state as arrays, applied loads, drives, control loops."""

import shutil
import subprocess
import sys

import numpy as np
import pytest

import gyration
from conftest import BALL

FREE = {
    "world": {"gravity": [0, 0, 0]},
    "time": {"end": 1.0, "sample": 0.1},
    "body": [{"name": "box", "shape": {"box": {"size": [0.1, 0.2, 0.3]}}, "mass": 2.0, "velocity": [0, 0, 1]}],
}


def test_arrays_stay_as_they_were_and_cannot_be_written(ball):
    simulation = gyration.Simulation(ball)
    before, gradient = simulation.position, simulation.P
    assert before.shape == (1, 3) and gradient.shape == (1, 3, 3)
    simulation.advance(0.1)
    np.testing.assert_allclose(before[0, 2] - simulation.position[0, 2], 0.5 * 9.81 * 0.1**2, rtol=1e-6)
    with pytest.raises(ValueError):
        before[0, 0] = 1.0


def test_a_time_in_the_past_is_refused_and_one_from_here_is_not():
    simulation = gyration.Simulation(FREE)
    for k in range(5):
        assert simulation.advance_by(0.25) == 0.25 * (k + 1)
    assert simulation.advance(1.25) == 1.25
    with pytest.raises(gyration.ArgumentError, match=r"at 1.25 s\n  fix: .*advance_by"):
        simulation.advance(0.25)
    for dt in (0.0, -1.0, np.nan):
        with pytest.raises(gyration.ArgumentError, match="fix: give a time"):
            simulation.advance_by(dt)


def test_a_constant_force_is_gravity():
    simulation = gyration.Simulation(FREE)
    simulation.apply("box", force=[0, 0, -2.0 * 9.81])
    simulation.advance(1.0)
    # The motion is a parabola, on which the stepper is exact.
    assert abs(simulation.position[0, 2] - (1 - 0.5 * 9.81)) < 1e-13
    assert abs(simulation.works()["load"] - simulation.energies()["kinetic"] + 1.0) < 1e-11


def test_a_torque_turns(ball):
    simulation = gyration.Simulation(FREE)
    simulation.apply(0, torque=[0, 0, 0.01])
    simulation.advance(0.5)
    inertia = 2.0 / 12 * (0.1**2 + 0.2**2)
    np.testing.assert_allclose(simulation.angular_velocity("box"), [0, 0, 0.5 * 0.01 / inertia], rtol=1e-10)


def test_a_force_at_a_point_does_the_work_of_its_way():
    simulation = gyration.Simulation(FREE)
    point, force = np.array([0.05, 0.1, 0.15]), np.array([1.0, 0.5, -2.0])
    where = lambda: simulation.position[0] + simulation.P[0] @ point
    start = where()
    simulation.apply("box", force=force, at=point)
    simulation.advance(0.3)
    np.testing.assert_allclose(simulation.works()["load"], force @ (where() - start), rtol=1e-4)


def test_a_loop_holds_a_ball_in_the_air(ball):
    target, mass = 0.3, ball.resolved["body"][0].get("mass") or 1000 * 4 / 3 * np.pi * 0.05**3

    def hold(simulation):
        error, speed = target - simulation.position[0, 2], simulation.velocity[0, 2]
        simulation.apply("ball", force=[0, 0, mass * (9.81 + 100 * error - 20 * speed)])

    simulation = gyration.simulate(ball, 0.005, hold, until=2.0)
    assert abs(simulation.time - 2.0) < 1e-12
    # Critically damped at 10 1/s: after 2 s e^-20 (1 + 20) of 0.1 m is left.
    assert abs(simulation.position[0, 2] - target) < 1e-6
    assert abs(simulation.energies()["residual"]) < 1e-3 * abs(simulation.works()["load"])


def test_a_callback_ends_the_run_with_false(ball):
    simulation = gyration.simulate(ball, 0.01, lambda simulation: simulation.time < 0.095)
    assert abs(simulation.time - 0.1) < 1e-12


def test_a_comparison_of_arrays_ends_the_run(ball):
    simulation = gyration.simulate(ball, 0.01, lambda now: now.position[0, 2] > 0.3)
    assert 0.1 < simulation.time < 0.2


def test_progress_stops_a_step_on_the_way_and_it_can_go_on(ball):
    endless = ball.edit({"time.end": 1e6, "solver.rtol": 1e-10})
    simulation = gyration.Simulation(endless)
    reached = simulation.advance(1e6, progress=lambda time, until: False)
    assert 0 < reached == simulation.time < 1e6
    assert simulation.advance(reached + 0.1) == simulation.time
    stopped = gyration.simulate(endless, 1e5, lambda simulation: None, progress=lambda time, until: False)
    assert stopped.time < 1e5


def test_progress_of_a_loop_is_told_over_all_its_intervals(ball):
    told = []

    def progress(time, end):
        told.append((time, end))
        return False

    # Intervals that are short against the time between two tellings.
    stopped = gyration.simulate(ball, 1e-3, lambda simulation: None, until=1e5, progress=progress)
    assert len(told) == 1 and told[0][1] == 1e5 and abs(stopped.time - told[0][0]) < 1e-2


def test_a_drive_is_changed_by_hand():
    scene = gyration.Scene.gallery("contract-1")
    simulation = gyration.Simulation(scene)
    simulation.set_drive("block", np.diag([0.0, 0.0, 500.0]))
    simulation.advance(0.02)
    assert simulation.G.shape == (1, 3, 3) and np.isfinite(simulation.G).all()
    assert simulation.works()["drive"] != 0
    with pytest.raises(gyration.ArgumentError, match="no drive"):
        gyration.Simulation(FREE).set_drive("box", np.zeros((3, 3)))


def test_columns_and_contact_loads_are_those_of_recordings(ball):
    simulation = gyration.Simulation(ball)
    simulation.advance(0.5)
    recording = ball.run()
    for column in ["ball.x", "ball.z", "ball.vz", "energy.kinetic"]:
        # A run ends its steps at the same places but for the end: errors of rtol.
        np.testing.assert_allclose(simulation[column], recording[column][-1], rtol=1e-3, atol=1e-4)
    forces = simulation.forces()["ball"]
    np.testing.assert_allclose(forces["force"], [simulation[f"ball.f{axis}"] for axis in "xyz"], rtol=1e-12)
    assert forces["moment"].shape == (3, 3)
    assert np.isclose(simulation.gap[0], simulation["ball.gap"])


def test_what_makes_no_sense_is_refused(ball):
    simulation = gyration.Simulation(ball)
    for wrong in [
        lambda: simulation.apply("cube", force=[0, 0, 1]),
        lambda: simulation.apply(3, force=[0, 0, 1]),
        lambda: simulation.apply(-1, force=[0, 0, 1]),
        lambda: simulation.apply(None, force=[0, 0, 1]),
        lambda: simulation.apply("ball", force=[0, 1]),
        lambda: simulation.apply("ball", force="down"),
        lambda: simulation.apply("ball", moment=[1, 2, 3]),
        lambda: simulation.apply("ball", torque=np.zeros((3, 3))),
        lambda: simulation.apply("ball", force=[0, 0, 1], at=[1j, 0, 0]),
        lambda: simulation.set_drive("ball", 3.0),
        lambda: simulation.angular_velocity("cube"),
        lambda: simulation.apply("ball", force=[0, 0, float("nan")]),
        lambda: simulation.advance(float("inf")),
        lambda: gyration.simulate(ball, 0.0, print),
    ]:
        with pytest.raises(gyration.ArgumentError, match="fix: |finite"):
            wrong()
    with pytest.raises(KeyError):
        simulation["ball.speed"]
    # Nothing of all that was applied.
    assert simulation.works().get("load", 0.0) == 0.0


def test_a_long_object_is_told_in_short(ball):
    with pytest.raises(gyration.ArgumentError) as caught:
        gyration.Simulation(ball).apply("ball", force=np.zeros(1000).tolist())
    assert len(str(caught.value)) < 200 and "\n  fix: give three numbers" in str(caught.value)


def test_a_run_that_cannot_go_on_says_why_and_stays_where_it_is():
    # So weak a law does not keep the ball off.
    data = dict(BALL, contact=[{"support": "table", "repulsion": {"alpha": 1e-3, "nu": 1, "d0": 1e-3}}])
    simulation = gyration.Simulation(data)
    with pytest.raises(gyration.RunError) as caught:
        simulation.advance(1.0)
    assert caught.value.reason == "gap_closed" and caught.value.body == "ball"
    assert abs(caught.value.time - simulation.time) < 1e-6

FLUSHING = """
import ctypes, sys
ctypes.CDLL(sys.argv[1])
if sys.float_info.min * 0.5 != 0.0:
    sys.exit("not set")
import gyration
for begin in (lambda: gyration.Simulation("dice"), lambda: gyration.Scene.gallery("dice").run()):
    try:
        begin()
    except gyration.RunError as error:
        assert "rounds the smallest numbers to zero" in str(error), error
    else:
        sys.exit("it ran")
"""


def test_a_thread_that_flushes_the_smallest_numbers_to_zero_is_refused(tmp_path):
    """With such a mode, which libraries set for speed, the first step would never end."""
    compiler = shutil.which("cc")
    if compiler is None:
        pytest.skip("no C compiler, whose start-up code sets the mode")
    library = tmp_path / "fast.so"
    (tmp_path / "fast.c").write_text("int nothing;\n")
    subprocess.run([compiler, "-shared", "-fPIC", "-ffast-math", "-o", library, tmp_path / "fast.c"], check=True)
    ended = subprocess.run([sys.executable, "-c", FLUSHING, library], capture_output=True, text=True, timeout=100)
    if ended.stderr.strip() == "not set":
        pytest.skip("this compiler's start-up code does not set the mode")
    assert ended.returncode == 0, ended.stderr


def test_what_cannot_be_asked_for_is_told_with_what_can(ball, tmp_path):
    with pytest.raises(gyration.ArgumentError, match="`until` is NaN"):
        gyration.simulate(ball, 0.005, lambda simulation: None, until=float("nan"))
    simulation = gyration.Simulation(ball)
    with pytest.raises(gyration.ArgumentError, match="exists already.*\n.*fix: replace it by force=True, or choose"):
        simulation.record(tmp_path)
