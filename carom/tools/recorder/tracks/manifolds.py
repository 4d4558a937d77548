"""Manifolds: every point of every contact, also those that only may touch and those of bodies that sleep."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, ClassVar

import numpy as np

from carom.ecs import World
from carom.ecs.column import Column
from carom.ecs.relations.contact import Contact
from carom.systems.simulation import Simulation
from carom.tools.recorder.block import Block, Columns
from carom.tools.recorder.layout import Layout
from carom.tools.recorder.persistence import Persistence, both
from carom.tools.recorder.rows import RowTrack, handle, number, text
from carom.tools.recorder.stream import Stream
from carom.tools.recorder.track import Track

PATH = "world/manifolds"
COLORS = {"touching": 0xFF5A3CFF, "speculative": 0x9AA0A8FF, "asleep": 0x8CA0CCFF}
RADIUS = -4.0  # px


class Manifolds(RowTrack):
    """Points of contact with all that is known of them."""

    key: ClassVar[str] = "manifolds"
    detail: ClassVar[str] = "full"
    path: ClassVar[str] = PATH
    columns: ClassVar[Mapping[str, Column]] = {
        "a": handle("first collider"),
        "b": handle("second collider"),
        "feature": Contact.columns["feature"],
        "state": text("touching, speculative (may touch within the step) or asleep"),
        "found_by": text("which way it was computed: kernel or FCL"),
        **{name: Contact.columns[name] for name in ("depth", "normal", "impulse", "friction_impulse", "friction")},
        "age": number("s", "for how long it has been there, as far as the recording knows"),
        "warm_start": number("N s", "normal impulse of a substep from which the solver set out, 0 for a cold start"),
        "point": Contact.columns["point"],
    }
    drawn: ClassVar[Mapping[str, str]] = {"point": "Points3D:positions"}

    def __init__(self) -> None:
        super().__init__()
        self._persistence = Persistence()

    def begin(self, simulation: Simulation, stream: Stream, tracks: Mapping[str, Track]) -> None:
        """Write how large they are."""
        import rerun

        stream.static(PATH, rerun.Points3D.from_fields(radii=[RADIUS]))

    def lay_out(self, world: World, layout: Layout) -> None:
        """Show none, since those that touch are shown as contacts."""
        layout.hide(PATH)

    def watch(self, simulation: Simulation) -> None:
        """See who goes on."""
        self._persistence.watch(simulation.world)

    def rows(self, simulation: Simulation) -> Columns:
        """Return a row for each point."""
        world = simulation.world
        names = ("a", "b", "feature", "depth", "normal", "impulse", "friction_impulse", "friction", "point")
        rows = {name: both(world, name) for name in names}
        touches = (rows["depth"] >= 0.0) | (rows["impulse"] > 0.0)
        state = np.where(touches, "touching", "speculative")
        state[world[Contact].count :] = "asleep"
        return rows | {
            "state": state,
            "found_by": np.where(both(world, "by_fcl"), "FCL", "kernel"),
            "age": simulation.time - self._persistence.since,
            "warm_start": self._persistence.began_with.copy(),
        }

    def draw(self, block: Block, stream: Stream) -> Sequence[Any]:
        """Return the points, by state."""
        import rerun

        names, place = np.unique(block.columns["state"], return_inverse=True)
        colors = np.array([COLORS[name] for name in names.tolist()], np.uint32)[place.ravel()]
        return block.drawn(rerun.Points3D.from_fields(positions=block.columns["point"], colors=colors))
