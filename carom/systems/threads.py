"""Threads: kernels that are shared out where the settings ask for more than one."""

from __future__ import annotations

import os
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from contextvars import copy_context
from functools import cache
from typing import TypeVar

import numba

from carom.ecs import World
from carom.ecs.component import Resource
from carom.systems.settings import Settings

Result = TypeVar("Result")
FEWEST = 2048  # groups of eight contacts or bodies below which handing some of them over takes longer than it saves


class Threads(Resource):
    """The other threads of a world, made when it first shares a kernel out among so many."""

    def __init__(self) -> None:
        self.pool: ThreadPoolExecutor | None = None
        self.parts = 1

    def run(self, parts: int, task: Callable[[int], Result]) -> list[Result]:
        """Run ``task`` for each of ``parts`` numbers, all at once: tasks may wait for each other."""
        if self.pool is None or self.parts != parts:
            self.pool, self.parts = ThreadPoolExecutor(parts - 1, thread_name_prefix="carom"), parts
        others = [self.pool.submit(copy_context().run, task, part) for part in range(1, parts)]
        return [task(0), *(other.result() for other in others)]


@cache  # to ask takes longer than most kernels
def processors() -> int:
    """Return how many processors there are: threads that wait for each other on one of them would only wait."""
    return os.cpu_count() or 1


def parts_for(world: World, count: int, fewest: int | None = None) -> int:
    """Return how many threads share ``count`` groups of eight; what they compute does not depend on it."""
    if count < (FEWEST if fewest is None else fewest) or numba.config.DISABLE_JIT:
        return 1
    return min(world[Settings].threads, processors())


def share_out(world: World, count: int, run: Callable[[int, int], Result], fewest: int | None = None) -> list[Result]:
    """Run ``run(begin, end)`` over slices of ``count`` groups of eight that do not touch each other, a thread each.

    Fewer than ``fewest``, of contacts or bodies `FEWEST`, are not worth it.
    """
    parts = parts_for(world, count, fewest)
    if parts == 1:
        return [run(0, count)]
    return world[Threads].run(parts, lambda part: run(count * part // parts, count * (part + 1) // parts))
