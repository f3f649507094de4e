"""Studies: the same table whoever computes it; what breaks loses nothing and counts nothing twice."""

import json
import os
import subprocess
import sys
from concurrent.futures import Executor, Future, ProcessPoolExecutor, ThreadPoolExecutor
from concurrent.futures.process import BrokenProcessPool

import numpy as np
import pytest

import gyration
from conftest import BALL, STUDY, TIP, same_files, table_bytes


def test_a_study_is_a_table_with_a_row_a_run(tmp_path):
    table = gyration.study(STUDY, tmp_path / "ball.study", threads=1)
    assert len(table) == 60 and list(table["run"]) == list(range(60))
    assert set(table["outcome"]) == {"completed", "failed"}
    np.testing.assert_array_equal(np.unique(table["speed"]), [0.0, 0.5, 1.0])
    done = np.array([outcome == "completed" for outcome in table["outcome"]])
    # Nothing pulls along the table: the way is speed times time.
    np.testing.assert_allclose(table["way"][done], 0.3 * table["speed"][done], atol=1e-9)
    assert np.isnan(table["way"][~done]).all() and table.units["way"] == "m"


def test_failures_are_rows_with_a_reason(tmp_path):
    table = gyration.study(STUDY, tmp_path / "ball.study")
    failed = [index for index, outcome in enumerate(table["outcome"]) if outcome == "failed"]
    assert failed and all(table["height"][index] < 0.05 for index in failed)
    assert all("table" in table["reason"][index] for index in failed)


def test_an_open_ledger_is_warned_of_also_when_the_table_is_there(tmp_path):
    (tmp_path / "tip.json").write_text(json.dumps(TIP))
    study = {
        "scene": str(tmp_path / "tip.json"),
        "parameter": {"end": {"key": "time.end", "values": [0.05, 0.2]}},
        "keep": {"height": {"last": "egg.z"}},
    }
    for resume in [False, True]:
        with pytest.warns(UserWarning, match=r"the energy balance of run 1 is open"):
            table = gyration.study(study, tmp_path / "tip.study", threads=1, resume=resume)
        assert list(table["ledger"]) == ["closed", "open"]


def test_processes_and_threads_leave_the_same_bytes(tmp_path, reference):
    with ProcessPoolExecutor(2) as executor:
        gyration.study(STUDY, tmp_path / "processes.study", executor=executor, batch=7)
    with ThreadPoolExecutor(3) as executor:
        gyration.study(STUDY, tmp_path / "threads.study", executor=executor)
    gyration.study(STUDY, tmp_path / "one.study", threads=1)
    for name in ["processes", "threads", "one"]:
        assert table_bytes(tmp_path / f"{name}.study") == reference


@pytest.mark.parametrize("which", ["all", "failures"])
def test_recordings_come_back_from_processes_as_threads_leave_them(tmp_path, which):
    study = dict(STUDY, recordings=which, repetitions=4)
    # One law is so weak that the ball reaches the table: such a run ends early.
    laws = [{"alpha": 1e-3, "nu": 1, "d0": 1e-3}, {"alpha": 4e4, "nu": 6, "d0": 2e-3}]
    study["set"] = {**STUDY["set"], "contact.0.damping.beta": 0}
    study["parameter"] = {**STUDY["parameter"], "law": {"key": "contact.0.repulsion", "values": laws}}
    gyration.study(study, tmp_path / "threads.study", threads=2)
    with ProcessPoolExecutor(2) as executor:
        gyration.study(study, tmp_path / "processes.study", executor=executor)
    left, right = tmp_path / "threads.study" / "recordings", tmp_path / "processes.study" / "recordings"
    outcomes = gyration.Table.open(tmp_path / "threads.study")["outcome"]
    kept = {"failed": False, "completed": which == "all", "gap_closed": True}
    wanted = [f"run-{run:06}.gyr" for run, outcome in enumerate(outcomes) if kept[outcome]]
    assert set(outcomes) == set(kept) and sorted(os.listdir(left)) == wanted
    assert same_files(left, right)
    assert table_bytes(tmp_path / "threads.study") == table_bytes(tmp_path / "processes.study")
    assert gyration.Recording.open(right / wanted[0]).outcome in ("completed", "gap_closed")


