"""Asked: what was asked of a world's space in the last two frames, for observers; no bit of a run depends on it."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from carom.ecs import World
from carom.ecs.column import Floats, Integers
from carom.ecs.component import Resource
from carom.systems.queries.filters import Filters

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
    world: World,
    query: str,
    filters: Filters,
    origin: Floats,
    which: Integers,
    entity: Integers,
    point: Floats,
    direction: Floats | None = None,
    reach: Floats | None = None,
) -> None:
    """Keep a batch from ``origin`` (n, 3), m, of which ``which`` (m,) met ``entity`` (m,) at ``point`` (m, 3), m.

    A query that looks along ``direction`` (n, 3), unit, and meets nobody ends at its ``reach`` (n,), m.
    """
    asked = world[Asked]
    if not asked.listeners:
        return
    frame, missed = world.frame, np.setdiff1d(np.arange(len(origin)), which)
    asked.questions = [question for question in asked.questions if question.frame >= frame - 1]
    asked.left_out = {at: count for at, count in asked.left_out.items() if at >= frame - 1}
    room = MOST - sum(len(question.entity) for question in asked.of(frame))
    rows, ends = np.concatenate([which, missed]), origin[missed]
    if direction is not None and reach is not None:
        ends = ends + np.minimum(reach[missed], REACH)[:, None] * direction[missed]
    if len(rows) > room:
        asked.left_out[frame] = asked.left_out.get(frame, 0) + len(rows) - room
    found = origin[rows], np.concatenate([point, ends]), np.concatenate([entity, np.full(len(missed), NOBODY)])
    system = "" if world.running is None else world.running.name
    told = (column[:room] for column in found)
    asked.questions.append(Question(frame, query, system, filters.get("tag", ""), *told))
