"""Many scenes at once: order, threads, failures as entries."""

import numpy as np
import pytest

import gyration
from conftest import TIP


def throws(ball):
    return [ball.edit({"body.ball.velocity": [0.1 * k, 0, 0]}) for k in range(6)]


def test_endings_are_those_of_single_runs_on_any_number_of_threads(ball):
    scenes = throws(ball)
    one, three = gyration.run_many(scenes, threads=1), gyration.run_many(scenes, threads=3)
    assert one.outcome == three.outcome == ["completed"] * 6
    for column in one.columns:
        np.testing.assert_array_equal(one[column], three[column])
    assert one["steps"].dtype == np.int64 and (one["steps"] > 0).all()
    np.testing.assert_array_equal(one["ball.x"], [scene.run()["ball.x"][-1] for scene in scenes])
    np.testing.assert_allclose(one["ball.x"], 0.05 * np.arange(6), atol=1e-9)


def test_failures_are_entries(ball):
    through = ball.edit({"contact.0.repulsion": {"alpha": 1e-3, "nu": 1, "d0": 1e-3}})
    runs = gyration.run_many([ball, through, gyration.Scene.gallery("dice").edit({"time.end": 0.01})])
    assert runs.outcome == ["completed", "gap_closed", "completed"]
    assert runs.reason[0] is None and "table" in runs.reason[1]
    assert np.isnan(runs["ball.z"][2]) and np.isfinite(runs["ball.z"][1]) and runs["time"][1] < 0.5


def test_an_open_ledger_is_warned_of(ball, tmp_path):
    tip = gyration.Scene.from_dict(TIP)
    with pytest.warns(UserWarning, match=r"the energy balance of run 1 is open\. Do not trust it: "):
        runs = gyration.run_many([ball, tip, ball.edit({"body.ball.velocity": [1e200, 0, 0]})])
    assert runs.ledger == ["closed", "open", None]
    assert list(runs.to_pandas()["ledger"][:2]) == ["closed", "open"]
    with pytest.warns(UserWarning, match=r"the energy balance is open: it misses by "):
        assert tip.run(tmp_path / "tip.gyr").attrs["ledger"] == "open"


def test_a_run_that_cannot_begin_is_an_entry_that_failed(ball):
    # No number holds the square of this speed; the scene itself has no error.
    beyond = ball.edit({"body.ball.velocity": [1e200, 0, 0]})
    runs = gyration.run_many([beyond, ball])
    assert runs.outcome == ["failed", "completed"] and runs.reason[1] is None
    with pytest.raises(gyration.RunError) as caught:
        beyond.run()
    assert runs.reason[0] == str(caught.value) and "energy is not finite" in runs.reason[0]
    for column in runs.columns:
        assert np.isnan(runs[column][0]) or runs[column][0] == 0, column
        assert np.isfinite(runs[column][1]), column
    assert "1 failed, 1 completed" in repr(runs)


def test_columns_are_kept_as_asked(ball):
    runs = gyration.run_many([ball], keep=["ball.z"])
    assert runs.columns == ["time", "steps", "rejected", "evaluations", "residual", "ball.z"]
    with pytest.raises(gyration.ArgumentError, match="no scene has the column `ball.q`"):
        gyration.run_many([ball], keep=["ball.q"])
    with pytest.raises(KeyError):
        runs["ball.x"]
    for threads in [0, -1]:
        with pytest.raises(gyration.ArgumentError, match="fix: "):
            gyration.run_many([ball], threads=threads)


def test_columns_may_be_of_different_scenes(ball):
    die = gyration.Scene.gallery("dice").edit({"time.end": 0.01})
    runs = gyration.run_many([ball, die], keep=["ball.x", "die.x"])
    assert np.isfinite([runs["ball.x"][0], runs["die.x"][1]]).all()
    assert np.isnan([runs["ball.x"][1], runs["die.x"][0]]).all()
    with pytest.raises(gyration.ArgumentError, match="(?s)no scene has the column `cube.x`.*ball.z"):
        gyration.run_many([ball, die], keep=["ball.x", "cube.x"])


def test_what_is_stopped_keeps_its_place(ball):
    asked = []

    def progress(done, total):
        asked.append(done)
        return np.bool_(False)

    long = [ball.edit({"time.end": 1e9, "time.sample": 1e9, "body.ball.velocity": [k, 0, 0]}) for k in range(5)]
    runs = gyration.run_many(long, threads=2, progress=progress)
    # Who has had enough is not asked again.
    assert len(asked) == 1 and len(runs) == 5 and runs.outcome == ["interrupted"] * 5
    begun = np.isfinite(runs["time"])
    np.testing.assert_allclose(runs["ball.x"][begun], (np.arange(5) * runs["time"])[begun], rtol=1e-6)
    assert begun[:2].all() and not begun[2:].any() and "before it began" in runs.reason[4]


def test_a_table_of_endings_is_for_pandas(ball):
    pytest.importorskip("pandas")
    table = gyration.run_many(throws(ball)).to_pandas()
    assert len(table) == 6 and (table["outcome"] == "completed").all()
    assert len(gyration.run_many([])) == 0
