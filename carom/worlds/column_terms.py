"""Terms that are columns of entities, such as ``left.position.y``."""

from __future__ import annotations

import numpy as np

from carom.ecs import Component, Entity, Material, Motion, RigidBody, Transform, World
from carom.ecs.column import Floats
from carom.ecs.components.joint import Joint
from carom.ecs.errors import did_you_mean
from carom.systems.own_components import is_own
from carom.worlds.errors import WordError
from carom.worlds.joint_terms import TURNS, WAYS, readings, spelled_out
from carom.worlds.particle_terms import WORD, emits, particle_measure
from carom.worlds.term import AXES, Place, Rows, Term

FIRST_KINDS = (
    Transform,
    Motion,
    RigidBody,
    Material,
    Joint,
)  # where two components have a column of one name, these win


def column_term(text: str, end: int, names: list[str], world: World) -> Term:
    """Return the term of a column, whose name follows those of entities from ``end`` on."""
    entities = [world.find(name) for name in names]
    steps = text[end + 1 :].split(".")
    if steps[0] == WORD and len(steps) > 1 and all(emits(world, entity) for entity in entities):
        unit, size, measure = particle_measure(text, steps[1:])
        told = tuple(".".join([name, *steps]) for name in names)
        return Term(text, unit, size, told, lambda world: np.array([measure(world, entity) for entity in entities]))
    steps = spelled_out(world, entities[0], steps)
    part = steps.pop() if len(steps) > 1 and steps[-1] in (*AXES, *WAYS) else None
    kind = kind_of(world, entities[0], *steps)
    for entity in entities[1:]:
        kind_of(world, entity, *steps)
    column = kind.columns[steps[-1]]
    if column.dtype.kind not in "fiub":
        raise WordError("is no number", received=repr(text), accepted="columns of numbers")
    size, units = int(np.prod(column.shape)), column.unit.split(", ")
    parts = WAYS if column.shape == (len(WAYS),) else AXES[:size]
    if part is not None and part not in parts:
        raise WordError(f"{steps[-1]} has no {part}", received=repr(text), accepted=", ".join(parts))
    if part is None and len(units) > 1:
        raise WordError(f"{steps[-1]} has a value for each way", received=repr(text), accepted=", ".join(parts))
    axis, rows = None if part is None else parts.index(part), Rows(entities)
    unit = units[-1] if axis is not None and axis >= TURNS else units[0]

    def read(world: World) -> Floats:
        values = np.asarray(getattr(world[kind], steps[-1]).take(rows(world), axis=0), np.float64)
        values = values.reshape(len(entities), size)
        return values if axis is None else values[:, axis : axis + 1]

    whole = tuple(name + text[end:] for name in names)
    place = Place(kind, steps[-1], axis)
    return Term(text, unit, 1 if axis is not None else size, whole, read, tuple(entities), place=place)


def kind_of(world: World, entity: Entity, *steps: str) -> type[Component]:
    """Return the component of an entity that has the column ``column`` or ``component.column``."""
    row = world.row(entity)
    held = [kind for kind, table in world.tables.items() if issubclass(kind, Component) and table.present[row]]
    held.sort(key=lambda kind: FIRST_KINDS.index(kind) if kind in FIRST_KINDS else len(FIRST_KINDS))
    for kind in held:
        if steps[-1] in kind.columns and steps[:-1] in ((), (kind.key,)):
            return kind
    columns = [name for kind in held for name in kind.columns if kind in FIRST_KINDS or is_own(kind)]
    columns = [*readings(world, entity), *columns]
    wanted, hint = ".".join(steps), did_you_mean(steps[-1], columns)
    accepted = ", ".join(columns)
    raise WordError(f"{world.name(entity)} has no such column", received=repr(wanted), accepted=accepted, hint=hint)
