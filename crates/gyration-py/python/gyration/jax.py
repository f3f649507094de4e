"""Runs in JAX: quantities at the end of a run as a function of numbers of its scene, with exact derivatives.

    >>> throw = gyration.jax.function(scene, ["body.ball.velocity.0", "body.ball.velocity.2"], ["ball.x", "ball.z"])
    >>> jax.jacobian(throw)(jnp.array([1.0, 2.0]))

Needs JAX (``pip install gyration[jax]``), and its 64 bits for more than single precision:
``jax.config.update("jax_enable_x64", True)``.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from gyration._differentiable import Differentiable

__all__ = ["function"]


def function(scene: Any, keys: Sequence[str], quantities: Sequence[str]) -> Callable[[Any], Any]:
    """The function from numbers at ``keys``, (keys,), to ``quantities`` at the end of the run, (quantities,).

    ``scene`` is a scene, a dictionary, a path or a name of the gallery; keys, quantities and derivatives are those of
    :func:`gyration.sensitivities`, in SI units. The function can be differentiated once, forward and backward, and stands in ``jit``,
    ``vmap`` (one run after the other), ``grad``, ``jacobian``: the run is a callback on the host.

    Raises ``ArgumentError`` for no names and ``KeyError`` for a key that the scene does not have; a run that fails is an error of
    JAX with the words of ``RunError``. ``ImportError`` says what to install.
    """
    try:
        import jax
    except ImportError as missing:
        raise ImportError(f"{missing}\n  fix: pip install gyration[jax]") from missing
    run = Differentiable(scene, keys, quantities)
    rows, columns = len(run.quantities), len(run.keys)

    def typed(x: Any, shape: tuple[int, ...]) -> Any:
        return jax.ShapeDtypeStruct(shape, jax.numpy.result_type(float, x))

    def values(x: Any) -> Any:
        wanted = typed(x, (rows,))
        return jax.pure_callback(lambda x: run.at(x)[0].astype(wanted.dtype), wanted, x, vmap_method="sequential")

    def both(x: Any) -> Any:
        wanted = (typed(x, (rows,)), typed(x, (rows, columns)))
        host = lambda x: tuple(np.asarray(found, wanted[0].dtype) for found in run.at(x))
        return jax.pure_callback(host, wanted, x, vmap_method="sequential")

    differentiable = jax.custom_jvp(lambda x: values(jax.numpy.asarray(x)))

    @differentiable.defjvp
    def push(primals: Any, tangents: Any) -> Any:
        value, derivatives = both(jax.numpy.asarray(primals[0]))
        return value, derivatives @ tangents[0].astype(derivatives.dtype)

    return differentiable
