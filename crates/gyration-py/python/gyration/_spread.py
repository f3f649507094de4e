"""Spreads the runs of a study over an executor: batches of run numbers out, finished rows back.

The process that calls keeps the table; whoever works for it gets the study and some numbers, and returns their rows as texts, and the
recordings that the study wants as bytes: it may have no disk in common with the caller. A row depends on the study and its number alone,
so that it does not matter who computes it, or whether it was tried before.
"""

from __future__ import annotations

import queue
import sys
import time
from collections.abc import Callable
from typing import Any

from gyration import _gyration
from gyration._errors import ArgumentError, StudyError

AHEAD = 64
"""Batches that wait with the executor at any time: enough for every worker to have a next one."""
SECONDS = 1.0
"""How long a batch takes, about, if its size is not given [s]."""
LARGEST = 10_000
"""Runs in a batch, at most: its rows come back as one message."""
BYTES = 4e6
"""What the recordings of a batch come to, about: all that wait to be written are held in memory."""

Recordings = list[tuple[int, list[tuple[str, bytes]]]]
"""Of each run its number and the files of its recording."""


def rows(source: tuple[str, str, str, list[str]], numbers: list[int]) -> tuple[list[str], Recordings, float]:
    """The rows of these runs as lines of JSON, their recordings, and how long it took [s]; this is what a worker does."""
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
        return progress(work.done, work.total) is not False
    if progress:
        sys.stderr.write(f"\r{work.done} of {work.total} runs ")
    return True


def spread(
    work: Any, executor: Any, batch: int | None, progress: bool | Callable[[float, float], Any] | None
) -> None:
    """Has the missing rows computed by an executor; rows are in the table, on disk, as soon as they are back."""
    if batch is not None and batch < 1:
        raise ArgumentError(f"a batch of {batch} runs is none\n  fix: give `batch` from 1, or leave it out")
    back: queue.SimpleQueue[Any] = queue.SimpleQueue()
    waiting: dict[Any, list[int]] = {}
    size = batch or 1
    ahead = max(AHEAD, 4 * (getattr(executor, "_max_workers", None) or 1))
    try:
        while True:
            while len(waiting) < ahead and (numbers := work.take(size)):
                try:
                    future = executor.submit(rows, work.source, numbers)
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
            except Exception as error:
                raise given_up(work, error) from error
            work.append(numbers, lines, recordings)
            if not told(work, progress):
                return
            if batch is None:
                size = next_size(size, len(numbers), seconds, recordings)
    finally:
        for future in waiting:
            future.cancel()
        if progress is True:
            sys.stderr.write("\n")


def given_up(work: Any, error: Exception) -> StudyError:
    """What to raise when the executor breaks."""
    return StudyError(
        f"the executor gave up after {work.done} of {work.total} runs: {type(error).__name__}: {error}\n"
        f"  fix: nothing is lost; go on with gyration.study(..., output={str(work.path)!r}, resume=True)"
    )
