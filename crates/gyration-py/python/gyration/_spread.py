"""Spreads the runs of a study over an executor: batches of run numbers out, finished rows back.

The process that calls keeps the table; whoever works for it gets the study and some numbers, and returns their rows as texts, and the
recordings that the study wants as bytes: it may have no disk in common with the caller. A row depends on the study and its number alone,
so that it does not matter who computes it, or whether it was tried before.
"""

from __future__ import annotations

import os
import queue
import sys
import time
import uuid
from collections.abc import Callable
from concurrent.futures import BrokenExecutor, CancelledError
from typing import Any

from gyration import _gyration
from gyration._errors import ArgumentError, Error, StudyError

AHEAD = 64
"""Batches that wait with the executor at any time, at least."""
EACH = 4
"""Batches that wait for each worker of a pool: enough to have a next one."""
ELASTIC = 16
"""The same for a thread of Dask, whose clusters grow as long as what waits takes much longer than five seconds."""
COUNTED = 5.0
"""How long the number of Dask's threads is believed [s]."""
SECONDS = 1.0
"""How long a batch takes, about, if its size is not given [s]."""
LARGEST = 10_000
"""Runs in a batch, at most: its rows come back as one message."""
BYTES = 4e6
"""What the recordings of a batch come to, about: all that wait to be written are held in memory."""

Source = tuple[str, str, os.PathLike[str], list[str], str]
"""A study as another process opens it."""
Recordings = list[tuple[int, list[tuple[str, bytes]]]]
"""Of each run its number and the files of its recording."""


def rows(source: Source, numbers: list[int], attempt: str) -> tuple[list[str], Recordings, float]:
    """The rows of these runs as lines of JSON, their recordings, and how long it took [s]; this is what a worker does.

    Dask takes a call with the same arguments for the same call: `attempt` tells one from another, lest an old failure be the answer.
    """
    began = time.perf_counter()
    lines, recordings = _gyration._study_rows(source, numbers)
    return lines, recordings, time.perf_counter() - began


def next_size(size: int, runs: int, seconds: float, recordings: Recordings) -> int:
    """How many runs the next batch has, after one of so many runs."""
    weight = sum(len(content) for _, files in recordings for _, content in files)
    batches = max(seconds / SECONDS, weight / BYTES, 1e-6)
    return max(1, min(LARGEST, int(runs / batches), 8 * size))


def told(work: Any, progress: bool | Callable[[float, float], Any] | None) -> bool:
    """Tells how many rows there are; whether to go on."""
    if callable(progress):
        return not _gyration._says_stop(progress(work.done, work.total))
    if progress:
        sys.stderr.write(f"\r{work.done} of {work.total} runs ")
    return True


class Room:
    """How many batches are to wait with an executor."""

    def __init__(self, executor: Any) -> None:
        self.executor = executor
        self.ahead = max(AHEAD, EACH * (getattr(executor, "_max_workers", None) or 1))
        self.counted = float("-inf")

    def now(self) -> int:
        """As many now: workers of Dask come and go."""
        client = getattr(self.executor, "_client", None)
        if client is not None and hasattr(client, "nthreads") and time.monotonic() - self.counted >= COUNTED:
            threads = sum(client.nthreads().values())
            self.ahead = max(AHEAD, ELASTIC * threads)
            self.counted = time.monotonic()
        return self.ahead


def check(executor: Any, batch: int | None) -> None:
    """Refuses what is no executor, and batches without runs."""
    if executor is not None and not callable(getattr(executor, "submit", None)):
        raise ArgumentError(f"`executor` is {executor!r}\n  fix: give one with the interface of concurrent.futures, or leave it out")
    if batch is not None and batch < 1:
        raise ArgumentError(f"a batch of {batch} runs is none\n  fix: give `batch` from 1, or leave it out")


def spread(
    work: Any, executor: Any, batch: int | None, progress: bool | Callable[[float, float], Any] | None
) -> None:
    """Has the missing rows computed by an executor; rows are in the table, on disk, as soon as they are back.

    A batch that fails is given to the executor once more.
    """
    back: queue.SimpleQueue[Any] = queue.SimpleQueue()
    waiting: dict[Any, list[int]] = {}
    lost: list[list[int]] = []
    again: set[int] = set()
    size, source, attempt, room = batch or 1, work.source, uuid.uuid4().hex, Room(executor)
    try:
        while True:
            try:
                ahead = room.now()
            except Exception as error:
                raise given_up(work, error) from error
            while len(waiting) < ahead and (numbers := lost.pop() if lost else work.take(size)):
                try:
                    future = executor.submit(rows, source, numbers, attempt)
                except BrokenExecutor:
                    raise
                except Exception as error:
                    raise given_up(work, error) from error
                waiting[future] = numbers
                future.add_done_callback(back.put)
            if not waiting:
                return
            try:
                # A while only, so that Ctrl-C is heard.
                future = back.get(timeout=0.2)
            except queue.Empty:
                continue
            numbers = waiting.pop(future)
            try:
                lines, recordings, seconds = future.result()
            except BrokenExecutor:
                raise
            except (CancelledError, Error) as error:
                raise given_up(work, error) from error
            except Exception as error:
                # Some executors lose what a worker had sent just before it died, and tell of it in errors of their own.
                if not again.isdisjoint(numbers):
                    raise given_up(work, error) from error
                again.update(numbers)
                lost.append(numbers)
                continue
            work.append(numbers, lines, recordings)
            if not told(work, progress):
                return
            if batch is None:
                size = next_size(size, len(numbers), seconds, recordings)
    except KeyboardInterrupt:
        raise KeyboardInterrupt(f"finished rows are kept; {way_on(work)}") from None
    except BrokenExecutor as error:
        # It ends its futures by itself, and some do not bear that another one cancels them meanwhile.
        waiting.clear()
        raise given_up(work, error) from error
    finally:
        for future in waiting:
            future.cancel()
        if progress is True:
            sys.stderr.write("\n")


def given_up(work: Any, error: Exception) -> StudyError:
    """What to raise when the executor breaks."""
    return StudyError(
        f"the executor gave up after {work.done} of {work.total} runs: {type(error).__name__}: {error}\n"
        f"  fix: nothing is lost; {way_on(work)}"
    )


def way_on(work: Any) -> str:
    """What to do for the rest of the runs."""
    return f"go on with gyration.study(..., output={str(work.path)!r}, resume=True)"