def test_a_recording_that_a_broken_study_has_left_is_replaced(tmp_path):
    study, folder = dict(STUDY, recordings="all", repetitions=2), tmp_path / "ball.study"
    kept = []

    def progress(done, total):
        kept.append(done)
        return False

    with pytest.raises(gyration.StudyError, match="stopped"):
        gyration.study(study, folder, executor=Forgetful(0), batch=1, progress=progress)
    last = folder / "recordings" / "run-000005.gyr"
    for half in [last.with_name("run-000005.gyr.arriving"), last.with_name("run-000004.gyr.arriving")]:
        half.mkdir()
        (half / "zarr.json").write_text("{")
    gyration.study(study, folder, executor=Forgetful(0), resume=True)
    gyration.study(study, tmp_path / "whole.study", threads=1)
    assert same_files(folder / "recordings", tmp_path / "whole.study" / "recordings")


def test_batches_are_small_where_recordings_are_large():
    from gyration._spread import BYTES, next_size

    megabyte = [("position", bytes(10**6))]
    assert next_size(8, 8, 0.1, []) == 64 and next_size(1000, 1000, 0.1, []) == 8000
    assert next_size(1000, 1000, 1e-3, [(run, megabyte) for run in range(1000)]) == int(BYTES / 1e6)
    assert next_size(1, 1, 60.0, []) == 1


def test_the_order_of_a_dictionary_is_the_order_of_the_axes(tmp_path):
    axes = {"z": {"key": "body.ball.velocity.0", "values": [0, 1]}, "a": {"key": "body.ball.velocity.1", "values": [2, 3]}}
    keep = {"way": {"last": "ball.x"}, "across": {"last": "ball.y"}}
    table = gyration.study({"scene": "bounce", "set": {"time.end": 0.01}, "parameter": axes, "keep": keep}, tmp_path / "axes.study")
    assert table.columns[3:5] == ["z", "a"] and table.columns[-2:] == ["way", "across"]
    assert list(table["z"]) == [0, 0, 1, 1] and list(table["a"]) == [2, 3, 2, 3]


class Dying(Executor):
    """A pool in which one worker is killed in the middle of a batch."""

    def __init__(self, after):
        self.pool = ProcessPoolExecutor(2)
        self.after, self.count = after, 0

    def submit(self, function, /, *arguments, **keywords):
        self.count += 1
        if self.count == self.after:
            return self.pool.submit(os.abort)
        return self.pool.submit(function, *arguments, **keywords)


def test_a_broken_pool_keeps_what_it_had_and_says_how_to_go_on(tmp_path, reference):
    folder = tmp_path / "broken.study"
    executor = Dying(after=9)
    with pytest.raises(gyration.StudyError, match="resume=True") as caught:
        gyration.study(STUDY, folder, executor=executor, batch=2)
    assert isinstance(caught.value.__cause__, BrokenProcessPool)
    kept = gyration.Table.open(folder)["run"]
    assert len(set(kept)) == len(kept) < 60
    gyration.study(STUDY, folder, threads=2, resume=True)
    assert table_bytes(folder) == reference


class Forgetful(Executor):
    """Computes in this process, and cancels a batch."""

    def __init__(self, cancelled):
        self.cancelled, self.count = cancelled, 0

    def submit(self, function, /, *arguments, **keywords):
        future = Future()
        self.count += 1
        if self.count == self.cancelled:
            future.cancel()
            future.set_running_or_notify_cancel()
        else:
            future.set_result(function(*arguments, **keywords))
        return future


def test_a_cancelled_future_is_an_error_that_names_the_way_on(tmp_path, reference):
    folder = tmp_path / "cancelled.study"
    with pytest.raises(gyration.StudyError, match="CancelledError"):
        gyration.study(STUDY, folder, executor=Forgetful(4), batch=5)
    gyration.study(STUDY, folder, executor=Forgetful(0), batch=5, resume="auto")
    assert table_bytes(folder) == reference


class Losing(Forgetful):
    """Loses what comes back of some batches, as Dask may when a worker dies just after it has sent it."""

    def __init__(self, lost):
        super().__init__(0)
        self.lost = lost

    def submit(self, function, /, *arguments, **keywords):
        future = super().submit(function, *arguments, **keywords)
        if self.count in self.lost:
            future = Future()
            future.set_exception(AttributeError("lost"))
        return future


def test_a_batch_that_the_executor_lost_is_given_to_it_once_more(tmp_path, reference):
    gyration.study(STUDY, tmp_path / "lost.study", executor=Losing({3, 7}), batch=5)
    assert table_bytes(tmp_path / "lost.study") == reference
    with pytest.raises(gyration.StudyError, match="gave up after"):
        gyration.study(STUDY, tmp_path / "given-up.study", executor=Losing(range(5, 100)), batch=5)


