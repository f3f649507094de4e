"""States of simulations: kept, given back, copied, pickled, saved, begun anew."""

import copy
import pickle

import numpy as np
import pytest

import gyration
from test_simulation import FREE

ARRAYS = ["position", "P", "velocity", "Pdot", "G", "gap"]


def numbers(simulation):
    """All that it shows, in bytes."""
    arrays = [getattr(simulation, name).tobytes() for name in ARRAYS]
    return arrays, simulation.time, simulation.works(), simulation.energies(), simulation.events, simulation.statistics


@pytest.mark.parametrize("name", ["dice", "contract-1", "basset", "gripper", "linkage", "wedge"])
def test_a_simulation_goes_on_to_the_same_bytes_from_its_state_after_any_step(name):
    """Rigid and contractile bodies, spheres that the fluid remembers, bodies that meet, joints."""
    simulation = gyration.Simulation(name)
    simulation.apply(0, force=[0.01, 0.02, 0.005], torque=[1e-4, 0, 2e-4])
    if name == "contract-1":
        simulation.set_drive("block", np.diag([0.0, 100.0, 500.0]))
    kept = []
    for step in range(12):
        # What is applied is new to the solver at some of the states, and held at the others.
        if step == 6:
            simulation.apply(0, force=[0, -0.01, 0])
        kept.append((simulation.state, numbers(simulation)))
        simulation.step()
    other = gyration.Simulation(name)
    for step, ((state, then), (later, _)) in enumerate(zip(kept, kept[1:])):
        other.state = state
        assert numbers(other) == then and other.state == state
        other.step()
        if step == 5:
            other.apply(0, force=[0, -0.01, 0])
        assert other.state == later, step
    simulation.state = kept[3][0]
    assert numbers(simulation) == kept[3][1]


def test_a_copy_goes_its_own_way(ball):
    simulation = gyration.Simulation(ball)
    simulation.apply("ball", force=[0.1, 0, 0])
    simulation.advance(0.1)
    twin, other = simulation.copy(), copy.deepcopy(simulation)
    other.apply("ball", force=[0, 0, 10])
    for one in [simulation, twin, other]:
        one.advance(0.3)
    assert numbers(twin) == numbers(simulation)
    assert other.position[0, 2] > simulation.position[0, 2] + 0.1
    assert simulation.works()["load"] > 0


