"""Asked: what was asked of a world's space in the last two frames, for observers; no bit of a run depends on it."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from carom.ecs import World
from carom.ecs.column import Floats, Integers
from carom.ecs.component import Resource

MOST = 10_000  # rows that are kept of a frame; a batch of rays may be any number
REACH = 100.0  # m, as far as what meets nothing on an endless way is told of
NOBODY = -1


class Question(NamedTuple):
    """A batch that was asked at once: what, by which system (none between steps), and what its caller calls it.

    A row is what was met, or a query that met nobody: from ``origin`` (n, 3), m, to ``end`` (n, 3), m, where ``entity``
    (n,) was met, -1 for nobody.
    """

    frame: int
    query: str
    system: str
    tag: str
    origin: Floats
    end: Floats
    entity: Integers


class Asked(Resource):
    """The questions of this frame and the one before, where anybody listens; ``left_out`` counts rows over `MOST`."""

    def __init__(self) -> None:
        self.listeners = 0
        self.questions: list[Question] = []
        self.left_out: dict[int, int] = {}

    def of(self, frame: int) -> list[Question]:
        """Return the questions that were asked in a frame."""
        return [question for question in self.questions if question.frame == frame]


def note(
    world: World, query: str, tag: str, origin: Floats, way: Floats, which: Integers, entity: Integers, point: Floats
) -> None:
    """Keep a batch from ``origin`` (n, 3) along ``way`` (n, 3), both m, of which ``which`` (m,) met somebody.

    ``entity`` (m,) are they, ``point`` (m, 3), m, where.
    """
    asked = world[Asked]
    if not asked.listeners:
        return
    frame, missed = world.frame, np.setdiff1d(np.arange(len(origin)), which)
    asked.questions = [question for question in asked.questions if question.frame >= frame - 1]
    asked.left_out = {at: count for at, count in asked.left_out.items() if at >= frame - 1}
    room = MOST - sum(len(question.entity) for question in asked.of(frame))
    rows = np.concatenate([which, missed])
    ends = np.concatenate([point, (origin + way)[missed]])
    entities = np.concatenate([entity, np.full(len(missed), NOBODY)])
    if len(rows) > room:
        asked.left_out[frame] = asked.left_out.get(frame, 0) + len(rows) - room
    system = "" if world.running is None else world.running.name
    found = origin[rows[:room]], ends[:room], entities[:room]
    asked.questions.append(Question(frame, query, system, tag, *found))
