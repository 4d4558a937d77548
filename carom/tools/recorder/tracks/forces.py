"""Forces: every contribution to the free-body diagram of every dynamic body."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, ClassVar

import numpy as np

from carom.ecs import RigidBody, World
from carom.ecs.column import Column
from carom.systems.bodies import dynamic_rows
from carom.systems.free_body import FRICTION, JOINT, NORMAL, loads
from carom.systems.settings import Settings
from carom.systems.simulation import Simulation
from carom.tools.recorder.block import Block, Columns
from carom.tools.recorder.layout import Layout
from carom.tools.recorder.rows import RowTrack, handle, number, text
from carom.tools.recorder.stream import Stream
from carom.tools.recorder.track import Track
from carom.tools.recorder.tracks.contacts import POINTS
from carom.tools.recorder.tracks.normals import typical_radius
from carom.tools.recorder.tracks.shapes import PATH as SHAPES
from carom.tools.recorder.tracks.shapes import colored

PATH = "world/forces"
COLORS = {"gravity": 0xFADB40FF, NORMAL: 0xFF7333FF, FRICTION: 0xF259BFFF, JOINT: 0xB38CFFFF}
OTHERS = 0x73CCFFFF
RADIUS = -2.0  # px
WEIGHT, LONGEST = 2.0, 8.0  # typical radii: the arrow of a typical weight, and of what is far larger, such as impacts
STANDARD_GRAVITY = 9.81  # m/s2, by which arrows are scaled where there is none


class Forces(RowTrack):
    """Forces where they act: those of contacts, joints and laws with points there, all others on centres of mass."""

    key: ClassVar[str] = "forces"
    detail: ClassVar[str] = "full"
    path: ClassVar[str] = PATH
    columns: ClassVar[Mapping[str, Column]] = {
        "body": handle("whom it acts on"),
        "source": text("law or system, normal and friction of contacts, joint, or external"),
        "force": number("N", "force, world frame; of contacts and joints the mean of the last step", 3),
        "point": number("m", "where it acts, world frame", 3),
    }
    drawn: ClassVar[Mapping[str, str]] = {"point": "Arrows3D:origins"}

    def begin(self, simulation: Simulation, stream: Stream, tracks: Mapping[str, Track]) -> None:
        """Choose the scale: a typical weight is two typical radii long."""
        import rerun

        world, radius = simulation.world, typical_radius(simulation.world)
        masses = world[RigidBody].mass[dynamic_rows(world)]
        gravity = float(np.linalg.norm(world[Settings].gravity)) or STANDARD_GRAVITY
        self._scale = WEIGHT * radius / (gravity * float(np.median(masses)) if len(masses) else 1.0)
        self._longest = LONGEST * radius
        stream.static(PATH, rerun.Arrows3D.from_fields(radii=[RADIUS]))

    def lay_out(self, world: World, layout: Layout) -> None:
        """Show them in a view of their own, in bodies one sees through."""
        layout.hide(PATH)
        contents = [f"{SHAPES}/**", f"{PATH}/**", f"{POINTS}/**"]
        layout.scene("Forces", contents, colored("material", fill_mode="majorwireframe"), grid=True)

    def rows(self, simulation: Simulation) -> Columns:
        """Return the forces as they are now."""
        found = loads(simulation)
        return {
            "body": simulation.world.entities(found.body),
            "source": np.array(found.name, np.str_),
            "force": found.force,
            "point": found.point,
        }

    def draw(self, block: Block, stream: Stream) -> Sequence[Any]:
        """Return arrows; those of what is far larger than a weight are cut."""
        import rerun

        forces, sources = block.columns["force"], block.columns["source"]
        sizes = np.linalg.norm(forces, axis=1)
        shares = np.minimum(self._scale, self._longest / np.maximum(sizes, 1e-300))
        names, place = np.unique(sources, return_inverse=True)
        colors = np.array([COLORS.get(name, OTHERS) for name in names.tolist()], np.uint32)[place.ravel()]
        vectors = shares[:, None] * forces
        return block.drawn(rerun.Arrows3D.from_fields(origins=block.columns["point"], vectors=vectors, colors=colors))
