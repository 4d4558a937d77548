"""Threads: those that share kernels where the settings ask for more than one."""

from __future__ import annotations

import os
from collections.abc import Sequence
from functools import cache
from threading import Lock, Thread
from weakref import finalize

import numba

from carom.ecs import World
from carom.ecs.column import Integers
from carom.ecs.component import Resource
from carom.systems.kernels.crew import ALONE, SHIFT, make_crew, serve
from carom.systems.settings import Settings

FEWEST = 1024  # bodies, pairs or contacts below which sharing takes about as long as it saves


class Threads(Resource):
    """The crew of a world, and the context of a step: its other threads come when that first has work to share."""

    def __init__(self) -> None:
        self.crew = ALONE
        self.stepping = self._called = self._wanted = False
        self._parts, self._bells = 1, list[Lock]()
        self._dismissal: finalize[..., Threads] | None = None

    def __enter__(self) -> None:
        """Let work be shared until this is left; who had some in the step before is called at once."""
        self.stepping = True
        if self._wanted:
            self._call()
        self._wanted = False

    def __exit__(self, *fault: object) -> None:
        """Send those away who have been called."""
        self.stepping = False
        self._send_away()

    def call(self, parts: int) -> Integers:
        """Return a crew of so many threads, called if they have not been in this step."""
        self._wanted = True
        if self._parts != parts:
            self._send_away()
            self._engage(parts)
        if not self._called:
            self._call()
        return self.crew

    def _call(self) -> None:
        self._called = True
        self.crew[SHIFT] += 1
        ring(self._bells)

    def _send_away(self) -> None:
        if self._called:
            self._called = False
            self.crew[SHIFT] += 1

    def _engage(self, parts: int) -> None:
        if self._dismissal:
            self._dismissal()
        serve(make_crew(2), 1, 0)  # compiled before anybody waits for it
        self.crew, self._parts, self._bells = make_crew(parts), parts, [Lock() for _ in range(1, parts)]
        for part, bell in enumerate(self._bells, 1):
            bell.acquire()
            Thread(target=work, args=(self.crew, part, bell), name=f"carom {part}", daemon=True).start()
        self._dismissal = finalize(self, dismiss, self.crew, self._bells)


def work(crew: Integers, part: int, bell: Lock) -> None:
    """Take a part of what there is to do whenever the bell rings, until dismissed."""
    while True:
        bell.acquire()
        shift = int(crew[SHIFT])
        if shift < 0:
            return
        if shift % 2 == 0:  # else it is over already
            serve(crew, part, shift)


def dismiss(crew: Integers, bells: Sequence[Lock]) -> None:
    """Let threads end."""
    crew[SHIFT] = -1
    ring(bells)


def ring(bells: Sequence[Lock]) -> None:
    """Wake threads; those that have not heard the last time do now."""
    for bell in bells:
        if bell.locked():
            bell.release()


@cache  # to ask takes longer than most kernels
def processors() -> int:
    """Return how many processors there are: threads that wait for each other on one of them would only wait."""
    return os.cpu_count() or 1


def crew_for(world: World, count: int) -> Integers:
    """Return who shares work on ``count`` bodies, pairs or contacts; what they compute does not depend on it."""
    if count < FEWEST or (stated := world[Settings].threads) == 1 or numba.config.DISABLE_JIT:
        return ALONE
    threads, parts = world[Threads], min(stated, processors())
    return threads.call(parts) if parts > 1 and threads.stepping else ALONE
