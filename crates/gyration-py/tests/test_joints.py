"""Joints, bounded friction, solid supports and adhesion between bodies, from Python."""

import numpy as np
import pytest

import gyration

TORQUE = {"sine": {"amplitude": 0.03, "frequency": 0.5}}
WHEEL = {
    "title": "A wheel that a torque turns",
    "world": {"gravity": [0, 0, 0]},
    "time": {"end": 0.5, "sample": 0.05},
    "body": [{"name": "wheel", "shape": {"cylinder": {"radius": 0.2, "height": 0.1}}, "mass": 1.0}],
    "joint": [
        {
            "name": "axle",
            "between": ["space", "wheel"],
            "kind": "hinge",
            "axis": [0, 0, 1],
            "drive": {"torque": TORQUE},
        }
    ],
}
INERTIA = 0.5 * 0.2**2


def test_a_wheel_turns_as_its_torque_says():
    recording = gyration.Scene.from_dict(WHEEL).run()
    omega, time = np.pi, recording["time"]
    exact = 0.03 / (INERTIA * omega**2) * (omega * time - np.sin(omega * time))
    np.testing.assert_allclose(recording["joint.axle.angle"], exact, atol=1e-10)
    work = 0.5 * (0.03 / omega * (1 - np.cos(omega * time))) ** 2 / INERTIA
    np.testing.assert_allclose(recording["work.load"], work, atol=1e-10)
    with pytest.raises(gyration.SceneError, match=r"joint\.axle\.drive\.torque\.sine"):
        gyration.Scene.from_dict(WHEEL).edit({"joint.axle.drive.torque.sine.frequency": "2 m"})


def test_derivatives_by_numbers_of_a_drive_are_those_of_the_closed_form():
    scene = gyration.Scene.from_dict(WHEEL)
    key = "joint.axle.drive.torque.sine.amplitude"
    found = gyration.sensitivities(scene, [key], ["joint.axle.angle"])
    exact = (0.5 * np.pi - 1) / (INERTIA * np.pi**2)
    np.testing.assert_allclose(found["derivatives"][0, 0], exact, rtol=1e-7)


def test_a_block_creeps_on_a_slope_that_holds_it():
    # tan θ / (c √(1 − (tan θ/μ)²)) with c = β/α.
    slope, mu, alpha, beta = 0.25, 0.5, 1e3, 2e6
    normal = np.array([-slope, 0, 1]) / np.hypot(1, slope)
    law = {"nu": 6, "d0": 1e-3}
    block = {
        "world": {"gravity": [0, 0, -9.81]},
        "time": {"end": 1.0, "sample": 0.5},
        "support": [{"name": "slope", "shape": {"box": {"size": [4, 4, 0.2]}}, "position": (-0.1 * normal).tolist()}],
        "contact": [
            {
                "support": "slope",
                "repulsion": {"alpha": alpha, **law},
                "damping": {"beta": 1e5, **law},
                "friction": {"beta": beta, "mu": mu, **law},
            }
        ],
        "body": [{"name": "block", "shape": {"box": {"size": [0.1, 0.1, 0.05]}}, "density": 1000}],
    }
    turn = {"axis_angle": {"axis": [0, 1, 0], "angle": -float(np.arctan(slope))}}
    block["support"][0]["orientation"] = turn
    block["body"][0] |= {"orientation": turn, "position": (0.0261 * normal).tolist()}
    recording = gyration.Scene.from_dict(block).run()
    velocity = [recording[f"block.v{axis}"][-1] for axis in "xyz"]
    creep = slope / (beta / alpha * np.sqrt(1 - (slope / mu) ** 2))
    np.testing.assert_allclose(np.linalg.norm(velocity), creep, rtol=1e-3)


def test_two_balls_that_attract_one_another_keep_their_energy_and_momentum():
    balls = [
        {"name": name, "shape": {"sphere": {"radius": 0.05}}, "mass": 1.0, "position": [x, 0, 0], "velocity": [v, 0, 0]}
        for name, x, v in [("a", -0.053, 0.01), ("b", 0.053, 0.0)]
    ]
    adhesion = {"beta": 1e3, "nu_attractive": 3, "nu_repulsive": 9, "d0": 1e-3}
    scene = {
        "world": {"gravity": [0, 0, 0]},
        "time": {"end": 0.5, "sample": 0.05},
        "contact": [{"between": ["a", "b"], "adhesion": adhesion}],
        "body": balls,
    }
    recording = gyration.Scene.from_dict(scene).run()
    np.testing.assert_allclose(recording["a.vx"] + recording["b.vx"], 0.01, atol=1e-15)
    assert recording.attrs["ledger"] == "closed"
    assert (recording["b.x"] - recording["a.x"]).max() < 0.11
