"""Spreads the runs of a study over an executor: batches of run numbers out, finished rows back.

The process that calls keeps the table; whoever works for it gets the study and some numbers, and returns their rows as texts. A row
depends on the study and its number alone, so that it does not matter who computes it, or whether it was tried before.
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


def rows(source: tuple[str, str, str, list[str]], numbers: list[int]) -> tuple[list[str], float]:
    """The rows of these runs as lines of JSON, and how long they took [s]; this is what a worker does."""
    began = time.perf_counter()
    return _gyration._study_rows(source, numbers), time.perf_counter() - began


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
    work.check_spread()
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
                lines, seconds = future.result()
            except Exception as error:
                raise given_up(work, error) from error
            work.append(numbers, lines)
            if not told(work, progress):
                return
            if batch is None:
                size = max(1, min(LARGEST, int(len(numbers) * SECONDS / max(seconds, 1e-6)), 8 * size))
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
