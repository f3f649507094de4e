"""Recordings: arrays, tables, pictures, pages; runs that are watched, interrupted and resumed."""

import os
import pathlib
import pickle
import re
import signal
import subprocess
import sys
import threading
import time
import urllib.request

import numpy as np
import pytest

import gyration
from conftest import same_files


def test_a_run_is_free_fall_until_the_table(recording):
    assert recording.outcome == "completed"
    assert len(recording) == 51 and recording.time[-1] == 0.5
    early = recording["t"] < 0.25
    exact = 0.4 - 0.5 * 9.81 * recording["t"][early] ** 2
    # The field of the table reaches far: a few parts in a million of the weight.
    np.testing.assert_allclose(recording["ball.z"][early], exact, atol=1e-6)


def test_arrays_have_names_shapes_and_units(recording):
    assert recording["position"].shape == (51, 1, 3)
    np.testing.assert_array_equal(recording["ball.position"][:, 2], recording["ball.z"])
    assert recording.arrays["velocity"]["units"] == "m/s"
    assert recording.arrays["placement_gradient"]["dims"] == ("time", "body", "row", "col")
    assert "energy.kinetic" in recording and "nonsense" not in recording
    with pytest.raises(KeyError, match="ball.vz"):
        recording["ball.speed"]


def test_pandas_has_the_columns_of_the_csv(recording, tmp_path):
    pandas = pytest.importorskip("pandas")
    path = tmp_path / "ball.csv"
    done = [sys.executable, "-m", "gyration", "export", str(recording.path), "--format", "csv", "-o", str(path)]
    subprocess.run(done, check=True, capture_output=True)
    pandas.testing.assert_frame_equal(recording.to_pandas(), pandas.read_csv(path))


def test_xarray_has_dimensions_and_units(recording):
    pytest.importorskip("xarray")
    dataset = recording.to_xarray()
    assert dataset.position.dims == ("time", "body", "row")
    assert dataset.position.units == "m" and list(dataset.body.values) == ["ball"]
    assert float(dataset.position.sel(body="ball", row="z").isel(time=-1)) == recording["ball.z"][-1]
    assert float(dataset.placement_gradient.sel(body="ball", row="x", col="z")[-1]) == recording["ball.P_xz"][-1]


def test_columns_are_drawn_into_axes_of_matplotlib(recording):
    matplotlib = pytest.importorskip("matplotlib", reason="Matplotlib is not installed: pip install gyration[matplotlib]")
    matplotlib.use("agg")
    from matplotlib.figure import Figure

    axes = Figure().subplots()
    assert recording.draw("ball.z", ax=axes, color="red") is axes
    (line,) = axes.lines
    np.testing.assert_array_equal(line.get_xydata(), np.stack([recording.time, recording["ball.z"]], axis=1))
    assert axes.get_ylabel() == "ball.z [m]" and line.get_color() == "red"
    with pytest.raises(KeyError, match="ball.vz"):
        recording.draw("ball.speed", ax=axes)
    assert len(axes.lines) == 1


def test_keys_are_completed(recording, ball):
    simulation = gyration.Simulation(ball)
    for one in [recording, simulation, ball]:
        keys = one._ipython_key_completions_()
        assert len(keys) == len(set(keys)) > 5
        for key in keys:
            one[key]
    assert {"t", "ball.z", "position", "ball.position"} <= set(recording._ipython_key_completions_())
    assert "body.ball.velocity" in ball._ipython_key_completions_()


def test_events_are_in_order_of_time(recording):
    kinds = [event["kind"] for event in recording.events]
    assert "closest_approach" in kinds
    times = [event["time"] for event in recording.events]
    assert times == sorted(times)


