"""What goes wrong, as exceptions; the messages are those of the program `gyration`."""

from typing import NamedTuple


class Diagnostic(NamedTuple):
    """One thing that is wrong in a scene or a study, and where."""

    file: str
    """The file as it was named, or ``--set`` for an edit."""
    line: int
    """Line, from one."""
    column: int
    """Column in characters, from one."""
    key: str
    """The dotted key, ``body.die.mass``; empty where none applies."""
    message: str
    """What is wrong."""
    help: str
    """What to do about it; may be empty."""


class Error(Exception):
    """Anything that this package refuses or cannot do."""


class SceneError(Error, ValueError):
    """A scene with something wrong in it: everything at once, in ``diagnostics``."""

    diagnostics: list[Diagnostic] = []


class FileError(Error, OSError):
    """A file or a recording that cannot be read or written."""

    def __str__(self) -> str:
        return str(self.args[0]) if self.args else ""


class ArgumentError(Error, ValueError):
    """Arguments that ask for something that is not to be had."""


class RunError(Error):
    """A run that cannot begin or go on."""

    reason: str | None = None
    """The kind of reason, ``"gap_closed"``; None where there is none."""
    time: float | None = None
    """When [s]."""
    body: str | None = None
    """The body concerned, by name."""


class PlotError(Error):
    """A picture that cannot be drawn."""


class StudyError(Error):
    """A study that cannot begin or go on; measurements that tell no numbers."""

    diagnostics: list[Diagnostic] = []
