"""Runs in PyTorch: quantities at the end of a run as a function of numbers of its scene, with exact derivatives.

    >>> throw = gyration.torch.function(scene, ["body.ball.velocity.0", "body.ball.velocity.2"], ["ball.x", "ball.z"])
    >>> throw(torch.tensor([1.0, 2.0], dtype=torch.float64, requires_grad=True))[0].backward()

Needs PyTorch (``pip install gyration[torch]``).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

from gyration._differentiable import Differentiable

__all__ = ["function"]


def function(scene: Any, keys: Sequence[str], quantities: Sequence[str]) -> Callable[[Any], Any]:
    """The function from numbers at ``keys``, (keys,), to ``quantities`` at the end of the run, (quantities,).

    ``scene`` is a scene, a dictionary, a path or a name of the gallery; keys, quantities and derivatives are those of
    :func:`gyration.sensitivities`, in SI units. The result has the type and device of the argument, can be differentiated once,
    and is computed in double precision on the host.

    Raises ``ArgumentError`` for no names or another shape and ``KeyError`` for a key that the scene does not have;
    ``RunError`` if the run fails or a derivative means nothing. ``ImportError`` says what to install.
    """
    try:
        import torch
    except ImportError as missing:
        raise ImportError(f"{missing}\n  fix: pip install gyration[torch]") from missing
    run = Differentiable(scene, keys, quantities)

    def forward(ctx: Any, x: Any) -> Any:
        values, derivatives = (x.new_tensor(found) for found in run.at(x.detach().cpu().numpy()))
        ctx.save_for_backward(derivatives)
        return values

    @torch.autograd.function.once_differentiable
    def backward(ctx: Any, change: Any) -> Any:
        (derivatives,) = ctx.saved_tensors
        return change @ derivatives

    methods = {"forward": staticmethod(forward), "backward": staticmethod(backward)}
    made: Any = type("Run", (torch.autograd.Function,), methods)
    return made.apply