def test_pictures_are_those_of_the_program(recording, tmp_path):
    picture = recording.plot("height", "energy")
    path = tmp_path / "of-the-program.svg"
    plot = [sys.executable, "-m", "gyration", "plot", str(recording.path), "height", "energy", "-o", str(path)]
    subprocess.run(plot, check=True, capture_output=True)
    assert picture.svg == path.read_text() == picture._repr_svg_()
    for ending, head in [("png", b"\x89PNG"), ("pdf", b"%PDF"), ("svg", b"<svg"), ("gif", b"GIF89a")]:
        saved = tmp_path / f"picture.{ending}"
        picture.save(saved)
        assert saved.read_bytes().lstrip()[:40].find(head) >= 0
    with pytest.raises(gyration.ArgumentError, match=".svg, .png, .pdf or .gif"):
        picture.save(tmp_path / "picture.bmp")
    with pytest.raises(gyration.ArgumentError, match="overview"):
        recording.plot("heigth")
    with pytest.raises(gyration.PlotError, match="contracts"):
        recording.plot("stroke")


def test_a_picture_of_every_kind_is_drawn_or_refused_with_a_reason(recording):
    crawler = gyration.Scene.gallery("crawl").edit({"time.end": 0.5}).run()
    kinds = ["overview", "strip", "motion", "height", "gap", "stretch", "forces"]
    kinds += ["energy", "stroke", "distance", "cost", "drive", "laws"]
    for kind in kinds:
        assert crawler.plot(kind).svg.startswith("<svg"), kind
    assert crawler.plot().svg == crawler.plot("overview").svg
    assert crawler.plot("stroke", measures=["P_xx", "G_zz"]).svg != crawler.plot("stroke").svg
    # A rigid ball has no shape to speak of.
    missing = {kind for kind in kinds if not is_drawn(recording, kind)}
    assert missing == {"stretch", "stroke", "cost", "drive"}
    with pytest.raises(gyration.PlotError, match="no measure `P_qq`"):
        crawler.plot("stroke", measures=["P_qq", "G_zz"])
    with pytest.raises(gyration.ArgumentError, match=", ".join(kinds[:3])):
        crawler.plot("everything")


def is_drawn(recording, kind):
    try:
        return recording.plot(kind).svg.startswith("<svg")
    except gyration.PlotError as refusal:
        assert "no body of the recording" in str(refusal)
        return False


def test_the_summary_of_an_opened_recording_is_that_of_its_run(ball, tmp_path):
    told = ball.run(tmp_path / "ball.gyr").summary
    read = gyration.Recording.open(tmp_path / "ball.gyr").summary
    # How long it took stands nowhere.
    assert re.sub(r"simulated in .*", "simulated", told) == read
    assert "outcome    completed" in read and "residual" in read and "momentum" in read


def test_the_summary_of_a_recording_whose_mesh_is_gone_says_what_is_missing(tmp_path):
    (tmp_path / "here").mkdir()
    (tmp_path / "here" / "corner.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n")
    body = {"name": "corner", "shape": {"mesh": {"file": "corner.obj"}}, "density": 1000}
    scene = gyration.Scene.from_dict({"time": {"end": 0.1, "sample": 0.1}, "body": [body]}, base=tmp_path / "here")
    scene.run(tmp_path / "here" / "corner.gyr")
    assert "momentum" in gyration.Recording.open(tmp_path / "here" / "corner.gyr").summary
    (tmp_path / "here" / "corner.obj").unlink()
    read = gyration.Recording.open(tmp_path / "here" / "corner.gyr").summary
    assert read.startswith("completed\nthe rest cannot be told") and "corner.obj" in read


def test_a_notebook_keeps_little_and_the_view_is_shown_when_it_is_asked_for(recording, monkeypatch):
    shown = recording._repr_html_()
    assert shown.startswith("<svg") and "recording.show()" in shown and len(shown) < 60_000
    opened = []
    monkeypatch.setattr("webbrowser.open", opened.append)
    recording.show()
    (address,) = opened
    with urllib.request.urlopen(address) as page:
        assert page.read() == recording.report(pathlib.Path(urllib.request.url2pathname(address[7:]))).read_bytes()


def test_recording_with_output_leaves_the_bytes_of_the_program(ball, tmp_path):
    source = tmp_path / "ball.json"
    source.write_text(ball.text)
    scene = gyration.Scene.from_file(source)
    mine, theirs = tmp_path / "mine.gyr", tmp_path / "theirs.gyr"
    scene.run(mine)
    run = [sys.executable, "-m", "gyration", "run", str(source), "-o", str(theirs), "--quiet"]
    subprocess.run(run, check=True)
    assert same_files(mine, theirs)
    assert gyration.Recording.open(mine).outcome == "completed"


