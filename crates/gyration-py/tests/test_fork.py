"""Processes that are forked from one that has been at work, as those of `multiprocessing` are on some systems."""

import multiprocessing
import os
import signal
import subprocess
import sys
import textwrap

import numpy as np
import pytest

import gyration
from conftest import BALL, STUDY, table_bytes
from gyration._differentiable import Differentiable

pytestmark = pytest.mark.skipif(not hasattr(os, "fork"), reason="there is no fork here")

def resistance_of(length):
    die = gyration.Scene.gallery("dice").edit({"body.die.shape.box.size.0": length})
    return float(np.asarray(gyration.resistance(die, "die")["matrix"])[0, 0])


def test_boundary_elements_are_computed_in_forked_processes():
    # The threads that share the work have begun here, and are not there in the others.
    here = [resistance_of(length) for length in (0.01, 0.012)]
    with multiprocessing.get_context("fork").Pool(1) as pool:
        # Another shape: what is known already needs no threads.
        assert pool.apply_async(resistance_of, (0.012,)).get(timeout=120) == here[1]
        assert pool.apply_async(resistance_of, (0.013,)).get(timeout=120) > here[1]


RUNS = []
"""What a forked process finds here."""


def differentiated(speed):
    return float(RUNS[0].at([speed])[0][0])


def test_a_differentiable_run_is_made_in_a_forked_process():
    RUNS.append(Differentiable(BALL, ["body.ball.velocity.0"], ["ball.x"]))
    here = differentiated(0.3)
    with multiprocessing.get_context("fork").Pool(1) as pool:
        assert pool.apply_async(differentiated, (0.4,)).get(timeout=120) > here


SCRIPT = """
import os, signal, sys, threading, time
from concurrent.futures import ProcessPoolExecutor
import multiprocessing, gyration
from conftest import STUDY

def die():
    print("\\n".join(str(process.pid) for process in multiprocessing.active_children()), flush=True)
    os.kill(os.getpid(), signal.SIGKILL)

def spread(done, total):
    if done >= 10:
        die()

def beside(done, total):
    begun.set()
    # Until that process dies, in the middle of what holds the table.
    while True:
        time.sleep(0.01)

fork = multiprocessing.get_context("fork")
if sys.argv[2] == "spread":
    with ProcessPoolExecutor(2, mp_context=fork) as executor:
        gyration.study(STUDY, sys.argv[1], executor=executor, batch=2, progress=spread)
else:
    begun = threading.Event()
    options = {"changes": {"repetitions": 100_000}, "threads": 1, "progress": beside}
    threading.Thread(target=gyration.study, args=(STUDY, sys.argv[1]), kwargs=options, daemon=True).start()
    begun.wait()
    process = fork.Process(target=time.sleep, args=(100,))
    process.start()
    time.sleep(0.5)
    die()
"""


@pytest.mark.parametrize("how", ["spread", "beside"])
def test_a_table_is_free_when_its_process_has_been_killed(tmp_path, reference, how):
    folder, script = tmp_path / "killed.study", tmp_path / "killed.py"
    script.write_text(textwrap.dedent(SCRIPT))
    environment = {**os.environ, "PYTHONPATH": os.path.dirname(__file__)}
    # The workers outlive it and keep the pipe: what it says is read from a file.
    with open(tmp_path / "said", "w+") as said:
        killed = subprocess.run([sys.executable, script, folder, how], stdout=said, env=environment, timeout=120)
        assert killed.returncode == -signal.SIGKILL
        said.seek(0)
        workers = [int(line) for line in said.read().split()]
    try:
        assert workers and all(os.kill(worker, 0) is None for worker in workers)
        if how == "beside":
            with pytest.raises(gyration.StudyError, match="another study"):
                gyration.study(STUDY, folder, resume=True)
            # It is free: nobody else writes to it.
            gyration.study(STUDY, folder, force=True)
        else:
            assert 10 <= len(gyration.Table.open(folder)) < 60
            gyration.study(STUDY, folder, resume=True)
        assert table_bytes(folder) == reference
    finally:
        for worker in workers:
            try:
                os.kill(worker, signal.SIGKILL)
            except ProcessLookupError:
                pass
