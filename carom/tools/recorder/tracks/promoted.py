"""Promoted: chosen bodies with a path, a label, plots and a lane of their own."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, ClassVar

import numpy as np

from carom.ecs import Motion, RigidBody, Transform, World
from carom.ecs.column import Column, Floats, Integers
from carom.systems.energy import centers_of_mass, kinetic_energies
from carom.systems.free_body import FRICTION, NORMAL, loads
from carom.systems.settings import Settings
from carom.systems.simulation import Simulation
from carom.tools.recorder.block import Block, Columns
from carom.tools.recorder.choice import Choice
from carom.tools.recorder.lanes import Lanes
from carom.tools.recorder.layout import Layout
from carom.tools.recorder.rows import RowTrack, handle, number
from carom.tools.recorder.stream import Stamp, Stream

ROOT = "promoted"
LABELS = "world/promoted"
SLEEP = {"awake": (120, 210, 130), "asleep": (90, 110, 170)}
PLOTS = {
    "position": ("position (m)", "xyz"),
    "speed": ("speed (m/s)", ("speed",)),
    "energy": ("energy (J)", ("kinetic", "potential")),
    "force": ("forces (N)", ("applied", "normal", "friction")),
}


class Promoted(RowTrack):
    """Chosen bodies that obey forces: where they are, how fast, their energy and what acts on them.

    Potential energy is that in gravity; forces from outside and of laws are summed, contacts' are means of the step.
    """

    key: ClassVar[str] = "promoted"
    path: ClassVar[str] = ROOT
    sparse: ClassVar[bool] = True
    columns: ClassVar[Mapping[str, Column]] = {
        "entity": handle("the body"),
        "position": Transform.columns["position"],
        "speed": number("m/s", "of its centre of mass"),
        "kinetic": number("J", "energy of motion and rotation"),
        "potential": number("J", "energy in gravity"),
        "applied": number("N", "sum of all forces but those of contacts, world frame", 3),
        "normal": number("N", "sum of normal forces of contacts, world frame", 3),
        "friction": number("N", "sum of friction of contacts, world frame", 3),
    }

    def __init__(self, patterns: Sequence[str] = ()) -> None:
        super().__init__()
        self.choice = Choice(patterns)
        self._lanes = Lanes("sleep", SLEEP)
        self._there: dict[int, str] = {}

    def lay_out(self, world: World, layout: Layout) -> None:
        """Show the plots of each that is there, and the lanes."""
        for name in world.names_told(world.entities(self._bodies(world))):
            layout.body(f"{ROOT}/{name}", name, {f"{key}": title for key, (title, _) in PLOTS.items()})
            layout.lanes()

    def sample(self, simulation: Simulation, stamp: Stamp, stream: Stream) -> None:
        """Keep what there is to tell of each; label one that is new, and clear the label of one that is gone."""
        import rerun

        world = simulation.world
        rows = self._bodies(world)
        if not len(rows) and not self._there:
            return
        entities = world.entities(rows)
        names = dict(zip(entities.tolist(), world.names_told(entities), strict=True))
        for entity in names.keys() - self._there.keys():
            stream.row(_path(LABELS, names[entity]), stamp, rerun.Points3D.from_fields(labels=[names[entity]], radii=-2.0))
        for entity in self._there.keys() - names.keys():
            stream.row(_path(LABELS, self._there[entity]), stamp, rerun.Clear(recursive=False))
        self._there |= names
        states = np.where(world[Motion].asleep[rows], "asleep", "awake").tolist()
        self._lanes.note_all(stamp, dict(zip(names.values(), states, strict=True)))
        super().sample(simulation, stamp, stream)
