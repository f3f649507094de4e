"""Runs in JAX and PyTorch: derivatives agree with central differences."""

import numpy as np
import pytest

import gyration
from conftest import BALL
from gyration._differentiable import Differentiable

KEYS = ["body.ball.velocity.0", "body.ball.velocity.2", "contact.0.friction.beta"]
QUANTITIES = ["ball.x", "ball.vz"]
AT = np.array([0.4, -0.5, 300.0])
# Friction moves the ball a little; without sliding on the field of the table the two velocities are independent.
SCENE = dict(BALL, contact=[{**BALL["contact"][0], "friction": {"beta": 300, "nu": 6, "d0": "2 mm"}}])
SCENE["time"] = {"end": 0.35, "sample": 0.05}
SCENE["solver"] = {"rtol": 1e-11, "atol": 1e-13}


@pytest.fixture(scope="module")
def differences():
    """(quantities, keys), of runs to errors of some 1e-10: of a step of 1e-3 1e-7 is left."""
    run = Differentiable(SCENE, KEYS, QUANTITIES)
    columns = []
    for k, at in enumerate(AT):
        step = np.zeros(3)
        step[k] = 1e-3 * abs(at)
        # Of fourth order: what a cubic leaves of an impact is beyond the tolerance.
        one, two = ((run.at(AT + m * step)[0] - run.at(AT - m * step)[0]) / (2 * m * step[k]) for m in [1, 2])
        columns.append((4 * one - two) / 3)
    return np.stack(columns, axis=1)


def test_a_run_is_a_function_with_its_jacobian(differences):
    values, derivatives = Differentiable(SCENE, KEYS, QUANTITIES).at(AT)
    np.testing.assert_allclose(derivatives, differences, rtol=1e-6, atol=1e-9)
    edited = gyration.Scene.from_dict(SCENE).edit(dict(zip(KEYS, AT.tolist())))
    np.testing.assert_allclose(values, [edited.run()[name][-1] for name in QUANTITIES], rtol=1e-9)


def test_jax_has_the_derivatives_of_differences(differences):
    jax = pytest.importorskip("jax", reason="JAX is not installed: pip install gyration[jax]")
    from gyration.jax import function

    jax.config.update("jax_enable_x64", True)
    run = function(SCENE, KEYS, QUANTITIES)
    for jacobian in [jax.jacrev(run), jax.jacfwd(run), jax.jit(jax.jacrev(run))]:
        np.testing.assert_allclose(jacobian(AT), differences, rtol=1e-6, atol=1e-9)
    slope = jax.grad(lambda x: (run(x) ** 2).sum())(AT)
    np.testing.assert_allclose(slope, 2 * np.asarray(run(AT)) @ differences, rtol=1e-6)
    many = jax.vmap(run)(np.stack([AT, AT + [0.1, 0, 0]]))
    assert many.shape == (2, 2) and (np.asarray(many[0]) == np.asarray(run(AT))).all()
    with pytest.raises(Exception, match="fix: give 3 numbers"):
        run(np.zeros(2)).block_until_ready()


def test_torch_has_the_derivatives_of_differences(differences):
    torch = pytest.importorskip("torch", reason="PyTorch is not installed: pip install gyration[torch]")
    from gyration.torch import function

    run = function(SCENE, KEYS, QUANTITIES)
    at = torch.tensor(AT, requires_grad=True)
    jacobian = torch.autograd.functional.jacobian(run, at)
    np.testing.assert_allclose(jacobian.numpy(), differences, rtol=1e-6, atol=1e-9)
    (run(at) ** 2).sum().backward()
    np.testing.assert_allclose(at.grad.numpy(), 2 * run(at).detach().numpy() @ differences, rtol=1e-6)
    assert run(at.detach().float()).dtype == torch.float32


def test_what_cannot_be_differentiated_says_why():
    with pytest.raises(gyration.ArgumentError, match="fix: give a list"):
        Differentiable(SCENE, "body.ball.velocity.0", QUANTITIES)
    with pytest.raises(KeyError, match="no `cube`"):
        Differentiable(SCENE, ["body.cube.velocity.0"], QUANTITIES)
    # The same number by another name, or by its own.
    for again in ["body.0.velocity.0", "body.ball.velocity.0"]:
        with pytest.raises(gyration.ArgumentError, match="are the same number"):
            Differentiable(SCENE, ["body.ball.velocity.0", again], QUANTITIES)
    with pytest.raises(gyration.ArgumentError, match="fix: give 3 numbers"):
        Differentiable(SCENE, KEYS, QUANTITIES).at([1.0])
    with pytest.raises(gyration.SceneError):
        Differentiable(SCENE, ["body.ball.density"], ["ball.x"]).at([-1.0])
