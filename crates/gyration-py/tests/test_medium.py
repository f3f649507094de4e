"""Bodies as a medium, and motions that repeat themselves, as arrays."""

import numpy as np
import pytest

import gyration

CHAIN = {
    "world": {"gravity": [0, 0, 0]},
    "time": {"end": 1, "sample": 0.5},
    "lattice": {"cell": [[0.12, 0, 0]], "repeat": [4, 1, 1]},
    "body": [{"name": "a", "shape": {"points": [{"mass": 0.5, "at": [0, 0, 0]}]}}],
    "spring": [{"between": ["a", "a"], "cell": [1, 0, 0], "stiffness": 40, "rest_length": 0.1}],
}


def test_a_chain_under_tension_bears_it_in_every_point():
    recording = gyration.Scene(CHAIN).run()
    found = gyration.fields(recording, 0.25, at=[[0, 0.1, 0], [7, 0, 0.1]])
    assert found["stress"].shape == (3, 2, 3, 3) and found["hyperstress"].shape == (3, 2, 3, 3, 3)
    exact = 0.8 * np.exp(-0.5 * 0.16) / (2 * np.pi * 0.0625)
    np.testing.assert_allclose(found["stress"][:, :, 0, 0], exact, rtol=1e-12)
    with pytest.raises(gyration.ArgumentError, match="above zero"):
        gyration.fields(recording, 0)


def test_a_wave_of_a_ring_is_one_branch_of_its_spectrum():
    wave = {"kappa": [0.25, 0, 0], "branch": 2, "amplitude": 1e-6}
    ring = CHAIN | {"lattice": CHAIN["lattice"] | {"wave": wave}, "time": {"end": 2, "sample": 0.05}}
    found = gyration.spectrum(gyration.Scene(ring).run(), energies=True)
    assert found["kappa"].shape == (4, 3) and found["energy"].shape == (4, 3)
    assert found["energies"].shape == (41, 4, 3) and found["total"].shape == (41,)
    assert found["energy"][2, 2] == pytest.approx(found["total"].mean(), rel=1e-6)
    branch = found["branches"][8]
    # 2 sqrt(k/m) sin(pi/4) along a chain.
    assert branch["branch"] == 2 and branch["omega"] == pytest.approx(160**0.5, rel=1e-6)
    with pytest.raises(gyration.ArgumentError, match="no `\\[lattice\\]`"):
        gyration.spectrum(gyration.Scene({key: CHAIN[key] for key in ("world", "time", "body")}).run())


def test_the_same_chain_is_a_continuum():
    found = gyration.continuum(CHAIN, "0,0,0 0.5,0,0", model="cauchy", points=3)
    # k a along it, T across.
    np.testing.assert_allclose(found["macro"][0, 0, 0, 0], 40 * 0.12, rtol=1e-12)
    assert found["D1"].shape == (3, 3, 3) and found["map"]["omega"].shape == (3, 3)
    assert np.isnan(found["map"]["error"][0]).all()
    with pytest.raises(gyration.ArgumentError, match="no model"):
        gyration.continuum(CHAIN, model="hooke")


def test_an_orbit_has_the_period_of_its_amplitude():
    well = {
        "world": {"gravity": [0, 0, 0]},
        "time": {"end": 8, "sample": 1},
        "body": [
            {
                "name": "a",
                "shape": {"points": [{"mass": 1, "at": [0, 0, 0]}]},
                "position": [0.9, 0, 0],
                "potential": "0.5*x^2 + 0.25*x^4",
            }
        ],
    }
    found = gyration.orbit(well, amplitude=("body.a.x", 1))
    assert found["period"] == pytest.approx(4.768022029, abs=2e-9)
    assert found["stable"] and found["multipliers"].shape == (6, 2)
    np.testing.assert_allclose(found["start"]["a"]["position"][0], 1, rtol=1e-9)


def test_a_phonon_moves_on_by_a_cell_in_the_time_of_its_phase():
    wave = {"kappa": [0.25, 0, 0], "branch": 0, "amplitude": 1e-3}
    body = [CHAIN["body"][0] | {"keep": {"line": [1, 0, 0]}}]
    ring = CHAIN | {"lattice": CHAIN["lattice"] | {"wave": wave}, "body": body}
    found = gyration.orbit(ring, shift=1)
    # q/omega, omega = 2 sqrt(k/m) sin(q/2).
    assert found["period"] == pytest.approx(np.pi / 2 / 160**0.5, rel=1e-9)
    assert gyration.orbit(ring, shift=(1, 0, 0))["period"] == pytest.approx(found["period"], rel=1e-9)
    with pytest.raises(gyration.ArgumentError, match="free ends along cell vector 2"):
        gyration.orbit(ring, shift=(0, 1, 0))
