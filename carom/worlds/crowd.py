"""Crowds: entities whose words are of one form are made up together, and those of the same columns added together."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from itertools import groupby
from typing import Any, NamedTuple

import numpy as np

from carom.ecs import Transform, World
from carom.ecs.column import Floats, Integers
from carom.ecs.component import Component
from carom.systems.assembly import bundles_of
from carom.systems.compound import StatedBodies
from carom.worlds.connections import Pointer
from carom.worlds.errors import Path
from carom.worlds.forms import together
from carom.worlds.groups import Group

LONE = ("joint", "keyframes")  # words that say where one entity is


class Some(NamedTuple):
    """An entity of a file, or the copies that a generator makes of it, where they are.

    Positions (n, 3) in m; rotations (n, 4), or None of one that is added alone, where its words say them.
    """

    path: Path
    group: Group
    words: dict[str, Any]
    positions: Floats
    names: list[str] | None = None
    rotations: Floats | None = None
    pointers: Sequence[Pointer] = ()
    joint: dict[str, Any] | None = None
    weight: dict[str, Any] | None = None  # what is stated of a body whose mass depends on what it carries


class Form:
    """Components of entities whose words differ in numbers only; a column has one value for all, or a row for each."""

    def __init__(self, world: World, crowd: Sequence[Some]) -> None:
        """Make them; raise DeclarationError."""
        self.bundles = bundles_of(world, **together([some.words for some in crowd]))
        self.columns = [(type(part), *vars(part)) for part in self.bundles]
        for part in self.bundles:
            for name, value in vars(part).items():
                part.columns[name].fit(value, len(crowd), f"{type(part).__name__}.{name}")


class Member(NamedTuple):
    """Some of a form, by their number among those it was made of."""

    some: Some
    form: Form
    number: int

    def joins(self) -> tuple[Any, ...]:
        """Return what is the same of members that can be added at once."""
        return self.some.names is None, self.form.columns


def runs(members: Iterable[Member]) -> list[list[Member]]:
    """Return members in their order, those next to each other that can be added at once in one list."""
    return [list(run) for _, run in groupby(members, key=Member.joins)]


def add_run(world: World, run: Sequence[Member]) -> Integers:
    """Add members that can be added at once, and note what was stated of bodies; return the handles.

    Raises DeclarationError.
    """
    positions, names, bundles = put_together(run)
    entities = world.spawn_many(len(positions), *bundles, names=names)
    bodies = [member.some.words.get("body") for member in run for _ in member.some.positions]
    stated = zip(entities.tolist(), bodies, strict=True)
    world[StatedBodies].words.update({entity: body for entity, body in stated if body is not None})
    return entities


def put_together(run: Sequence[Member]) -> tuple[Floats, list[str] | None, list[Component]]:
    """Return positions (n, 3), m, names and components of members that can be added at once."""
    crowd = [member.some for member in run]
    forms = list({id(member.form): member.form for member in run}.values())
    place = {id(form): number for number, form in enumerate(forms)}
    counts = [len(some.positions) for some in crowd]
    number = np.repeat([member.number for member in run], counts)
    of_form = np.repeat([place[id(member.form)] for member in run], counts)
    rows = [np.nonzero(of_form == form)[0] for form in range(len(forms))]
    bundles = [_column_wise(parts, rows, number) for parts in zip(*(form.bundles for form in forms), strict=True)]
    positions = np.concatenate([some.positions for some in crowd])
    rotations = np.concatenate([some.rotations for some in crowd if some.rotations is not None])
    names = None if crowd[0].names is None else [name for some in crowd for name in some.names or ()]
    return positions, names, [*bundles, Transform(position=positions, rotation=rotations)]


def _column_wise(parts: Sequence[Component], rows: Sequence[Integers], number: Integers) -> Component:
    """Return one bundle of the parts of several forms, each in its rows."""
    values: dict[str, Any] = {}
    for name, value in vars(parts[0]).items():
        column = parts[0].columns[name]
        if len(parts) == 1 and value.ndim <= len(column.shape):
            values[name] = value
            continue
        values[name] = np.empty((len(number), *column.shape), column.dtype)
        for part, here in zip(parts, rows, strict=True):
            stated = getattr(part, name)
            each = stated.ndim > len(column.shape) and len(stated) > 1
            values[name][here] = stated[number[here]] if each else stated
    return type(parts[0])(**values)
