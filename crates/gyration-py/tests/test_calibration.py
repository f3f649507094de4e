"""Numbers of a scene from measurements."""

import numpy as np
import pytest

import gyration

GAPS = {"key": "body.block.density", "at": [500, 1000, 2000, 4000], "gap": ["5.53 mm", "4.92 mm", "4.38 mm", "3.90 mm"], "deviation": 2e-5}
BLOCK = """
time = { end = 1.0, sample = 0.1 }
support = [{ name = "table", plane = {} }]
contact = [{ support = "table", repulsion = { alpha = 40e3, nu = 6, d0 = 2e-3 } }]
[[body]]
name = "block"
shape = { box = { size = [0.05, 0.05, 0.05] } }
density = 1000
position = [0, 0, 0.1]
"""


@pytest.fixture
def measured(tmp_path):
    (tmp_path / "block.toml").write_text(BLOCK)
    fit = {"alpha": {"key": "contact.0.repulsion.alpha"}, "nu": {"key": "contact.0.repulsion.nu", "start": 5}}
    return {"scene": str(tmp_path / "block.toml"), "fit": fit, "gap": [GAPS]}


def test_laws_come_from_gaps_and_go_back_into_the_scene(measured, tmp_path):
    fit = gyration.calibrate(measured)
    # A A_face (d0/d)^nu = m g: a straight line in logarithms.
    weights, gaps = np.log([500, 1000, 2000, 4000]), np.log([5.53, 4.92, 4.38, 3.90])
    assert fit.values["nu"] == pytest.approx(-1 / np.polyfit(weights, gaps, 1)[0], rel=3e-2)
    assert list(fit.changes) == ["contact.0.repulsion.alpha", "contact.0.repulsion.nu"]
    scene = gyration.Scene.from_file(measured["scene"]).edit(fit.changes)
    assert scene["contact.0.repulsion.nu"] == fit.values["nu"]
    assert fit.degrees_of_freedom == 2 and fit.undetermined == []
    assert fit.chi_squared == pytest.approx(sum(row["weighted"] ** 2 for row in fit.residuals))
    np.testing.assert_allclose(np.diag(fit.correlations), 1)
    assert 0 < fit.errors["nu"] < 1
    assert "alpha" in repr(fit) and "correlations" in str(fit)
    picture = fit.plot()
    picture.save(tmp_path / "fit.png")
    assert "<svg" in picture.svg and (tmp_path / "fit.png").stat().st_size > 1000


def test_what_is_wrong_is_said_as_the_program_says_it(measured, tmp_path):
    with pytest.raises(gyration.StudyError, match="`deviation` is missing") as refused:
        gyration.calibrate({**measured, "gap": [{"gap": [1e-3, 2e-3]}]})
    assert refused.value.diagnostics[0].help
    with pytest.raises(gyration.FileError):
        gyration.calibrate(tmp_path / "nothing.toml")
    with pytest.raises(gyration.ArgumentError, match="no calibration"):
        gyration.calibrate(3)
