"""Newborn: how many particles of each emitter were born in the step, which are the last of its rows."""

from __future__ import annotations

from carom.ecs.component import Resource


class Newborn(Resource):
    """Counts by handle; of one step only."""

    def __init__(self) -> None:
        self.counts: dict[int, int] = {}
