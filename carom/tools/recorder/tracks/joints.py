"""Joints: how far they are off, how loaded and where at their limits; and springs, how long and how tense."""

from __future__ import annotations

from collections.abc import Mapping
from typing import ClassVar

import numpy as np

from carom.ecs import World
from carom.ecs.column import Column, Floats
from carom.ecs.components.joint import Joint
from carom.ecs.components.spring import Spring
from carom.tools.jointed import Jointed, coiled
from carom.tools.recorder.block import Columns
from carom.tools.recorder.layout import Layout
from carom.tools.recorder.loaded_lines import LoadedLines
from carom.tools.recorder.rows import text
from carom.tools.recorder.tracks.shapes import PATH as SHAPES
from carom.tools.recorder.tracks.shapes import colored

JOINTS, SPRINGS = "world/joints", "world/springs"
COIL = 0.05  # half the width of zigzags, in lengths of springs when they are first seen
OF_JOINTS = (
    "a", "b", "gap", "twist", "force", "torque", "margin", "position", "velocity", "effort", "limit",
    "impulse", "drive_impulse", "friction_impulse",
)  # fmt: skip
OF_SPRINGS = ("a", "b", "length", "tension")


class Joints(LoadedLines):
    """All joints, as lines from the centre of a by both anchors to that of b."""

    key: ClassVar[str] = "joints"
    path: ClassVar[str] = JOINTS
    kind: ClassVar[type[Joint]] = Joint
    told: ClassVar[tuple[str, ...]] = OF_JOINTS
    columns: ClassVar[Mapping[str, Column]] = {
        "name": text("name of the joint"),
        **{name: Joint.columns[name] for name in OF_JOINTS},
    }

    def lay_out(self, world: World, layout: Layout) -> None:
        """Show them in a view of their own, in bodies one sees through."""
        if len(world.row_numbers(Joint)) + len(world.row_numbers(Spring)):
            contents = [f"{path}/**" for path in (SHAPES, JOINTS, SPRINGS)]
            layout.scene("Joints", contents, colored("material", fill_mode="majorwireframe"), grid=True)

    def lines(self, found: Jointed) -> Floats:
        """Return the ways from body to body (n, 4, 3)."""
        return np.stack([found.from_a, found.at_a, found.at_b, found.from_b], axis=1)

    def loads(self, columns: Columns) -> Floats:
        """Return the sizes of forces (n,), N."""
        return np.asarray(np.sqrt((columns["force"] ** 2).sum(axis=1)))


class Springs(LoadedLines):
    """All springs that are forces, as zigzags between their anchors."""

    key: ClassVar[str] = "springs"
    path: ClassVar[str] = SPRINGS
    kind: ClassVar[type[Spring]] = Spring
    told: ClassVar[tuple[str, ...]] = OF_SPRINGS
    columns: ClassVar[Mapping[str, Column]] = {
        "name": text("name of the spring"),
        **{name: Spring.columns[name] for name in OF_SPRINGS},
    }

    def __init__(self) -> None:
        super().__init__()
        self._radius = 0.0

    def lines(self, found: Jointed) -> Floats:
        """Return the points of the zigzags (n, k, 3)."""
        if self._radius == 0.0:
            self._radius = COIL * float(np.median(np.sqrt(((found.at_b - found.at_a) ** 2).sum(axis=1))))
        return coiled(found.at_a, found.at_b, self._radius)

    def loads(self, columns: Columns) -> Floats:
        """Return the sizes of tensions (n,), N."""
        return np.asarray(np.abs(columns["tension"]))
