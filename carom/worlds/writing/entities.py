"""Entities in words: each as a file states one, with no more than it takes to make the same columns again."""

from __future__ import annotations

from collections.abc import Callable
from functools import cached_property
from typing import Any

import numpy as np

from carom.ecs import Collider, Material, Motion, Parent, RigidBody, Transform, World
from carom.ecs.column import Integers
from carom.ecs.components.emitter import Emitter
from carom.ecs.components.joint import Joint
from carom.ecs.components.path import Path, Repeat
from carom.ecs.relations.keyframe import Keyframe
from carom.ecs.tags import Tag
from carom.systems.compound import parts_of
from carom.systems.own_components import components_of_files
from carom.systems.parameters import words_of
from carom.systems.particles.words import EmitterWords
from carom.worlds.writing.bodies import body_words
from carom.worlds.writing.columns import Columns, Words, plain, sayable
from carom.worlds.writing.joints import joint_words
from carom.worlds.writing.models import Models
from carom.worlds.writing.names import Callings
from carom.worlds.writing.surfaces import POSE, Surfaces


class EntityWriter:
    """Words of the entities of a world, in order of rows."""

    def __init__(self, world: World, callings: Callings, models: Models) -> None:
        self.world, self.callings, self.columns = world, callings, Columns(world)
        self.surfaces = Surfaces(self.columns, models)
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

    def words(self, row: int) -> Words:
        """Return the words of one entity but its name."""
        words: Words = {}
        makers: dict[str, Callable[[int], Any]] = (
            {"joint": self.joint} if self.columns.has(Joint, row) else self.of_a_place(row)
        )
        for key, make in makers.items():
            said = make(row)
            if said is not None and (said != {} or key == "body"):
                words[key] = said
        tags = [kind.key for kind in self.world.tables if issubclass(kind, Tag) and self.columns.has(kind, row)]
        if tags:
            words["tags"] = sorted(tags)
        for key, kind in self.own.items():
            if self.columns.has(kind, row) and not (kind is Parent and self.columns.has(RigidBody, row)):
                words[key] = self.columns.own_words(kind, row, self.callings)
        return words

    def joint(self, row: int) -> Words | None:
        """Return what it holds together, and how."""
        return joint_words(self.columns, row, self.callings)

    def of_a_place(self, row: int) -> dict[str, Callable[[int], Any]]:
        """Return what makes the words of an entity that is somewhere."""
        has, surfaces = self.columns.has, self.surfaces
        path, body = has(Path, row), has(RigidBody, row)
        carried = has(Parent, row) and not body
        makers: list[tuple[str, bool, Callable[[int], Any]]] = [
            ("keyframes", path and body, self.keyframes),
            ("transform", not carried and not (path and body), self.transform),
            ("motion", body and not path, self.motion),
            ("body", body, self.body),
            ("collider", has(Collider, row), surfaces.collider),
            ("material", has(Material, row), surfaces.material),
            ("visual", True, surfaces.visual),
            ("emitter", has(Emitter, row), self.emitter),
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

    def emitter(self, row: int) -> Words | None:
        """Return what it brings forth; colours are in numbers."""
        columns = {name: value[row] for name, value in vars(self.world[Emitter]).items() if name in Emitter.columns}
        words = plain(words_of(EmitterWords.of(Emitter(**columns))))
        return words if sayable(words) else None