def test_rows_that_nobody_asked_for_are_refused(tmp_path):
    class Lying(Forgetful):
        def submit(self, function, source, numbers, attempt):
            return super().submit(function, source, [number + 1 for number in numbers], attempt)

    with pytest.raises(gyration.StudyError, match="not asked for"):
        gyration.study(STUDY, tmp_path / "lying.study", executor=Lying(0), batch=3)


def scene_file(path, speed):
    """A scene of a ball as a file, and the study of one run that names it as a neighbour."""
    ball = gyration.Scene.from_dict(BALL, name="ball").edit({"body.ball.velocity": [speed, 0, 0]})
    path.write_text(json.dumps(ball.resolved))
    return {"scene": path.name, "set": {"time.end": 0.1}, "keep": {"way": {"last": "ball.x"}}}


def test_a_pool_that_lives_on_takes_the_scene_as_it_is_now(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    ways = []
    with ProcessPoolExecutor(1) as executor:
        for speed in (1.0, 2.0):
            study = scene_file(tmp_path / "ball.json", speed)
            table = gyration.study(study, tmp_path / f"{speed}.study", executor=executor)
            ways.append(table["way"][0])
    np.testing.assert_allclose(ways, [0.1, 0.2], atol=1e-9)


def test_a_worker_that_finds_another_scene_refuses(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    study = scene_file(tmp_path / "ball.json", 1.0)

    class Meanwhile(Forgetful):
        def submit(self, function, /, *arguments, **keywords):
            scene_file(tmp_path / "ball.json", 2.0)
            return super().submit(function, *arguments, **keywords)

    with pytest.raises(gyration.StudyError, match="another study"):
        gyration.study(study, tmp_path / "ball.study", executor=Meanwhile(0))
    assert not list((tmp_path / "ball.study" / "rows").iterdir())


def test_workers_in_another_folder_find_the_scene(tmp_path, monkeypatch):
    class Elsewhere(Forgetful):
        def submit(self, function, /, *arguments, **keywords):
            here = os.getcwd()
            os.chdir("/")
            try:
                return super().submit(function, *arguments, **keywords)
            finally:
                os.chdir(here)

    monkeypatch.chdir(tmp_path)
    study = scene_file(tmp_path / "ball.json", 1.0)
    (tmp_path / "way.json").write_text(json.dumps(study))
    for index, source in enumerate([study, "way.json"]):
        table = gyration.study(source, tmp_path / f"{index}.study", executor=Elsewhere(0))
        np.testing.assert_allclose(table["way"], [0.1], atol=1e-9)


def test_as_many_batches_wait_as_there_are_workers_for():
    from gyration._spread import AHEAD, EACH, ELASTIC, Room

    class Pool:
        _max_workers = 100

    class Client:
        threads = {"a": 2, "b": 2}

        def nthreads(self):
            return self.threads

    class Dask:
        _client = Client()

    assert Room(Pool()).now() == EACH * 100 and Room(object()).now() == AHEAD
    dask = Room(Dask())
    assert dask.now() == max(AHEAD, ELASTIC * 4)
    Client.threads = {str(worker): 8 for worker in range(50)}
    # For a while what was counted last is believed.
    assert dask.now() == max(AHEAD, ELASTIC * 4)
    dask.counted -= 60
    assert dask.now() == ELASTIC * 400


def test_ctrl_c_says_how_to_go_on(tmp_path, reference):
    folder = tmp_path / "stopped.study"

    def progress(done, total):
        if done >= 10:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt, match="resume=True"):
        gyration.study(STUDY, folder, executor=Forgetful(0), batch=1, progress=progress)
    gyration.study(STUDY, folder, resume=True)
    assert table_bytes(folder) == reference


def test_an_empty_folder_is_begun_automatically(tmp_path, reference):
    (tmp_path / "empty.study").mkdir()
    gyration.study(STUDY, tmp_path / "empty.study", resume="auto")
    assert table_bytes(tmp_path / "empty.study") == reference


@pytest.mark.parametrize("executor", [None, "here"])
def test_a_comparison_of_arrays_stops_a_study(tmp_path, executor):
    runs = {"executor": Forgetful(0), "batch": 1} if executor else {"threads": 1}
    many = dict(STUDY, repetitions=10_000)
    with pytest.raises(gyration.StudyError, match="stopped"):
        gyration.study(many, tmp_path / "s.study", **runs, progress=lambda done, total: np.float64(done) < 10)


def test_progress_stops_a_study_that_goes_on_later(tmp_path, reference):
    folder = tmp_path / "stopped.study"
    with pytest.raises(gyration.StudyError, match="stopped"):
        gyration.study(STUDY, folder, executor=Forgetful(0), batch=1, progress=lambda done, total: done < 10)
    assert len(gyration.Table.open(folder)) < 60
    gyration.study(STUDY, folder, resume=True)
    assert table_bytes(folder) == reference


def test_what_makes_no_sense_is_refused_with_its_fix(tmp_path):
    folder = tmp_path / "ball.study"
    gyration.study(STUDY, folder)
    for wrong, message in [
        (lambda: gyration.study(STUDY, folder), "exists already"),
        (lambda: gyration.study(dict(STUDY, seed=2), folder, resume=True), "table of"),
        (lambda: gyration.study(STUDY, tmp_path / "no.study", resume=True), "no table"),
    ]:
        with pytest.raises(gyration.StudyError, match=message):
            wrong()
    with pytest.raises(gyration.StudyError) as caught:
        gyration.study(dict(STUDY, repetitions=0), tmp_path / "x.study")
    assert caught.value.diagnostics[0].key == "repetitions"
    with pytest.raises(gyration.ArgumentError):
        gyration.study(STUDY, tmp_path / "x.study", threads=0)


def test_a_picture_of_a_table_is_that_of_the_program(tmp_path):
    folder = tmp_path / "ball.study"
    table = gyration.study(STUDY, folder)
    plot = [sys.executable, "-m", "gyration", "study", str(folder), "plot", "-o", "-"]
    for options, picture in [
        ([], table.plot()),
        (["--x", "height"], table.plot("height")),
        (["--x", "height", "--y", "way", "--colour", "speed", "--kind", "scatter"],
         table.plot("height", "way", color="speed", kind="scatter")),
        (["--x", "speed", "--y", "outcome=failed"], table.plot(x="speed", y="outcome=failed")),
    ]:  # fmt: skip
        drawn = subprocess.run([*plot, *options], capture_output=True, check=True).stdout.decode()
        assert picture.svg == drawn == picture._repr_svg_()
    table.plot().save(tmp_path / "ball.png")
    assert (tmp_path / "ball.png").read_bytes().startswith(b"\x89PNG")
    # Also of the Parquet file alone, and of a table under way.
    assert gyration.Table.open(folder / "table.parquet").plot().svg == table.plot().svg


def test_a_picture_that_a_table_has_not_is_refused(tmp_path):
    table = gyration.study(STUDY, tmp_path / "ball.study")
    for wrong, message in [
        (lambda: table.plot("heigth"), "its columns are"),
        (lambda: table.plot(kind="pie"), "histogram, curve, map, scatter"),
        (lambda: table.plot(kind="map"), "no such axis"),
        (lambda: table.plot(colour="speed", color="way"), "are the same"),
    ]:
        with pytest.raises(gyration.ArgumentError, match=message):
            wrong()


def test_tables_are_for_pandas_and_polars(tmp_path):
    table = gyration.study(STUDY, tmp_path / "ball.study")
    pandas = pytest.importorskip("pandas")
    frame = table.to_pandas()
    assert isinstance(frame, pandas.DataFrame) and list(frame.columns) == table.columns and len(frame) == 60
    polars = pytest.importorskip("polars")
    assert table.to_polars()["way"].null_count() == sum(outcome == "failed" for outcome in table["outcome"])
    assert isinstance(table.to_polars(), polars.DataFrame)


def test_the_program_leaves_the_same_bytes(tmp_path, reference):
    source = tmp_path / "study.json"
    source.write_text(json.dumps(STUDY))
    folder = tmp_path / "program.study"
    command = [sys.executable, "-m", "gyration", "study", str(source), "-o", str(folder), "--quiet"]
    subprocess.run(command, check=True)
    gyration.study(source, tmp_path / "package.study")
    assert table_bytes(folder) == table_bytes(tmp_path / "package.study")


def test_a_wrong_argument_costs_no_table(tmp_path):
    folder = tmp_path / "ball.study"
    gyration.study(STUDY, folder)
    before = table_bytes(folder)
    for wrong in ({"threads": 0}, {"progress": 5}, {"executor": 7}, {"batch": 0}):
        with pytest.raises(gyration.ArgumentError):
            gyration.study(STUDY, folder, force=True, **wrong)
        assert table_bytes(folder) == before, wrong
