"""Terms: what expectations can ask of a world, such as ``left.position.y`` or ``speed(rain[0,0,1])``."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from carom.ecs import Component, Entity, Material, Motion, RigidBody, Transform, World
from carom.ecs.column import Floats, Integers
from carom.ecs.components.joint import Joint
from carom.ecs.errors import did_you_mean
from carom.systems.bodies import dynamic_rows
from carom.systems.own_components import is_own
from carom.worlds.errors import WordError
from carom.worlds.functions import CALLS, OF_ALL, PAIRS
from carom.worlds.joint_terms import TURNS, WAYS, readings, spelled_out
from carom.worlds.names import fitting, matching
from carom.worlds.oracle import check_foretold
from carom.worlds.particle_terms import WORD, emits, particle_measure
from carom.worlds.pictures import QUESTIONS, Pictures, check_drawn, read_camera

NAME_PATTERN = r"[^\W\d][\w*-]*(?:\[[\d,*]*\]|\.[\w*][\w*-]*)*"  # rain[3,0,1], rope.joint[2], cart.wheel[0]
COLUMN_TERM = re.compile(NAME_PATTERN)
DOT = re.compile(r"\.(?=[\w.]+$)")  # before a column, as far as can be told without the names of entities
CALL_TERM = re.compile(r"(\w+)\s*\(([^()]*)\)(?:\.([xyz]))?")
TERM_PATTERN = rf"\w+\s*\([^()]*\)(?:\.[xyz])?|{NAME_PATTERN}"
AXES = ("x", "y", "z", "w")
FIRST_KINDS = (
    Transform,
    Motion,
    RigidBody,
    Material,
    Joint,
)  # where two components have a column of one name, these win
Read = Callable[[World], Floats]


class Place(NamedTuple):
    """A column, or one component of it."""

    kind: type[Component]
    name: str
    axis: int | None


@dataclass(frozen=True)
class Term:
    """A value of one or several entities; ``read`` returns it for each, shape (entities, size), in ``unit``.

    ``entities`` are whom its values are of, where each is of one; ``looks`` is whether it is asked of a picture;
    ``place`` is the column that it reads, where it reads one.
    """

    text: str
    unit: str
    size: int
    names: tuple[str, ...]
    read: Read
    entities: tuple[Entity, ...] = ()
    looks: bool = False
    place: Place | None = None


class _Rows:
    """The rows of entities, looked up again only where rows may have changed."""

    def __init__(self, entities: list[Entity]) -> None:
        self._entities, self._seen = entities, (-1, -1)
        self._rows: Integers = np.zeros(0, np.int64)

    def __call__(self, world: World) -> Integers:
        """Return them as they are now; raise EntityError for one who is gone."""
        if self._seen != (world.structure, world.restored):
            self._rows = np.array([world.row(entity) for entity in self._entities], np.int64)
            self._seen = (world.structure, world.restored)
        return self._rows


def read_term(text: str, world: World) -> Term:
    """Return the term a text states; raise WordError for what the world does not have."""
    text = text.strip()
    call, dots = CALL_TERM.fullmatch(text), [dot.start() for dot in DOT.finditer(text)]
    if call is not None:
        patterns = re.findall(NAME_PATTERN, call[2])
        if call[1] in OF_ALL:
            return _of_all(text, call[1], patterns, call[3], world)
        if call[3] is None:
            return _call(text, call[1], patterns, world)
    if COLUMN_TERM.fullmatch(text) is None or not dots:
        calls = [f"{name}(entity)" for name in CALLS] + [f"{name}(entity, ...)" for name in OF_ALL]
        calls += [f"{name}(entity, entity)" for name in PAIRS]
        accepted = f"<entity>.<column>, {', '.join(calls[:-1])} or {calls[-1]}"
        raise WordError("is no value of the world", received=repr(text), accepted=accepted)
    there = world.names()
    end = next((dot for dot in reversed(dots) if fitting(text[:dot], there)), dots[0])
    return _column(text, end, matching(text[:end], there), world)


def _call(text: str, function: str, patterns: list[str], world: World) -> Term:
    wanted = dict.fromkeys(CALLS, 1) | dict.fromkeys(PAIRS, 2)
    asked = QUESTIONS.get(function)
    if asked is not None and len(patterns) - asked.entities in (0, 1):
        return _question(text, function, patterns, world)
    if wanted.get(function) != len(patterns):
        forms = [f"{name}({', '.join(['entity'] * count)})" for name, count in wanted.items()]
        forms += [f"{name}({'entity, ' * question.entities}camera)" for name, question in QUESTIONS.items()]
        forms += [f"{name}(entity, ...)" for name in OF_ALL]
        known = (*wanted, *QUESTIONS, *OF_ALL)
        hint = did_you_mean(function, known) if function not in known else ""
        raise WordError("unknown function", received=repr(text), accepted=", ".join(forms), hint=hint)
    groups = [matching(pattern, world.names()) for pattern in patterns]
    if function in PAIRS:
        (unit, between), pair = PAIRS[function], _Rows([world.find(group[0]) for group in groups])
        return Term(text, unit, 1, (text,), lambda world: np.array([[between(world, pair(world))]]))
    unit, column, measure = CALLS[function]
    entities = [world.find(name) for name in groups[0]]
    for entity in entities:
        _kinds(world, entity, column)
        if function == "error":
            check_foretold(world, entity)
    names, rows = tuple(f"{function}({name})" for name in groups[0]), _Rows(entities)
    return Term(text, unit, 1, names, lambda world: measure(world, rows(world))[:, None], tuple(entities))


def _of_all(text: str, function: str, patterns: list[str], axis: str | None, world: World) -> Term:
    """Return the term of a function that is one place of all the bodies that are meant, everybody by default."""
    rows: Callable[[World], Integers] = dynamic_rows
    if patterns:
        named = dict.fromkeys(world.find(name) for pattern in patterns for name in matching(pattern, world.names()))
        bodies = [entity for entity in named if world.table(RigidBody).present[world.row(entity)]]
        if not bodies:
            raise WordError("is of no body", received=repr(text), accepted="names of entities with body")
        rows = _Rows(bodies)
    measure = OF_ALL[function]

    def read(world: World) -> Floats:
        place = measure(world, rows(world))[None, :]
        return place if axis is None else place[:, [AXES.index(axis)]]

    return Term(text, "m", 3 if axis is None else 1, (text,), read)


def _question(text: str, function: str, patterns: list[str], world: World) -> Term:
    question = QUESTIONS[function]
    camera = patterns[-1] if len(patterns) > question.entities else None
    groups = [matching(pattern, world.names()) for pattern in patterns[: question.entities]]
    # Of a pair each is one entity; a question about one may be asked of each of several.
    asked = [tuple(group[0] for group in groups)] if question.entities > 1 else [(name,) for name in groups[0]]
    entities = [tuple(world.find(name) for name in names) for names in asked]
    for some in entities:
        check_drawn(world, some)
    read_camera(world, camera)
    end = "" if camera is None else f", {camera}"
    names = tuple(f"{function}({', '.join(some)}{end})" for some in asked)

    def read(world: World) -> Floats:
        return np.array([[world[Pictures].ask(function, some, camera)] for some in entities])

    of = tuple(some[0] for some in entities) if question.entities == 1 else ()
    return Term(text, question.unit, 1, names, read, of, looks=True)


def _column(text: str, end: int, names: list[str], world: World) -> Term:
    """Return the term of a column, whose name follows those of entities from ``end`` on."""
    entities = [world.find(name) for name in names]
    steps = text[end + 1 :].split(".")
    if steps[0] == WORD and len(steps) > 1 and all(emits(world, entity) for entity in entities):
        unit, size, measure = particle_measure(text, steps[1:])
        told = tuple(".".join([name, *steps]) for name in names)
        return Term(text, unit, size, told, lambda world: np.array([measure(world, entity) for entity in entities]))
    steps = spelled_out(world, entities[0], steps)
    part = steps.pop() if len(steps) > 1 and steps[-1] in (*AXES, *WAYS) else None
    kind = _kinds(world, entities[0], *steps)
    for entity in entities[1:]:
        _kinds(world, entity, *steps)
    column = kind.columns[steps[-1]]
    if column.dtype.kind not in "fiub":
        raise WordError("is no number", received=repr(text), accepted="columns of numbers")
    size, units = int(np.prod(column.shape)), column.unit.split(", ")
    parts = WAYS if column.shape == (len(WAYS),) else AXES[:size]
    if part is not None and part not in parts:
        raise WordError(f"{steps[-1]} has no {part}", received=repr(text), accepted=", ".join(parts))
    if part is None and len(units) > 1:
        raise WordError(f"{steps[-1]} has a value for each way", received=repr(text), accepted=", ".join(parts))
    axis, rows = None if part is None else parts.index(part), _Rows(entities)
    unit = units[-1] if axis is not None and axis >= TURNS else units[0]

    def read(world: World) -> Floats:
        values = np.asarray(getattr(world[kind], steps[-1]).take(rows(world), axis=0), np.float64)
        values = values.reshape(len(entities), size)
        return values if axis is None else values[:, axis : axis + 1]

    whole = tuple(name + text[end:] for name in names)
    place = Place(kind, steps[-1], axis)
    return Term(text, unit, 1 if axis is not None else size, whole, read, tuple(entities), place=place)


def _kinds(world: World, entity: Entity, *steps: str) -> type[Component]:
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
