"""Surfaces in words: the shapes of entities, by which they touch and are seen, and what they are made of."""

from __future__ import annotations

from typing import Any

from carom.ecs import Collider, Combine, Material, RigidBody, Visual
from carom.ecs.component import Component
from carom.systems.layers import Layers
from carom.systems.materials import COMBINE_QUANTITIES, MATERIAL_COLUMNS, Materials, material_of
from carom.systems.parameters import same
from carom.systems.shapes.geometry import Geometries
from carom.systems.shapes.shape import BY_NUMBER
from carom.systems.surfaces import BODY_COLOR, COLLIDER_COLUMNS
from carom.worlds.writing.columns import Columns, Words, color_words, plain
from carom.worlds.writing.models import Models
from carom.worlds.writing.sections import layer_names

POSE = ("position", "rotation")
SHAPE_COLUMNS = ("shape", "size", "geometry")


class Surfaces:
    """Words of colliders, materials and visuals, row by row."""

    def __init__(self, columns: Columns, models: Models) -> None:
        self.world, self.columns, self.models = columns.world, columns, models

    def shape(self, kind: type[Component], row: int) -> Words:
        """Return the words of the shape of a collider or visual, as its own declaration has them."""
        number = self.columns.held(kind, "geometry", row)
        geometry = self.world[Geometries].items[number] if number >= 0 else None
        read = self.models.words(geometry)
        if read is not None:
            return read
        shape = BY_NUMBER[self.columns.held(kind, "shape", row)].from_size(
            self.world.table(kind).arrays["size"][row], geometry
        )
        return {shape.key: plain(shape.words())}

    def collider(self, row: int) -> Words:
        """Return the shape by which it touches others, and whom."""
        layers = self.world[Layers]
        words = self.shape(Collider, row) | self.columns.stated(Collider, row, COLLIDER_COLUMNS)
        bit, mask, enters = (self.columns.held(Collider, name, row) for name in ("layer", "mask", "enter_layer"))
        bits = {number: name for name, number in layers.bits.items()}
        layer = bits.get(bit, "default")
        if layer != "default":
            words["layer"] = layer
        if mask != layers.masks.get(layer):
            words["collides_with"] = layer_names(layers, mask)
        if enters in bits:
            words["on_enter"] = {"layer": bits[enters]}
        return words

    def material(self, row: int) -> str | Words:
        """Return the name of its material, or else what it is made of."""
        number = self.columns.held(Material, "number", row)
        name = self.world[Materials].name(number)
        if name and self.columns.as_made(row, material_of(self.world, name)):
            return name
        words = self.columns.stated(Material, row, MATERIAL_COLUMNS)
        for quantity in COMBINE_QUANTITIES:
            if rule := self.columns.held(Material, f"{quantity}_combine", row):
                words[quantity] = {
                    "value": self.columns.held(Material, quantity, row),
                    "combine": Combine(rule).name.lower(),
                }
        if "color" in words:
            words["color"] = color_words(words["color"])
        return words

    def visual(self, row: int) -> Words | bool | None:
        """Return what is seen, None where that follows from the rest."""
        touches = self.columns.has(Collider, row)
        plain_look = touches and not self.columns.held(Collider, "sensor", row)
        if not self.columns.has(Visual, row):
            return False if plain_look else None
        own = not touches or any(
            not same(self.columns.held(Visual, name, row), self.columns.held(Collider, name, row))
            for name in (*SHAPE_COLUMNS, *POSE)
        )
        words = self.shape(Visual, row) | self.columns.stated(Visual, row, POSE) if own else {}
        color = self.columns.held(Visual, "color", row)
        if self._finished(row) or not (self.columns.has(Material, row) and same(color, self._usual_color(row))):
            words["color"] = color_words(color)
        if not self.columns.held(Visual, "visible", row):
            words["visible"] = False
        return words or (None if plain_look else {"visible": True})

    def _usual_color(self, row: int) -> Any:
        """Return the colour in which what has a material is seen where its looks state none."""
        color = self.columns.held(Material, "color", row)
        plain = same(color, Material.columns["color"].default)
        return BODY_COLOR if plain and self.columns.has(RigidBody, row) else color

    def _finished(self, row: int) -> bool:
        """Tell whether what is seen has a finish of its own, in whose place the colour of the material is not taken."""
        number = self.columns.held(Visual, "geometry", row)
        return number >= 0 and any(part.finish for part in self.world[Geometries].items[number].parts)
