"""Dask and MPI: workers that are killed in the middle; nothing is lost, nothing is counted twice, and the bytes are those of threads."""

import json
import os
import shutil
import signal
import subprocess
import sys
from pathlib import Path

import pytest

import gyration
from conftest import STUDY, table_bytes


def test_dask_goes_on_when_a_worker_is_killed(tmp_path, reference):
    distributed = pytest.importorskip("distributed")
    folder = tmp_path / "dask.study"
    options = {"n_workers": 2, "threads_per_worker": 1, "processes": True, "dashboard_address": None}
    with distributed.LocalCluster(**options, local_directory=tmp_path) as cluster, distributed.Client(cluster) as client:
        workers = sorted(client.run(os.getpid).values())
        assert len(workers) == 2
        killed = []

        def progress(done, total):
            if done >= 10 and not killed:
                os.kill(workers[0], signal.SIGKILL)
                killed.append(done)

        table = gyration.study(STUDY, folder, executor=client.get_executor(), batch=2, progress=progress)
    assert killed and killed[0] < 60
    assert list(table["run"]) == list(range(60))
    assert table_bytes(folder) == reference


SCRIPT = """
import json, os, sys
from mpi4py.futures import MPIPoolExecutor
import gyration

if __name__ == "__main__":
    study, folder, dies = json.loads(sys.argv[1]), sys.argv[2], sys.argv[3] == "dies"
    with MPIPoolExecutor() as executor:

        def progress(done, total):
            if dies and done >= 10:
                # All of MPI dies with the worker, while this process waits for it.
                executor.submit(os.abort).result()

        gyration.study(study, folder, executor=executor, batch=2, resume="auto", progress=progress)
"""


def mpi(folder, how, script):
    """Three processes, of which one keeps the table; the environment's own mpiexec."""
    here = Path(sys.executable).parent / "mpiexec"
    launcher = str(here) if here.exists() else shutil.which("mpiexec")
    run = [launcher, "-n", "3", sys.executable, "-m", "mpi4py.futures", str(script), json.dumps(STUDY), str(folder), how]
    return subprocess.run(run, capture_output=True, text=True, timeout=300)


def test_mpi_goes_on_when_it_is_started_again_after_a_death(tmp_path, reference):
    pytest.importorskip("mpi4py")
    folder, script = tmp_path / "mpi.study", tmp_path / "study.py"
    script.write_text(SCRIPT)
    broken = mpi(folder, "dies", script)
    assert broken.returncode != 0 and not (folder / "table.parquet").exists()
    kept = list(gyration.Table.open(folder)["run"])
    assert 10 <= len(kept) < 60 and len(set(kept)) == len(kept)
    whole = mpi(folder, "lives", script)
    assert whole.returncode == 0, whole.stderr
    assert table_bytes(folder) == reference


def test_shards_are_joined_to_the_same_bytes(tmp_path, reference):
    """What the jobs of a Slurm array do."""
    source, folder = tmp_path / "ball.json", tmp_path / "shards.study"
    source.write_text(json.dumps(STUDY))
    program = [sys.executable, "-m", "gyration", "study", str(source)]
    for shard in ["2/3", "1/3", "3/3"]:
        subprocess.run([*program, "--shard", shard, "-o", str(folder), "--quiet"], check=True)
    subprocess.run([*program, "merge", "-o", str(folder)], check=True, capture_output=True)
    whole = tmp_path / "whole.study"
    gyration.study(source, whole)
    assert table_bytes(folder) == table_bytes(whole)
