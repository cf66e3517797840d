"""Episodes in parallel processes."""

from __future__ import annotations

import multiprocessing
import os
from collections.abc import Callable, Sequence
from concurrent.futures import ProcessPoolExecutor
from typing import Any, TypeVar

from dslkit.campaign import undisturbed

Result = TypeVar("Result")


def in_processes(work: Callable[..., Result], wanted: Sequence[tuple[Any, ...]]) -> list[Result]:
    """The result of each call, in their order. An error of one ends them all."""
    context = multiprocessing.get_context("spawn")
    with ProcessPoolExecutor(min(len(wanted), os.cpu_count() or 1), context) as pool:
        try:
            with undisturbed():
                running = [pool.submit(work, *each) for each in wanted]
            return [each.result() for each in running]
        except BaseException:
            for process in multiprocessing.active_children():  # otherwise the pool waits for them
                process.kill()
            raise
