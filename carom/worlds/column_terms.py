"""Terms that are columns of entities, such as ``left.position.y``."""

from __future__ import annotations

import numpy as np

from carom.ecs import Component, Material, Motion, RigidBody, Transform, World
from carom.ecs.column import Floats, Integers
from carom.ecs.components.emitter import Emitter
from carom.ecs.components.joint import Joint
from carom.ecs.errors import did_you_mean
from carom.systems.own_components import is_own
from carom.worlds.cast import Cast
from carom.worlds.comers import Comers, comers, kinds_of
from carom.worlds.errors import WordError
from carom.worlds.joint_terms import TURNS, WAYS, readings, spelled_out
from carom.worlds.particle_terms import WORD, particle_measure
from carom.worlds.term import AXES, Place, Term

FIRST_KINDS = (
    Transform,
    Motion,
    RigidBody,
    Material,
    Joint,
)  # where two components have a column of one name, these win


def column_term(text: str, end: int, names: list[str], world: World) -> Term:
    """Return the term of a column, whose name follows those of entities from ``end`` on."""
    cast, coming = Cast(names, world), comers(world)
    steps = text[end + 1 :].split(".")
    if steps[0] == WORD and len(steps) > 1 and all(Emitter in kinds_of(name, world, coming) for name in names):
        return _of_particles(text, names, steps, cast)
    steps = spelled_out(world, names[0], steps)
    part = steps.pop() if len(steps) > 1 and steps[-1] in (*AXES, *WAYS) else None
    kind, *_ = [kind_of(world, name, coming, *steps) for name in names]
    column = kind.columns[steps[-1]]
    if column.dtype.kind not in "fiub":
        raise WordError("is no number", received=repr(text), accepted="columns of numbers")
    size, units = int(np.prod(column.shape)), column.unit.split(", ")
    parts = WAYS if column.shape == (len(WAYS),) else AXES[:size]
    if part is not None and part not in parts:
        raise WordError(f"{steps[-1]} has no {part}", received=repr(text), accepted=", ".join(parts))
    if part is None and len(units) > 1:
        raise WordError(f"{steps[-1]} has a value for each way", received=repr(text), accepted=", ".join(parts))
    axis = None if part is None else parts.index(part)
    unit = units[-1] if axis is not None and axis >= TURNS else units[0]

    def read(world: World) -> Floats:
        def measure(rows: Integers) -> Floats:
            values = np.asarray(getattr(world[kind], steps[-1]).take(rows, axis=0), np.float64).reshape(len(rows), size)
            return values if axis is None else values[:, axis : axis + 1]

        return cast.values(world, width, measure)

    whole = tuple(name + text[end:] for name in names)
    place, width = Place(kind, steps[-1], axis), 1 if axis is not None else size
    return Term(text, unit, width, whole, read, cast, cast.each, place=place)


def _of_particles(text: str, names: list[str], steps: list[str], cast: Cast) -> Term:
    """Return the term of a measure of the particles of emitters."""
    unit, size, measure = particle_measure(text, steps[1:])

    def read(world: World) -> Floats:
        return cast.values(world, size, lambda rows: np.array([measure(world, each) for each in world.entities(rows)]))

    return Term(text, unit, size, tuple(".".join([name, *steps]) for name in names), read, cast, cast.each)


def kind_of(world: World, name: str, coming: Comers, *steps: str) -> type[Component]:
    """Return the component of an entity that has the column ``column`` or ``component.column``."""
    held = kinds_of(name, world, coming)
    held.sort(key=lambda kind: FIRST_KINDS.index(kind) if kind in FIRST_KINDS else len(FIRST_KINDS))
    for kind in held:
        if steps[-1] in kind.columns and steps[:-1] in ((), (kind.key,)):
            return kind
    columns = [name for kind in held for name in kind.columns if kind in FIRST_KINDS or is_own(kind)]
    columns = [*readings(world, name), *columns]
    wanted, hint = ".".join(steps), did_you_mean(steps[-1], columns)
    accepted = ", ".join(columns)
    raise WordError(f"{name} has no such column", received=repr(wanted), accepted=accepted, hint=hint)
