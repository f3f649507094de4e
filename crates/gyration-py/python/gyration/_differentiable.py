"""A run as a function of numbers of its scene, with its Jacobian: what :mod:`gyration.jax` and :mod:`gyration.torch` wrap."""

from __future__ import annotations

import os
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from typing import Any

import numpy as np
import numpy.typing as npt

from gyration import _gyration
from gyration._errors import ArgumentError, RunError

Array = npt.NDArray[np.float64]


class Differentiable:
    """Quantities at the end of a run by numbers of the scene, in SI units: R^n to R^m."""

    def __init__(self, scene: Any, keys: Sequence[str], quantities: Sequence[str]) -> None:
        self.scene = scene if isinstance(scene, _gyration.Scene) else opened(scene)
        self.keys, self.quantities = names("keys", keys), names("quantities", quantities)
        known: dict[str, str] = {}
        for key in self.keys:
            # A key that the scene does not have is told here, not in the midst of a trace.
            self.scene[key]
            first = known.setdefault(place(self.scene.resolved, key), key)
            if first is not key:
                raise ArgumentError(f"{first} and {key} are the same number\n  fix: leave one of them out")
        self._last: tuple[bytes, Array, Array] | None = None
        self._begin()

    def _begin(self) -> None:
        # The thread is begun here: XLA calls back with the smallest numbers flushed to zero, which a thread takes over from
        # whoever begins it, and with which no run comes off its first instant.
        self._thread = ThreadPoolExecutor(max_workers=1)
        self._thread.submit(int).result()
        self._process = os.getpid()

    def at(self, x: npt.ArrayLike) -> tuple[Array, Array]:
        """The quantities, (m,), and their derivatives, (m, n), of a run with these numbers, (n,).

        Raises ``SceneError`` if they make no scene, ``RunError`` if the run fails or a derivative means nothing.
        """
        numbers = np.asarray(x, dtype=np.float64)
        if numbers.shape != (len(self.keys),):
            raise ArgumentError(
                f"an argument of the shape {numbers.shape}\n  fix: give {len(self.keys)} numbers, those of {', '.join(self.keys)}"
            )
        if self._process != os.getpid():
            # A fork has left the thread behind.
            self._begin()
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
