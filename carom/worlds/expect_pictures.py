"""Expectations of what a camera shows: ``crate >= 400 px from main``."""

from __future__ import annotations

import re

import numpy as np

from carom.ecs import World
from carom.systems.simulation import Simulation
from carom.worlds.condition import COMPARE, read_condition
from carom.worlds.errors import WordError
from carom.worlds.expect_moment import AtMoment, Event
from carom.worlds.terms import NAME_PATTERN

MARKS = "|".join(sorted(COMPARE, key=len, reverse=True))
FORM = re.compile(rf"\s*({NAME_PATTERN})\s*({MARKS})\s*(.+?)(?:\s+from\s+({NAME_PATTERN}))?\s*")


class Visible(AtMoment):
    """How many pixels show an entity, or which share of its silhouette, at a frame, at an event or at the end."""

    def __init__(self, text: str, world: World, *, frame: int | None = None, when: Event | None = None) -> None:
        found = FORM.fullmatch(text)
        if found is None:
            accepted = "'crate >= 400 px from main', or a share such as 'crate > 50 % from main'"
            raise WordError("tells nothing visible", received=repr(text), accepted=accepted)
        name, mark, value, camera = found.groups()
        question = "visible_share" if value.endswith("%") else "visible"
        asked = name if camera is None else f"{name}, {camera}"
        self.condition = read_condition(f"{question}({asked}) {mark} {value}", world)
        super().__init__(f"visible: {text}", self.condition.text, frame, when)
        self.looks = True

    def compare(self, simulation: Simulation, row: int | None) -> None:
        """Look at the picture of now."""
        there, holds, margin = self.condition.evaluate(simulation.world)
        if not there.any():
            self.worst = self.condition.absence(simulation.world)
            self.fail(simulation, self.worst)
            return
        index = int(np.argmin(np.where(there, margin, np.inf)))
        self.worst = self.condition.values(simulation.world, index)
        if not holds[there].all():
            self.fail(simulation, self.worst, self.condition.of(index))
