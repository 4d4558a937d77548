"""States: who is awake, who might fall asleep, who sleeps, in which island, and who keeps it awake."""

from __future__ import annotations

from collections.abc import Mapping
from typing import ClassVar

import numpy as np

from carom.ecs import Motion, RigidBody, Transform, World
from carom.ecs.column import Column
from carom.systems.simulation import Simulation
from carom.systems.sleep_state import STATES, most_restless, sleep_states
from carom.tools.coloring import SLEEP, islands
from carom.tools.recorder.block import Block, Columns
from carom.tools.recorder.layout import Layout
from carom.tools.recorder.rows import RowTrack, handle, text
from carom.tools.recorder.stream import Stream
from carom.tools.recorder.track import Track

PLOT = "plots/sleep"
NOBODY = -1


class States(RowTrack):
    """The state of every body that can be pushed; curves of how many are in each."""

    key: ClassVar[str] = "states"
    detail: ClassVar[str] = "full"
    path: ClassVar[str] = "states"
    columns: ClassVar[Mapping[str, Column]] = {
        "body": handle("whose state it is"),
        "state": text("awake, eligible (slow enough to fall asleep) or asleep"),
        "still": Motion.columns["still"],
        "island": handle("the first body of its island"),
        "kept_awake_by": handle("who of its island has been still for the shortest time; -1 where it sleeps"),
    }

    def begin(self, simulation: Simulation, stream: Stream, tracks: Mapping[str, Track]) -> None:
        """Write the colours of the curves."""
        import rerun

        for state in STATES[1:]:
            color = np.rint(255.0 * np.array(SLEEP[state])).astype(np.uint8)
            stream.static(f"{PLOT}/{state}", rerun.SeriesLines(colors=[color], widths=[2.0]))

    def lay_out(self, world: World, layout: Layout) -> None:
        """Show how many are in each state."""
        layout.plot(PLOT, "Bodies by state")

    def rows(self, simulation: Simulation) -> Columns:
        """Return a row for each body."""
        world = simulation.world
        rows = world.row_numbers(Transform, Motion, RigidBody)
        rows = rows[world[RigidBody].inverse_mass[rows] > 0.0]
        island, state = islands(world)[rows], sleep_states(world, rows)
        restless = world.entities(most_restless(world, rows, island))
        return {
            "body": world.entities(rows),
            "state": np.array(STATES)[state],
            "still": world[Motion].still[rows],
            "island": world.entities(island),
            "kept_awake_by": np.where(state == STATES.index("asleep"), NOBODY, restless),
        }

    def draw(self, block: Block, stream: Stream) -> None:
        """Write how many are in each state."""
        import rerun

        frame = np.repeat(np.arange(len(block.counts)), block.counts)
        for state in STATES[1:]:
            counts = np.bincount(frame[block.columns["state"] == state], minlength=len(block.counts))
            stream.rows(f"{PLOT}/{state}", block.stamps, rerun.Scalars.columns(scalars=counts))
