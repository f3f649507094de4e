"""A run as a function of numbers of its scene, with its Jacobian: what :mod:`gyration.jax` and :mod:`gyration.torch` wrap."""

from __future__ import annotations

import os
import weakref
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from typing import Any

import numpy as np
import numpy.typing as npt

from gyration import _gyration
from gyration._errors import ArgumentError, RunError

Array = npt.NDArray[np.float64]


_begun: weakref.WeakSet[Differentiable] = weakref.WeakSet()
"""Those that have a thread in this process."""


def _begin_again() -> None:
    """Begins the threads that a fork has left behind."""
    for run in list(_begun):
        run._begin()


if hasattr(os, "register_at_fork"):
    os.register_at_fork(after_in_child=_begin_again)


class Differentiable:
    """Quantities at the end of a run by numbers of the scene, in SI units: R^n to R^m."""

    def __init__(self, scene: Any, keys: Sequence[str], quantities: Sequence[str]) -> None:
        self.scene = scene if isinstance(scene, _gyration.Scene) else opened(scene)
        self.keys, self.quantities = names("keys", keys), names("quantities", quantities)
        known: dict[str, str] = {}
        resolved = self.scene.resolved
        for key in self.keys:
            # A key that the scene does not have is told here, not in the midst of a trace.
            self.scene[key]
            number = place(resolved, key)
            if number in known:
                raise ArgumentError(f"{known[number]} and {key} are the same number\n  fix: leave one of them out")
            known[number] = key
        self._last: tuple[bytes, Array, Array] | None = None
        self._begin()
        _begun.add(self)

    def _begin(self) -> None:
        """Begins the thread: not in a call of XLA, whose smallest numbers are zero for whatever thread is begun there."""
        self._thread = ThreadPoolExecutor(max_workers=1)
        self._thread.submit(int).result()

    def at(self, x: npt.ArrayLike) -> tuple[Array, Array]:
        """The quantities, (m,), and their derivatives, (m, n), of a run with these numbers, (n,).

        Raises ``SceneError`` if they make no scene, ``RunError`` if the run fails or a derivative means nothing.
        """
        numbers = np.asarray(x, dtype=np.float64)
        if numbers.shape != (len(self.keys),):
            raise ArgumentError(
                f"an argument of the shape {numbers.shape}\n  fix: give {len(self.keys)} numbers, those of {', '.join(self.keys)}"
            )
        return self._thread.submit(self._found, numbers).result()

    def _found(self, numbers: Array) -> tuple[Array, Array]:
        # What asks for the value asks for the derivatives next.
        if self._last is None or self._last[0] != numbers.tobytes():
            edited = self.scene.edit(dict(zip(self.keys, numbers.tolist())))
            found = _gyration.sensitivities(edited, self.keys, self.quantities)
            lost = [f"{key}: {reason}" for key, reason in found["reasons"].items() if reason is not None]
            if lost:
                raise RunError("there is no derivative by " + "; ".join(lost))
            self._last = (numbers.tobytes(), found["values"], found["derivatives"])
        return self._last[1].copy(), self._last[2].copy()


def place(resolved: Any, key: str) -> str:
    """A dotted key with numbers in the place of names: the same for the same value."""
    words = []
    for word in key.split("."):
        if not isinstance(resolved, dict):
            called = [item.get("name") if isinstance(item, dict) else None for item in resolved]
            word = str(called.index(word) if word in called else int(word))
        words.append(word)
        resolved = resolved[word] if isinstance(resolved, dict) else resolved[int(word)]
    return ".".join(words)


def opened(scene: Any) -> _gyration.Scene:
    """The scene of a dictionary, a path or a name of the gallery."""
    if isinstance(scene, dict):
        return _gyration.Scene.from_dict(scene)
    if scene in _gyration.scenes():
        return _gyration.Scene.gallery(scene)
    return _gyration.Scene.from_file(scene)


def names(what: str, given: Sequence[str]) -> list[str]:
    """A list of names; not one name, whose letters would be taken for names."""
    if isinstance(given, str) or not given:
        raise ArgumentError(f"`{what}` is {given!r}\n  fix: give a list of names")
    return list(given)
