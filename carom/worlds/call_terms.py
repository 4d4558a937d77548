"""Terms that are functions of entities, such as ``speed(rain[0,0,1])``."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from carom.ecs import RigidBody, World
from carom.ecs.column import Floats, Integers
from carom.ecs.errors import did_you_mean
from carom.systems.bodies import dynamic_rows
from carom.worlds.column_terms import kind_of
from carom.worlds.errors import WordError
from carom.worlds.functions import CALLS, OF_ALL, PAIRS
from carom.worlds.names import matching
from carom.worlds.oracle import check_foretold
from carom.worlds.pictures import QUESTIONS, Pictures, check_drawn, read_camera
from carom.worlds.term import AXES, Rows, Term


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
    groups = [matching(pattern, world.names()) for pattern in patterns]
    if function in PAIRS:
        (unit, between), pair = PAIRS[function], Rows([world.find(group[0]) for group in groups])
        return Term(text, unit, 1, (text,), lambda world: np.array([[between(world, pair(world))]]))
    unit, column, measure = CALLS[function]
    entities = [world.find(name) for name in groups[0]]
    for entity in entities:
        kind_of(world, entity, column)
        if function == "error":
            check_foretold(world, entity)
    names, rows = tuple(f"{function}({name})" for name in groups[0]), Rows(entities)
    return Term(text, unit, 1, names, lambda world: measure(world, rows(world))[:, None], tuple(entities))


def place_of_all(text: str, function: str, patterns: list[str], axis: str | None, world: World) -> Term:
    """Return the term of a function that is one place of all the bodies that are meant, everybody by default."""
    rows: Callable[[World], Integers] = dynamic_rows
    if patterns:
        named = dict.fromkeys(world.find(name) for pattern in patterns for name in matching(pattern, world.names()))
        bodies = [entity for entity in named if world.table(RigidBody).present[world.row(entity)]]
        if not bodies:
            raise WordError("is of no body", received=repr(text), accepted="names of entities with body")
        rows = Rows(bodies)
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