def test_pickles_and_files_go_on_to_the_same_bytes(ball, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    simulation = gyration.Simulation(ball)
    simulation.apply("ball", torque=[0, 1e-3, 0])
    simulation.advance(0.28)
    simulation.save("ball.state")
    packed = pickle.dumps(simulation)
    simulation.advance(0.4)
    for again in [pickle.loads(packed), gyration.Simulation.load("ball.state")]:
        assert again.time == 0.28
        again.advance(0.4)
        assert numbers(again) == numbers(simulation)


def test_a_state_that_does_not_fit_is_refused_and_changes_nothing(ball, tmp_path):
    simulation = gyration.Simulation(ball)
    simulation.advance(0.1)
    state, before = simulation.state, numbers(simulation)
    other = gyration.Simulation(ball.edit({"body.ball.velocity": [1, 0, 0]})).state
    damaged = state[:-3] + bytes([state[-3] ^ 1]) + state[-2:]
    for wrong, why in [(b"", "no state"), (other, "another scene"), (damaged, "damaged"), (state[:-8], "damaged")]:
        with pytest.raises(gyration.ArgumentError, match=f"(?s){why}.*fix: "):
            simulation.state = wrong
    assert numbers(simulation) == before
    (tmp_path / "empty").write_bytes(b"")
    for path in ["none", "empty"]:
        with pytest.raises(gyration.FileError, match=f"cannot read .*{path}"):
            gyration.Simulation.load(tmp_path / path)


def test_a_simulation_begun_anew_is_a_scene_that_starts_there(ball):
    start = {"position": [[0.1, 0.2, 0.5]], "velocity": [[0.0, 0.3, -1.0]]}
    simulation = gyration.Simulation(ball)
    simulation.advance(0.2)
    simulation.set_state(time=0, P=[np.eye(3)], Pdot=np.zeros((1, 3, 3)), **start)
    scene = ball.edit({f"body.ball.{key}": value[0] for key, value in start.items()})
    fresh = gyration.Simulation(scene)
    assert simulation.works() == fresh.works() and simulation.events == []
    for one in [simulation, fresh]:
        one.advance(0.4)
    assert numbers(simulation)[:5] == numbers(fresh)[:5]


def test_a_state_of_arrays_is_taken_to_the_digits_of_single_precision():
    simulation = gyration.Simulation({**FREE, "body": [{**FREE["body"][0], "angular_velocity": [1, 2, 3]}]})
    simulation.advance(0.7)
    state = {name: getattr(simulation, name).astype(np.float32) for name in ["position", "P", "velocity", "Pdot"]}
    simulation.set_state(**state)
    for name, value in state.items():
        np.testing.assert_allclose(getattr(simulation, name), value, atol=1e-6)
    gradient = simulation.P[0].copy()
    np.testing.assert_allclose(gradient.T @ gradient, np.eye(3), atol=1e-15)


def test_a_turn_without_its_rate_keeps_the_angular_velocity():
    simulation = gyration.Simulation({**FREE, "body": [{**FREE["body"][0], "angular_velocity": [1, 2, 3]}]})
    simulation.set_state(P=[[[0, -1, 0], [1, 0, 0], [0, 0, 1]]])
    np.testing.assert_allclose(simulation.angular_velocity("box"), [1, 2, 3], rtol=1e-14)


def test_loads_and_drives_are_held_over_a_new_state():
    simulation = gyration.Simulation(FREE)
    simulation.apply("box", force=[2.0, 0, 0])
    simulation.set_state(position=[[5, 0, 0]], velocity=[[0, 0, 0]])
    simulation.advance(1.0)
    np.testing.assert_allclose(simulation.position[0], [5.5, 0, 0], rtol=1e-13, atol=1e-13)
    np.testing.assert_allclose(simulation.works()["load"], 1.0, rtol=1e-12)


def test_what_a_body_cannot_have_is_refused(ball):
    simulation = gyration.Simulation(ball)
    before = numbers(simulation)
    for wrong, why in [
        ({"P": [2 * np.eye(3)]}, "this P"),
        ({"P": [np.diag([1, 1, -1])]}, "this P"),
        ({"Pdot": [np.eye(3)]}, "this Pdot"),
        ({"position": [0, 0, 1]}, r"shape \[3\]\n  fix: .*\[1, 3\]"),
        ({"velocity": "fast"}, "fix: give an array"),
        ({"velocity": [[0, 0, np.nan]]}, "not finite"),
        ({"time": np.inf}, "not finite"),
        ({"time": 1e17}, "less than three digits"),
    ]:
        with pytest.raises(gyration.ArgumentError, match=why):
            simulation.set_state(**wrong)
    with pytest.raises(gyration.RunError, match="outside the model"):
        simulation.set_state(position=[[0, 0, -1]])
    assert numbers(simulation) == before
    arm = gyration.Simulation("linkage")
    moved = arm.position.copy()
    moved[0] += 0.01
    with pytest.raises(gyration.ArgumentError, match="this position.*joints"):
        arm.set_state(position=moved)
    # Where it is, it may be.
    arm.advance(0.1)
    arm.set_state(**{name: getattr(arm, name) for name in ["position", "P", "velocity", "Pdot"]})


def test_what_is_simulated_by_hand_is_recorded(ball, tmp_path):
    simulation = gyration.Simulation(ball)
    with pytest.raises(gyration.ArgumentError, match="fix: call record"):
        simulation.recording
    simulation.record()
    for k in range(25):
        simulation.apply("ball", force=[0.1 * k, 0, 0])
        simulation.advance(0.02 * (k + 1))
    recording = simulation.recording
    np.testing.assert_allclose(recording.time, 0.01 * np.arange(51), rtol=1e-12)
    assert recording["ball.x"][-1] == simulation["ball.x"] and recording["work.load"][-1] == simulation.works()["load"]
    assert [event["time"] for event in recording.events] == [event["time"] for event in simulation.events]
    assert recording.plot("height", "forces").svg.startswith("<svg") and "by hand" in recording.summary
    assert recording.report(tmp_path / "ball.html").read_text().startswith("<!")
    # Later rows come in, and a copy of the simulation has none of it.
    simulation.copy().advance(0.9)
    simulation.advance(0.6)
    assert len(simulation.recording) == 61 and len(recording) == 51


def test_a_recording_begins_anywhere_and_ends_with_another_state(ball, tmp_path):
    simulation = gyration.Simulation(ball)
    state = simulation.state
    simulation.advance(0.105)
    simulation.record(tmp_path / "ball.gyr")
    simulation.advance(0.2)
    simulation.state = state
    simulation.advance(0.4)
    times = gyration.Recording.open(tmp_path / "ball.gyr").time
    np.testing.assert_allclose(times, [0.105, *(0.01 * np.arange(11, 21))], rtol=1e-12)
    with pytest.raises(gyration.ArgumentError, match="force=True"):
        simulation.record(tmp_path / "ball.gyr")
    simulation.record(tmp_path / "ball.gyr", force=True)
    del simulation
    assert list(gyration.Recording.open(tmp_path / "ball.gyr").time) == [0.4]
    # No run goes on with what was done by hand.
    with pytest.raises(gyration.Error, match="stepped by hand"):
        ball.run(tmp_path / "ball.gyr", resume=True)
    assert list(gyration.Recording.open(tmp_path / "ball.gyr").time) == [0.4]


def test_a_recording_that_cannot_begin_leaves_the_one_under_way_alone(ball, tmp_path):
    simulation = gyration.Simulation(ball)
    simulation.record(tmp_path / "ball.gyr")
    simulation.advance(0.1)
    (tmp_path / "file").write_text("no folder")
    with pytest.raises(gyration.FileError):
        simulation.record(tmp_path / "file" / "other.gyr")
    simulation.advance(0.2)
    assert len(simulation.recording) == 21


def test_what_is_recorded_by_hand_is_what_a_run_records(tmp_path):
    scene = gyration.Scene.gallery("gripper").edit({"time.end": 0.1})
    simulation = gyration.Simulation(scene)
    simulation.record()
    simulation.advance(0.1)
    by_hand, run = simulation.recording, scene.run()
    np.testing.assert_array_equal(by_hand.time, run.time)
    # The works have one more among them, by whose errors steps are chosen too.
    np.testing.assert_allclose(by_hand["position"], run["position"], rtol=1e-5, atol=1e-8)


def test_places_in_a_lattice_are_those_of_recordings():
    # Symptom: each body was where it is in its own cell, so that a row of a recording set a ring to stretch.
    ring = gyration.Scene.from_dict({
        "world": {"gravity": [0, 0, 0]},
        "time": {"end": 0.2, "sample": 0.1},
        "lattice": {"cell": [[1, 0, 0]], "repeat": [3, 1, 1]},
        "body": [{"name": "a", "shape": {"points": [{"mass": 1, "at": [0, 0, 0]}]}, "velocity": [0.1, 0, 0]}],
        "spring": [{"between": ["a", "a"], "cell": [1, 0, 0], "stiffness": 10, "rest_length": 1.0}],
    })
    recording = ring.run()
    simulation = gyration.Simulation(ring)
    np.testing.assert_allclose(simulation.position[:, 0], [0, 1, 2], atol=1e-12)
    np.testing.assert_allclose(gyration.Batch(ring, 1).position[0, :, 0], [0, 1, 2], atol=1e-12)
    simulation.set_state(position=recording["position"][-1], velocity=recording["velocity"][-1])
    np.testing.assert_allclose(simulation.position, recording["position"][-1], atol=1e-12)
    assert abs(simulation.energies()["load"]) < 1e-20
    assert simulation["a-2.x"] == pytest.approx(2.02, abs=1e-12)
