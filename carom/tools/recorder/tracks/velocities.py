"""Velocities: how fast every body goes and turns, as numbers and arrows."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, ClassVar

from carom.ecs import Motion, RigidBody, Transform, World
from carom.ecs.column import Column
from carom.systems.bodies import centers_of_mass
from carom.systems.simulation import Simulation
from carom.tools.recorder.block import Block, Columns
from carom.tools.recorder.layout import Layout
from carom.tools.recorder.rows import RowTrack, handle, number
from carom.tools.recorder.stream import Stream
from carom.tools.recorder.track import Track

LINEAR, ANGULAR = "world/velocities/linear", "world/velocities/angular"
GREEN, VIOLET = (64, 230, 115, 255), (190, 130, 255, 255)
AHEAD = 0.1  # s: an arrow ends where the centre of mass would be after that, or is as long as what it turns by in rad
RADIUS = -1.5  # px


class Velocities(RowTrack):
    """Velocities of all bodies, those that sleep among them, from their centres of mass."""

    key: ClassVar[str] = "velocities"
    detail: ClassVar[str] = "full"
    path: ClassVar[str] = LINEAR
    columns: ClassVar[Mapping[str, Column]] = {
        "body": handle("who moves"),
        "linear": Motion.columns["linear"],
        "angular": Motion.columns["angular"],
        "center": number("m", "centre of mass, world frame", 3),
    }
    drawn: ClassVar[Mapping[str, str]] = {"center": "Arrows3D:origins"}

    def begin(self, simulation: Simulation, stream: Stream, tracks: Mapping[str, Track]) -> None:
        """Write colours and widths of the arrows."""
        import rerun

        for path, color in ((LINEAR, GREEN), (ANGULAR, VIOLET)):
            stream.static(path, rerun.Arrows3D.from_fields(colors=[color], radii=[RADIUS]))

    def lay_out(self, world: World, layout: Layout) -> None:
        """Show linear velocities only."""
        layout.hide(ANGULAR)

    def rows(self, simulation: Simulation) -> Columns:
        """Return a row for each body."""
        world = simulation.world
        rows, motion = world.row_numbers(Transform, Motion, RigidBody), world[Motion]
        center = centers_of_mass(world, rows)
        return {
            "body": world.entities(rows),
            "linear": motion.linear[rows],
            "angular": motion.angular[rows],
            "center": center,
        }

    def draw(self, block: Block, stream: Stream) -> Sequence[Any]:
        """Return the arrows, of linear velocities; write those of angular ones."""
        import rerun

        linear, angular = (
            block.drawn(
                rerun.Arrows3D.from_fields(origins=block.columns["center"], vectors=AHEAD * block.columns[name])
            )
            for name in ("linear", "angular")
        )
        stream.rows(ANGULAR, block.stamps, angular)
        return linear