def test_what_is_there_is_not_overwritten(ball, tmp_path):
    path = tmp_path / "ball.gyr"
    ball.run(path)
    with pytest.raises(gyration.ArgumentError, match="force=True"):
        ball.run(path)
    assert len(ball.edit({"time.end": 0.1}).run(path, force=True)) == 11
    with pytest.raises(gyration.RunError, match="another scene"):
        ball.run(path, resume=True)


def test_recordings_on_disk_travel_to_other_processes(ball, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    packed = pickle.dumps(ball.run("ball.gyr"))
    monkeypatch.chdir("/")
    assert pickle.loads(packed)["ball.z"][0] == 0.4
    with pytest.raises(gyration.ArgumentError, match="with `output`"):
        pickle.dumps(ball.run())


def test_a_temporary_recording_goes_with_its_last_user(ball):
    recording = ball.run()
    path = recording.path
    assert os.path.isdir(path)
    del recording
    assert not os.path.exists(path)


def test_a_picture_outlives_its_temporary_recording(ball, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    picture = ball.run().plot("height")
    picture.save("height.png")
    assert (tmp_path / "height.png").read_bytes().startswith(b"\x89PNG")
    report = ball.run().report()
    assert report.name == "ball.html" and (tmp_path / "ball.html").read_text().startswith("<!")


def test_progress_is_told_and_false_stops_a_run_that_can_be_resumed(tmp_path):
    scene = gyration.Scene.gallery("bounce").edit({"time.end": 1e4, "time.stop_at_rest": {"speed": 1e-30, "hold": 1e9}})
    scene = scene.edit({"contact.0.damping.beta": 0.0, "time.sample": 1e-3})
    told = []

    def progress(time, end):
        told.append(time)
        return len(told) < 2

    stopped = scene.run(tmp_path / "long.gyr", progress=progress)
    assert stopped.outcome == "unfinished" and told == sorted(told)
    assert "not ended at t = " in gyration.Recording.open(stopped.path).summary
    last = stopped.time[-1]
    further = scene.run(tmp_path / "long.gyr", progress=lambda time, end: time <= last + 1e-3, resume=True)
    assert further.time[-1] > last


def test_an_exception_of_the_callback_is_raised(tmp_path):
    scene = gyration.Scene.gallery("bounce").edit({"time.end": 1e4, "contact.0.damping.beta": 0.0})

    def progress(time, end):
        raise LookupError("of the user")

    with pytest.raises(LookupError, match="of the user"):
        scene.run(progress=progress)


def test_ctrl_c_closes_the_recording_and_resuming_leaves_the_same_bytes(tmp_path):
    scene = gyration.Scene.gallery("bounce").edit({"solver.rtol": 1e-12, "time.sample": 1e-4})
    whole, broken = tmp_path / "whole.gyr", tmp_path / "broken.gyr"
    scene.run(whole)

    def interrupt():
        while not broken.exists():
            time.sleep(0.001)
        os.kill(os.getpid(), signal.SIGINT)

    # What is started in the background of a shell ignores the signal.
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    sender = threading.Thread(target=interrupt)
    sender.start()
    try:
        with pytest.raises(KeyboardInterrupt, match="resume=True"):
            # Over and over, however fast this machine is: one of the runs is interrupted.
            for _ in range(1000):
                scene.run(broken, force=True)
        sender.join()
    finally:
        signal.signal(signal.SIGINT, before)
    scene.run(broken, resume=True)
    assert same_files(whole, broken)


def test_the_lock_is_released_while_the_engine_computes():
    scene = gyration.Scene.gallery("bounce").edit({"contact.0.damping.beta": 0.0, "time.end": 1e4})
    done = threading.Event()
    counted = 0

    def run():
        scene.run(progress=lambda time, end: not done.is_set())

    worker = threading.Thread(target=run)
    worker.start()
    # This thread goes on while the other computes; it would hang in a package that keeps the lock.
    for counted in range(100_000):
        pass
    done.set()
    worker.join()
    assert counted == 99_999
