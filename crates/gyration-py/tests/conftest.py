"""What the tests share: a scene of a ball that falls, and a study of one with the bytes of its table."""

import filecmp
import os

import pytest

import gyration

BALL = {
    "title": "A ball",
    "time": {"end": 0.5, "sample": 0.01},
    "support": [{"name": "table", "plane": {"origin": [0, 0, 0], "normal": [0, 0, 1]}}],
    "contact": [{"support": "table", "repulsion": {"alpha": "40 kPa", "nu": 6, "d0": "2 mm"}}],
    "body": [
        {
            "name": "ball",
            "shape": {"sphere": {"radius": "5 cm"}},
            "density": 1000,
            "position": [0, 0, 0.4],
            "velocity": [0.3, 0, 0],
        }
    ],
}

# An ellipsoid comes down on its tip, and stops at that impact with its ledger open: a curved gap has not the digits for these tolerances.
TIP = {
    "time": {"end": 0.2, "sample": 0.01},
    "solver": {"rtol": 1e-11, "atol": 1e-13},
    "support": [{"name": "table", "plane": {"origin": [0, 0, 0], "normal": [0, 0, 1]}}],
    "contact": [{"support": "table", "repulsion": {"alpha": 1e9, "nu": 3, "d0": 1e-8}}],
    "body": [
        {
            "name": "egg",
            "shape": {"ellipsoid": {"semi_axes": [0.05, 0.05, 0.2]}},
            "density": 500,
            "position": [0, 0, 0.3],
            "orientation": {"axis_angle": {"axis": [0, 1, 0], "angle": "10 deg"}},
        }
    ],
}

STUDY = {
    "title": "A ball thrown along a table without friction",
    "scene": "bounce",
    "seed": 1,
    "repetitions": 20,
    "set": {"time.end": 0.3, "time.stop_at_rest.speed": 1e-9, "contact.0.friction.beta": 0},
    "parameter": {
        "speed": {"key": "body.ball.velocity.0", "values": [0.0, 0.5, 1.0]},
        # A start below the table is a failure.
        "height": {"key": "body.ball.position.2", "uniform": {"from": 0.0, "to": 0.5}},
    },
    "keep": {"way": {"last": "ball.x"}},
}


@pytest.fixture
def ball() -> gyration.Scene:
    return gyration.Scene.from_dict(BALL, name="ball")


@pytest.fixture(scope="session")
def recording() -> gyration.Recording:
    return gyration.Scene.from_dict(BALL, name="ball").run()


def same_files(left, right):
    """Whether two folders hold the same bytes."""
    compared = filecmp.dircmp(left, right, ignore=[])
    files = not (compared.left_only or compared.right_only or compared.diff_files or compared.funny_files)
    return files and all(same_files(os.path.join(left, name), os.path.join(right, name)) for name in compared.common_dirs)


def table_bytes(folder):
    return (folder / "table.parquet").read_bytes()


@pytest.fixture(scope="session")
def reference(tmp_path_factory):
    """The table of threads."""
    folder = tmp_path_factory.mktemp("reference") / "ball.study"
    gyration.study(STUDY, folder, threads=2)
    return table_bytes(folder)


def pytest_terminal_summary(terminalreporter):
    """The sums in the words of Rust's test programs, which `cargo xtask test` reads."""
    count = {kind: len(terminalreporter.stats.get(kind, [])) for kind in ["passed", "failed", "error", "skipped"]}
    failed = count["failed"] + count["error"]
    verdict = "FAILED" if failed else "ok"
    line = f"test result: {verdict}. {count['passed']} passed; {failed} failed; {count['skipped']} ignored"
    terminalreporter.write_line(line)
