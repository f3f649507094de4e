"""Many simulations side by side: the bytes of single ones on any number of threads."""

import numpy as np
import pytest

import gyration
from conftest import BALL
from test_simulation import FREE

ARRAYS = ["position", "P", "velocity", "Pdot", "G", "gap"]


def pushed(threads):
    """Five balls, each pushed otherwise."""
    batch = gyration.Batch(BALL, 5, threads=threads)
    batch.apply("ball", force=[[0.1 * k, 0, 0] for k in range(5)], torque=[0, 1e-4, 0])
    assert batch.advance([0.2, 0.25, 0.3, 0.35, 0.4]).all()
    batch.apply(0, force=[0, 0, 1], members=[1, 3])
    batch.advance_by(0.1)
    return batch


def test_a_batch_has_the_bytes_of_single_simulations_on_any_number_of_threads():
    one, two = pushed(1), pushed(2)
    for name in ARRAYS:
        assert getattr(one, name).tobytes() == getattr(two, name).tobytes(), name
    assert one.states == two.states and len(one) == 5
    for k in range(5):
        simulation = gyration.Simulation(BALL)
        simulation.apply("ball", force=[0.1 * k, 0, 0], torque=[0, 1e-4, 0])
        simulation.advance([0.2, 0.25, 0.3, 0.35, 0.4][k])
        if k in [1, 3]:
            simulation.apply("ball", force=[0, 0, 1])
        simulation.advance(simulation.time + 0.1)
        assert simulation.state == one.states[k]
        for name in ARRAYS:
            assert getattr(simulation, name).tobytes() == getattr(one, name)[k].tobytes(), name
        assert one["ball.fz"][k] == simulation["ball.fz"] and one.time[k] == simulation.time


def test_members_are_reset_alone():
    batch = pushed(2)
    start, before = gyration.Simulation(BALL), batch.position.copy()
    batch.reset(np.array([False, True, False, False, True]))
    assert list(batch.time > 0) == [True, False, True, True, False]
    assert batch.states[1] == batch.states[4] == start.state
    assert (batch.position[[1, 4]] == start.position).all() and (batch.position[[0, 2, 3]] == before[[0, 2, 3]]).all()
    batch.reset()
    assert (batch.time == 0).all()


def test_states_of_members_are_set():
    batch = gyration.Batch(FREE, 3)
    position = np.arange(9.0).reshape(3, 1, 3)
    batch.set_state(time=[0.0, 1.0, 2.0], position=position, velocity=np.ones((3, 1, 3)))
    batch.advance_by(0.5)
    np.testing.assert_allclose(batch.position, position + 0.5, rtol=1e-14)
    batch.set_state([2], position=[[[0, 0, 0]]])
    assert batch.position[2].tolist() == [[0, 0, 0]] and batch.time[2] == 2.5
    states = batch.states
    batch.advance_by(1.0)
    batch.states = states
    assert batch.states == states
    before = batch.position.copy()
    with pytest.raises(gyration.ArgumentError, match="member 1: .*this P"):
        batch.set_state([0, 1], P=[[np.eye(3)], [2 * np.eye(3)]], position=np.zeros((2, 1, 3)))
    # None of them, not even the one whose state is good.
    assert batch.states == states and (batch.position == before).all()


def test_a_member_that_cannot_go_on_leaves_the_others_alone():
    weak = dict(BALL, contact=[{"support": "table", "repulsion": {"alpha": 1e-3, "nu": 1, "d0": 1e-3}}])
    batch = gyration.Batch(weak, 2, threads=2)
    batch.set_state([1], velocity=[[[0, 0, 20]]])
    assert list(batch.advance(0.5)) == [False, True]
    assert "table" in batch.reasons[0] and batch.reasons[1] is None
    assert batch.time[0] < 0.5 == batch.time[1] and np.isfinite(batch.position).all()
    batch.reset([0])
    assert batch.reasons == [None, None]


def test_drives_are_of_members():
    batch = gyration.Batch("contract-1", 2)
    batch.set_drive("block", [np.zeros((3, 3)), np.diag([0.0, 0.0, 500.0])])
    batch.advance(0.02)
    single = gyration.Simulation("contract-1")
    single.set_drive("block", np.diag([0.0, 0.0, 500.0]))
    single.advance(0.02)
    assert (batch.G[1] == single.G).all() and not (batch.G[0] == single.G).all()


def test_what_makes_no_sense_is_refused():
    batch = gyration.Batch(FREE, 3)
    for wrong in [
        lambda: gyration.Batch(FREE, 0),
        lambda: gyration.Batch(FREE, 10**12),
        lambda: gyration.Batch(FREE, 2, threads=0),
        lambda: batch.advance([1.0, 2.0]),
        lambda: batch.advance(np.nan),
        lambda: batch.apply("box", force=np.zeros((2, 3))),
        lambda: batch.apply("cube", force=[0, 0, 1]),
        lambda: batch.apply("box", torque=[0, 0, 1], at=[0, 0, 0.1]),
        lambda: batch.apply("box", force=[[0, 0, np.inf]] * 3),
        lambda: batch.reset([0, 0]),
        lambda: batch.reset([3]),
        lambda: batch.reset([-1]),
        lambda: batch.reset([True, False]),
        lambda: batch.set_state(position=[0, 0, 1]),
        lambda: setattr(batch, "states", [batch.states[0]]),
    ]:
        with pytest.raises(gyration.ArgumentError, match="fix: "):
            wrong()
    with pytest.raises(KeyError, match="box.x"):
        batch["box.q"]
    with pytest.raises(ValueError):
        batch.position[0] = 1.0
    assert (batch.time == 0).all()
