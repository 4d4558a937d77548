"""Entities in words: each as a file states one, with no more than it takes to make the same columns again."""

from __future__ import annotations

from collections.abc import Callable
from functools import cached_property
from typing import Any

import numpy as np

from carom.ecs import Collider, Combine, Material, Motion, Parent, RigidBody, Transform, Visual, World
from carom.ecs.column import Integers
from carom.ecs.component import Component
from carom.ecs.components.emitter import Emitter
from carom.ecs.components.joint import Joint
from carom.ecs.components.path import Path, Repeat
from carom.ecs.relations.keyframe import Keyframe
from carom.ecs.tags import Tag
from carom.systems.assembly import COLLIDER_COLUMNS, COMBINE_QUANTITIES, Materials, material_of
from carom.systems.compound import parts_of
from carom.systems.layers import Layers
from carom.systems.own_components import components_of_files
from carom.systems.parameters import same, words_of
from carom.systems.particles.words import EmitterWords
from carom.systems.shapes.geometry import Geometries
from carom.systems.shapes.shape import BY_NUMBER
from carom.worlds.writing.bodies import body_words
from carom.worlds.writing.columns import Columns, Words, color_words, plain, sayable
from carom.worlds.writing.joints import joint_words
from carom.worlds.writing.names import Callings
from carom.worlds.writing.sections import layer_names

POSE = ("position", "rotation")
SHAPE_COLUMNS = ("shape", "size", "geometry")
MATERIAL_COLUMNS = [name for name in Material.columns if name != "number" and not name.endswith("_combine")]


class EntityWriter:
    """Words of the entities of a world, in order of rows."""

    def __init__(self, world: World, callings: Callings) -> None:
        self.world, self.callings, self.columns = world, callings, Columns(world)
        self.own = {key: kind for key, kind in components_of_files().items() if kind is not Joint}

    def all(self) -> list[Words]:
        """Return the words of everybody; who is pointed to has a name then."""
        rows = self.rows.tolist()
        words = [self.words(row) for row in rows]
        entities = self.world.entities(self.rows).tolist()
        return [
            ({"name": name} if (name := self.callings.name(entity)) else {}) | said
            for entity, said in zip(entities, words, strict=True)
        ]

    @cached_property
    def rows(self) -> Integers:
        """The rows of all who live."""
        return np.nonzero(self.world.slots.alive[: self.world.used()])[0]

    @cached_property
    def parts(self) -> dict[int, Any]:
        """What each body weighs by."""
        return dict(parts_of(self.world, self.world.row_numbers(RigidBody)))

    def has(self, kind: type[Component], row: int) -> bool:
        """Tell whether a row has a component."""
        return kind in self.world.tables and bool(self.world.tables[kind].present[row])

    def words(self, row: int) -> Words:
        """Return the words of one entity but its name."""
        words: Words = {}
        makers: dict[str, Callable[[int], Any]] = (
            {"joint": self.joint} if self.has(Joint, row) else self.of_a_place(row)
        )
        for key, make in makers.items():
            said = make(row)
            if said is not None and (said != {} or key == "body"):
                words[key] = said
        tags = [kind.key for kind in self.world.tables if issubclass(kind, Tag) and self.has(kind, row)]
        if tags:
            words["tags"] = sorted(tags)
        for key, kind in self.own.items():
            if self.has(kind, row) and not (kind is Parent and self.has(RigidBody, row)):
                words[key] = self.columns.own_words(kind, row, self.callings)
        return words

    def joint(self, row: int) -> Words | None:
        """Return what it holds together, and how."""
        return joint_words(self.columns, row, self.callings)

    def of_a_place(self, row: int) -> dict[str, Callable[[int], Any]]:
        """Return what makes the words of an entity that is somewhere."""
        path, body = self.has(Path, row), self.has(RigidBody, row)
        carried = self.has(Parent, row) and not body
        makers: list[tuple[str, bool, Callable[[int], Any]]] = [
            ("keyframes", path and body, self.keyframes),
            ("transform", not carried and not (path and body), self.transform),
            ("motion", body and not path, self.motion),
            ("body", body, self.body),
            ("collider", self.has(Collider, row), self.collider),
            ("material", self.has(Material, row), self.material),
            ("visual", True, self.visual),
            ("emitter", self.has(Emitter, row), self.emitter),
        ]
        return {key: make for key, there, make in makers if there}

    def transform(self, row: int) -> Words:
        """Return where it is."""
        return self.columns.stated(Transform, row, POSE)

    def motion(self, row: int) -> Words:
        """Return how it moves."""
        return self.columns.stated(Motion, row, ("linear", "angular"))

    def body(self, row: int) -> Words:
        """Return what it weighs."""
        return body_words(self.columns, row, self.parts[row])

    def keyframes(self, row: int) -> Any:
        """Return the poses it goes along."""
        frames, path = self.world[Keyframe], self.world[Path]
        first, count = int(path.first[row]), int(path.count[row])
        said = [
            {name: getattr(frames, name)[number].tolist() for name in ("at", *POSE)}
            for number in range(first, first + count)
        ]
        repeat = Repeat(int(path.repeat[row]))
        return said if repeat is Repeat.ONCE else {"repeat": repeat.name.lower(), "frames": said}

    def shape(self, kind: type[Component], row: int) -> Words:
        """Return the words of the shape of a collider or visual, as its own declaration has them."""
        number = self.columns.held(kind, "geometry", row)
        geometry = self.world[Geometries].items[number] if number >= 0 else None
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

    def emitter(self, row: int) -> Words | None:
        """Return what it brings forth; colours are in numbers."""
        columns = {name: value[row] for name, value in vars(self.world[Emitter]).items() if name in Emitter.columns}
        words = plain(words_of(EmitterWords.of(Emitter(**columns))))
        return words if sayable(words) else None

    def visual(self, row: int) -> Words | bool | None:
        """Return what is seen, None where that follows from the rest."""
        touches = self.has(Collider, row)
        plain_look = touches and not self.columns.held(Collider, "sensor", row)
        if not self.has(Visual, row):
            return False if plain_look else None
        own = not touches or any(
            not same(self.columns.held(Visual, name, row), self.columns.held(Collider, name, row))
            for name in (*SHAPE_COLUMNS, *POSE)
        )
        words = self.shape(Visual, row) | self.columns.stated(Visual, row, POSE) if own else {}
        color = self.columns.held(Visual, "color", row)
        if not (self.has(Material, row) and same(color, self.columns.held(Material, "color", row))):
            words["color"] = color_words(color)
        if not self.columns.held(Visual, "visible", row):
            words["visible"] = False
        return words or (None if plain_look else {"visible": True})
