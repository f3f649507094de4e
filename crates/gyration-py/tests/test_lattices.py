"""Systems and lattices: small motions about rest, and waves, as arrays with the numbers of the program."""

import json
import subprocess
import sys

import numpy as np
import pytest

import gyration

# Two masses in turn on springs that are stretched, so that they hold each other across too.
CHAIN = {
    "title": "a string of two masses",
    "world": {"gravity": [0, 0, 0]},
    "time": {"end": 1, "sample": 1},
    "lattice": {"cell": [[1, 0, 0]]},
    "body": [
        {"name": "a", "shape": {"points": [{"mass": 2, "at": [0, 0, 0]}]}},
        {"name": "b", "shape": {"points": [{"mass": 1, "at": [0, 0, 0]}]}, "position": [0.5, 0, 0]},
    ],
    "spring": [
        {"between": ["a", "b"], "stiffness": 3, "rest_length": 0.4},
        {"between": ["b", "a"], "cell": [1, 0, 0], "stiffness": 3, "rest_length": 0.4},
    ],
}


def told(tmp_path, *arguments):
    """What the program that the package brings along prints of the chain as JSON."""
    path = tmp_path / "chain.json"
    path.write_text(json.dumps(CHAIN))
    command = [sys.executable, "-m", "gyration", arguments[0], str(path), *arguments[1:], "--json"]
    return json.loads(subprocess.run(command, capture_output=True, text=True, check=True).stdout)


def pairs(numbers):
    """Real and imaginary parts as complex numbers."""
    return np.asarray(numbers, float) @ [1, 1j]


def test_bands_are_the_numbers_of_the_program_and_of_their_closed_form(tmp_path):
    found = gyration.bands(CHAIN, "G=0,0,0 X=0.5,0,0", points=9, mesh=8, shapes=True)
    known = told(tmp_path, "bands", "--path", "G=0,0,0 X=0.5,0,0", "--points", "9", "--mesh", "8", "--shapes")
    assert set(found) == set(known)
    for name in ["kappa", "k", "omega", "decay", "participation"]:
        np.testing.assert_array_equal(found[name], known[name])
    np.testing.assert_array_equal(found["lambda"], pairs(known["lambda"]))
    velocity = [[3 * [np.nan] if it is None else it for it in row] for row in known["velocity"]]
    np.testing.assert_array_equal(found["velocity"], velocity)
    for name, parts in [("translation", (9, 6, 3)), ("gradient", (9, 6, 3, 3))]:
        of_b = [[wave["b"][name] for wave in row] for row in known["shapes"]]
        np.testing.assert_array_equal(found["shapes"]["b"][name], pairs(of_b))
        assert found["shapes"]["b"][name].shape == parts
    assert found["gaps"] == known["gaps"] and found["labels"] == [(0, "G"), (8, "X")]
    np.testing.assert_array_equal(found["dos"]["density"], known["dos"]["density"])
    np.testing.assert_array_equal(found["rest"]["force"], known["rest"]["force"])
    np.testing.assert_array_equal(found["rest"]["bodies"]["b"]["position"], [0.5, 0, 0])
    np.testing.assert_array_equal(found["sound"][0]["speed"], known["sound"][0]["speed"])
    # Along the chain k, across it T/a: ω² = k(1/m₁ + 1/m₂) ± k√((1/m₁ + 1/m₂)² − 4s²/(m₁m₂)).
    root = np.sqrt(1.5**2 - 2 * np.sin(np.pi * found["kappa"][:, 0]) ** 2)
    squares = [stiffness * (1.5 + sign * root) for stiffness in (3, 0.6, 0.6) for sign in (1, -1)]
    np.testing.assert_allclose(found["omega"] ** 2, np.sort(np.transpose(squares)), atol=1e-11)


