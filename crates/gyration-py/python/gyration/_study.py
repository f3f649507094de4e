"""`gyration.study`: thousands of runs into one table."""

from __future__ import annotations

import os
import weakref
from collections.abc import Callable
from typing import Any, Literal

from gyration import _gyration
from gyration._spread import check, spread

__all__ = ["study"]

_locks: weakref.WeakSet[_gyration._Lock] = weakref.WeakSet()
"""Those of the tables that this process is making."""


def _leave() -> None:
    """Leaves the locks to the process from which this one was forked: its tables are locked as long as it lives, not longer."""
    for lock in list(_locks):
        lock.leave()


if hasattr(os, "register_at_fork"):
    os.register_at_fork(after_in_child=_leave)


def study(
    source: str | os.PathLike[str] | dict[str, Any],
    output: str | os.PathLike[str] | None = None,
    *,
    changes: dict[str, Any] | None = None,
    executor: Any = None,
    threads: int | None = None,
    resume: bool | Literal["auto"] = False,
    force: bool = False,
    batch: int | None = None,
    progress: bool | Callable[[float, float], Any] | None = None,
) -> _gyration.Table:
    """Makes the runs of a study and returns its table.

    ``source`` is a study file, the name of a ready study (:func:`studies`) or a dictionary of the keys of a study file;
    ``changes`` are changes of it by dotted key, ``{"repetitions": 100}``. ``output`` is the folder of the table, ``NAME.study`` in
    the current folder if it is not given.

    The runs are computed on ``threads`` of this process, on all cores if it is not given; or by an ``executor`` with the interface of
    ``concurrent.futures``: ``ProcessPoolExecutor``, ``client.get_executor()`` of Dask, ``MPIPoolExecutor`` of mpi4py, those of Ray and
    Parsl. It gets batches of ``batch`` runs, or of what takes about a second. The table has the same bytes whoever computes it, and so
    have the recordings that the study keeps: workers send them back.

    ``resume=True`` goes on with a table that is there, ``resume="auto"`` does so if there is one, ``force=True`` replaces it.
    ``progress`` is True for a line on stderr, or a function of (runs done, runs in all), which stops by returning False. A run that
    fails is a row with a reason. Whatever ends a study early, finished rows are kept: ``StudyError`` and ``KeyboardInterrupt`` say how
    to go on.
    """
    check(executor, batch)
    work = _gyration._Work(source, output, changes, resume, force, threads, progress)
    lock = work.lock
    _locks.add(lock)
    try:
        if executor is None:
            work.execute(threads, progress)
        else:
            spread(work, executor, batch, progress)
        work.finish()
    finally:
        # An exception keeps what it went through: the table must be free all the same.
        work.close()
    return _gyration.Table.open(work.path)
