"""Terms that are functions of entities, such as ``speed(rain[0,0,1])``."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from carom.ecs import RigidBody, World
from carom.ecs.column import Floats
from carom.ecs.errors import did_you_mean
from carom.systems.bodies import dynamic_rows
from carom.worlds.cast import Cast, cast_of
from carom.worlds.column_terms import kind_of
from carom.worlds.comers import all_names, comers, kinds_of
from carom.worlds.errors import WordError
from carom.worlds.functions import CALLS, OF_ALL, PAIRS
from carom.worlds.names import matching
from carom.worlds.oracle import check_foretold
from carom.worlds.pictures import QUESTIONS, Pictures, check_drawn, read_camera
from carom.worlds.term import AXES, Term


def call_term(text: str, function: str, patterns: list[str], world: World) -> Term:
    """Return the term of a function of one entity, a pair, or a picture; raise WordError."""
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
    groups, coming = [matching(pattern, all_names(world)) for pattern in patterns], comers(world)
    if function in PAIRS:
        return _pair_term(text, function, Cast([group[0] for group in groups], world))
    unit, column, measure = CALLS[function]
    for name in groups[0]:
        kind_of(world, name, coming, column)
    if function == "error":
        check_foretold(world, groups[0])
    names, cast = tuple(f"{function}({name})" for name in groups[0]), Cast(groups[0], world)

    def read(world: World) -> Floats:
        return cast.values(world, 1, lambda rows: measure(world, rows)[:, None])

    return Term(text, unit, 1, names, read, cast, cast.each)


def _pair_term(text: str, function: str, pair: Cast) -> Term:
    unit, between = PAIRS[function]

    def read(world: World) -> Floats:
        both = pair.every(world)[0]
        return np.array([[between(world, pair.rows(world)) if both else np.nan]])

    return Term(text, unit, 1, (text,), read, pair, pair.every)


def term_of_all(text: str, function: str, patterns: list[str], axis: str | None, world: World) -> Term:
    """Return the term of a function of all who are meant together, everybody who obeys forces by default."""
    asked = OF_ALL[function]
    if axis is not None and asked.size == 1:
        raise WordError(f"{function} has no {axis}", received=repr(text))
    cast = cast_of(patterns, world) if patterns else None
    if cast is not None and asked.bodies:
        coming = comers(world)
        cast = Cast([name for name in cast.names if RigidBody in kinds_of(name, world, coming)], world)
        if not cast.names:
            raise WordError("is of no body", received=repr(text), accepted="names of entities with body")

    def read(world: World) -> Floats:
        rows = dynamic_rows(world) if cast is None else cast.rows(world)[cast.each(world)]
        values = asked.measure(world, rows)[None, :]
        return values if axis is None else values[:, [AXES.index(axis)]]

    term = Term(text, asked.unit, asked.size if axis is None else 1, (text,), read, cast)
    return term if cast is None or asked.nobody else replace(term, there=cast.some)


def _question(text: str, function: str, patterns: list[str], world: World) -> Term:
    question = QUESTIONS[function]
    camera = patterns[-1] if len(patterns) > question.entities else None
    groups = [matching(pattern, all_names(world)) for pattern in patterns[: question.entities]]
    # Of a pair each is one entity; a question about one may be asked of each of several.
    asked = [tuple(group[0] for group in groups)] if question.entities > 1 else [(name,) for name in groups[0]]
    cast = Cast([name for some in asked for name in some], world)
    check_drawn(world, cast.names)
    read_camera(world, camera)
    end = "" if camera is None else f", {camera}"
    names = tuple(f"{function}({', '.join(some)}{end})" for some in asked)

    def answer(world: World, rows: list[int]) -> float:
        return np.nan if min(rows) < 0 else world[Pictures].ask(function, map(world.entity, rows), camera)

    def read(world: World) -> Floats:
        groups = cast.rows(world).reshape(len(asked), question.entities)
        return np.array([[answer(world, rows)] for rows in groups.tolist()])

    there = cast.each if question.entities == 1 else cast.every
    return Term(text, question.unit, 1, names, read, cast, there, looks=True)