def test_complex_bands_and_strains_are_the_numbers_of_the_program(tmp_path):
    found = gyration.bands(CHAIN, points=5, complex=True, omega=(0, 4))
    known = told(tmp_path, "bands", "--points", "5", "--complex", "--omega", "0..4")
    np.testing.assert_array_equal(found["omega"], known["omega"])
    for kappa, pairs_known in zip(found["kappa"], known["kappa"], strict=True):
        np.testing.assert_array_equal(kappa, pairs(pairs_known))
    found = gyration.bands(CHAIN, along="xx=0..-0.4", steps=5)
    known = told(tmp_path, "bands", "--along", "xx=0..-0.4", "--steps", "5")
    assert set(found["path"]) == set(known["path"][0])
    for name, values in found["path"].items():
        rows = [row[name] for row in known["path"]]
        np.testing.assert_array_equal(values, np.asarray(rows, float))
    # Its springs are slack at four fifths of the length.
    assert found["instability"]["s"] == known["instability"]["s"] == pytest.approx(0.5, abs=1e-9)
    np.testing.assert_array_equal(found["instability"]["F"], known["instability"]["F"])


def test_derivatives_bounds_and_phases_are_the_numbers_of_the_program(tmp_path):
    keys, path = ["spring.0.stiffness", "body.b.shape.points.0.mass"], "0,0,0 0.5,0,0"
    found = gyration.bands(CHAIN, path, points=5, derivatives=keys, bound=True)
    known = told(tmp_path, "bands", "--path", path, "--points", "5", "--derivatives", " ".join(keys), "--bound")
    for key in keys:
        np.testing.assert_array_equal(found["derivatives"][key], np.asarray(known["derivatives"][key], float))
    np.testing.assert_array_equal(found["bound"], known["bound"])
    assert set(found) == set(known) and np.isnan(found["derivatives"][keys[0]][0, 0])
    found, known = gyration.bands(CHAIN, topology=True, mesh=12), told(tmp_path, "bands", "--topology", "--mesh", "12")
    np.testing.assert_array_equal(found["zak"], np.asarray(known["zak"], float))
    assert found["chern"] == known["chern"] == [] and set(found) == set(known)


def test_what_cannot_be_asked_of_bands_is_refused_and_instability_is_warned_of(ball):
    for arguments, words in [
        ({"path": "0,0"}, "no vertex"),
        ({"path": "0,0,0 0,0.5,0"}, "periodic"),
        ({"points": 0}, "above zero"),
        ({"complex": True, "mesh": 4}, "do not go together"),
        ({"along": "xx=0..1", "strain": "xx=1"}, "do not go together"),
        ({"omega": (0, 1)}, "do not go together"),
        ({"complex": True, "omega": (0, float("nan"))}, "no range"),
        ({"complex": True, "direction": 2}, "not periodic"),
        ({"topology": True, "bound": True}, "do not go together"),
        ({"derivatives": ["spring.0.stiffnes"]}, "stiffnes"),
        ({"strain": "xx=-2"}, "F̄"),
    ]:
        with pytest.raises(gyration.ArgumentError, match=words):
            gyration.bands(CHAIN, **arguments)
    with pytest.raises(gyration.ArgumentError, match="lattice"):
        gyration.bands(ball)
    with pytest.warns(UserWarning, match="unstable"):
        assert gyration.bands(CHAIN, points=3, strain="xx=-0.3")["warnings"]


def test_modes_of_a_system_are_under_the_names_of_its_bodies(tmp_path):
    found, known = gyration.modes(CHAIN), told(tmp_path, "modes")
    assert list(found) == ["a", "b", ("a", "b")]
    assert found["a"] == {"no_rest_state_because": None, "system": ("a", "b")}
    rest, system = known["systems"][0]["rest_state"], found["a", "b"]
    np.testing.assert_array_equal(system["frequency"], [mode["frequency"] for mode in rest["modes"]])
    np.testing.assert_array_equal(system["participation"], [mode["participation"] for mode in rest["modes"]])
    of_b = [mode["shape"]["b"]["translation"] for mode in rest["modes"]]
    np.testing.assert_array_equal(system["shape"]["b"]["translation"], of_b)
    np.testing.assert_array_equal(system["bodies"]["b"]["position"], rest["bodies"]["b"]["position"])
    # Of the whole lattice in step, 2k(1/m₁ + 1/m₂) along and across.
    np.testing.assert_allclose(system["frequency"][3:] ** 2, [1.8, 1.8, 9], rtol=1e-12)
    assert gyration.modes("elastic-bounce")["ball"]["system"] is None
