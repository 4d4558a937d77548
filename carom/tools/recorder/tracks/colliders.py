"""Colliders: what everybody touches others by: shape, layer and material, written when any of it changes."""

from __future__ import annotations

from collections.abc import Mapping
from typing import ClassVar

import numpy as np

from carom.ecs import Collider, Material, Transform, World
from carom.ecs.column import Column
from carom.systems.compound import bodies_of
from carom.systems.layers import Layers
from carom.systems.materials import Materials
from carom.systems.shapes import BY_NUMBER
from carom.systems.simulation import Simulation
from carom.tools.recorder.block import Columns
from carom.tools.recorder.rows import RowTrack, handle, number, text

SURFACE = ("friction", "restitution", "density", "rolling_friction", "spinning_friction")


class Colliders(RowTrack):
    """A row for each collider in the first frame, and in those in which one came, went or became another."""

    key: ClassVar[str] = "colliders"
    detail: ClassVar[str] = "full"
    path: ClassVar[str] = "colliders"
    columns: ClassVar[Mapping[str, Column]] = {
        "collider": handle("what is touched"),
        "body": handle("the body it belongs to, -1 where it stands"),
        "shape": text("its shape"),
        "sensor": number("1", "1 reports who enters and touches nothing", dtype="int64"),
        "layer": text("the layer it is on"),
        "collides_with": text("the layers it meets, with commas between them"),
        "material": text("name of its material, empty where it has none"),
        **{name: Material.columns[name] for name in SURFACE},
    }

    def __init__(self) -> None:
        super().__init__()
        self._last: Columns = {}

    def rows(self, simulation: Simulation) -> Columns | None:
        """Return a row for each collider, or None where all are as they were."""
        world = simulation.world
        rows = world.row_numbers(Collider, Transform)
        collider, material = world[Collider], world[Material]
        now = {name: getattr(collider, name)[rows] for name in ("shape", "sensor", "layer", "mask")}
        now |= {name: getattr(material, name)[rows] for name in ("number", *SURFACE)}
        now |= {"collider": world.entities(rows), "owner": bodies_of(world)[rows]}
        if self._last and all(np.array_equal(values, self._last[name]) for name, values in now.items()):
            return None
        self._last = now
        return {name: now[name] for name in ("collider", *SURFACE)} | _told(world, now)


def _told(world: World, columns: Columns) -> Columns:
    """Return numbers of shapes, layers and materials as words, and rows of bodies as entities."""
    layers, materials, owners = world[Layers], world[Materials], columns["owner"]
    names = {bit: name for name, bit in layers.bits.items()}
    met = {
        mask: ",".join(name for name, bit in layers.bits.items() if mask & bit)
        for mask in np.unique(columns["mask"]).tolist()
    }
    body = np.full(len(owners), -1)
    body[owners >= 0] = world.entities(owners[owners >= 0])
    return {
        "body": body,
        "shape": np.array([BY_NUMBER[number].key for number in columns["shape"].tolist()], np.str_),
        "sensor": columns["sensor"].astype(np.int64),
        "layer": np.array([names.get(bit, "") for bit in columns["layer"].tolist()], np.str_),
        "collides_with": np.array([met[mask] for mask in columns["mask"].tolist()], np.str_),
        "material": np.array([materials.name(which) for which in columns["number"].tolist()], np.str_),
    }
