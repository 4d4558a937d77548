"""States: who is awake, who might fall asleep, who sleeps, in which island, and who keeps it awake."""

from __future__ import annotations

from collections.abc import Mapping
from typing import ClassVar

import numpy as np

from carom.ecs import Motion
from carom.ecs.column import Column
from carom.systems.links import all_islands, companies
from carom.systems.simulation import Simulation
from carom.systems.sleep_state import STATES, most_restless, pushed_bodies, sleep_states
from carom.tools.recorder.block import Columns
from carom.tools.recorder.rows import RowTrack, handle, text

NOBODY = -1


class States(RowTrack):
    """The state of every body that can be pushed."""

    key: ClassVar[str] = "states"
    detail: ClassVar[str] = "full"
    path: ClassVar[str] = "states"
    columns: ClassVar[Mapping[str, Column]] = {
        "body": handle("whose state it is"),
        "state": text("awake, eligible (slow enough to fall asleep) or asleep"),
        "still": Motion.columns["still"],
        "island": handle("the first body of its island"),
        "kept_awake_by": handle("who of its island, or of one near it, has been still the shortest time; -1 asleep"),
    }

    def rows(self, simulation: Simulation) -> Columns:
        """Return a row for each body."""
        world = simulation.world
        rows = pushed_bodies(world)
        island, state = all_islands(world)[rows], sleep_states(world, rows)
        restless = world.entities(most_restless(world, rows, companies(world)[rows]))
        return {
            "body": world.entities(rows),
            "state": np.array(STATES)[state],
            "still": world[Motion].still[rows],
            "island": world.entities(island),
            "kept_awake_by": np.where(state == STATES.index("asleep"), NOBODY, restless),
        }
