"""The ``oracle`` section of a world file: where entities should be, by closed forms."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from typing import Any, NamedTuple

import numpy as np

from carom.ecs import Motion, RigidBody, Transform, World
from carom.ecs.column import Floats, Integers
from carom.ecs.component import Resource
from carom.systems.bodies import centers_of_mass, dynamic_rows
from carom.systems.forces import Forces
from carom.systems.forces.gravity_well import GravityWell
from carom.systems.forces.mutual_gravitation import MutualGravitation
from carom.systems.settings import Settings, time_of
from carom.worlds.closed_forms import ballistic, kepler
from carom.worlds.errors import Path, ReportedError, WordError, shown
from carom.worlds.expression import LookUp, evaluate
from carom.worlds.names import NONE_DEFINED, known, matching
from carom.worlds.quantity import Quantity
from carom.worlds.source import Source
from carom.worlds.units import read_quantity

SECOND = (0, 0, 1, 0, 0)  # the dimension of t
Motions = Callable[[float], Floats]  # where something is (3,) in m, at a time in s


class Form(NamedTuple):
    """Where an entity's origin should be or, of closed forms of mechanics, its centre of mass."""

    at: Motions
    of_center: bool


class Oracle(Resource):
    """The closed forms of a world, by the entities they are of."""

    def __init__(self) -> None:
        self.forms: dict[int, Form] = {}

    def rows(self, world: World) -> Integers:
        """Return the rows of the entities that have one and are there."""
        there = [world.row(entity) for entity in self.forms if world.slots.lives(entity)]
        return np.array(there, np.int64)

    def positions(self, world: World, rows: Integers, time: float | None = None) -> Floats:
        """Return where origins should be (n, 3) in m, now or at a time (s), of bodies turned as they are now."""
        time = time_of(world) if time is None else time
        forms = [self.forms[int(world.entity(row))] for row in rows]
        should = np.array([form.at(time) for form in forms]).reshape(-1, 3)
        offset = centers_of_mass(world, rows) - world[Transform].position[rows]
        return np.asarray(should - np.where(np.array([form.of_center for form in forms])[:, None], offset, 0.0))


def errors(world: World, rows: Integers) -> Floats:
    """Return how far entities are from where they should be (m)."""
    away = world[Transform].position[rows] - world[Oracle].positions(world, rows)
    return np.asarray(np.linalg.norm(away, axis=1))


def check_foretold(world: World, names: Iterable[str]) -> None:
    """Raise WordError for an entity without a closed form."""
    told = {world.name(entity): None for entity in world[Oracle].forms} if Oracle in world else {}
    for name in names:
        if name not in told:
            accepted = ", ".join(told) or "an entity of the section oracle"
            raise WordError(f"oracle says nothing of {name}", accepted=accepted)


def read_oracle(source: Source, world: World, stated: Mapping[str, Any], look_up: LookUp) -> Oracle:
    """Return the oracle of checked words (None: already reported); report whatever cannot be foretold."""
    oracle = Oracle()
    for pattern, words in stated.items():
        path: Path = ("oracle", pattern)
        try:
            names = matching(pattern, world.names()) if words is not None else []
        except WordError as fault:
            source.report_value(path, fault)
            continue
        for name in names:
            try:
                oracle.forms[int(world.find(name))] = _form(source, world, path, name, words, look_up)
            except WordError as fault:
                source.report_value(path, fault)
            except ReportedError:
                continue
    return oracle


def _form(source: Source, world: World, path: Path, name: str, words: Any, look_up: LookUp) -> Form:
    if not isinstance(words, str) and words.position is not None:
        return Form(_stated(source, path, words.position, look_up), False)
    row = world.row(world.find(name))
    if row not in dynamic_rows(world):
        raise WordError(f"{name} is no body that obeys forces", accepted="an entity with body, or position: [...]")
    if words == "ballistic":
        gravity = np.array(world[Settings].gravity) * world[RigidBody].gravity_scale[row]
        position, velocity = _state(world, row)
        return Form(lambda time: ballistic(position, velocity, gravity, time), True)
    return Form(_round_well(world, row) if words == "kepler" else _round_other(source, world, path, row, words), True)


def _state(world: World, row: int) -> tuple[Floats, Floats]:
    return centers_of_mass(world, np.array([row]))[0], world[Motion].linear[row].copy()


def _round_well(world: World, row: int) -> Motions:
    wells = [law for law, _ in world[Forces].entries.get(GravityWell, ())]
    if len(wells) != 1:
        raise WordError("goes round no single gravity_well", received=f"{len(wells)} of them", accepted="one")
    center, (position, velocity) = np.array(wells[0].position), _state(world, row)
    return lambda time: center + kepler(wells[0].strength, position - center, velocity, time)


def _round_other(source: Source, world: World, path: Path, row: int, words: Any) -> Motions:
    """Return the way of one of two bodies about their common centre of mass, which goes on evenly."""
    try:
        other = world.row(world.find(known("entity", words.kepler, world.names())))
    except WordError as fault:
        source.report_value((*path, "kepler"), fault)
        raise ReportedError from None
    laws = [law for law, _ in world[Forces].entries.get(MutualGravitation, ())]
    if len(laws) != 1 or other not in dynamic_rows(world) or other == row:
        what = "goes round nobody: it needs one mutual_gravitation and another body"
        raise WordError(what, received=repr(words.kepler))
    (position, velocity), (center, drift) = _state(world, row), _state(world, other)
    mass, others = world[RigidBody].mass[row], world[RigidBody].mass[other]
    strength, share = laws[0].constant * (mass + others), others / (mass + others)
    away, past = position - center, velocity - drift
    middle, going = position - share * away, velocity - share * past
    return lambda time: middle + going * time + share * kepler(strength, away, past, time)


def _stated(source: Source, path: Path, stated: Any, look_up: LookUp) -> Motions:
    """Return three lengths, each a number or an expression of ``t`` and the file's variables."""
    place = (*path, "position")
    if not isinstance(stated, list) or len(stated) != 3:
        received, accepted = shown(stated), "numbers in m, or expressions of t"
        source.report(place, "must be a list of 3 lengths", received=received, accepted=accepted)
        raise ReportedError

    def part(value: Any, time: float) -> float:
        return read_quantity(evaluate(value, names_at(time, look_up)) if isinstance(value, str) else value, "m")

    faults = 0
    for number, value in enumerate(stated):
        try:
            part(value, 0.0)
        except WordError as fault:
            source.report_value((*place, number), fault)
            faults += 1
    if faults:
        raise ReportedError

    def at(time: float) -> Floats:
        try:
            return np.array([part(value, time) for value in stated])
        except WordError:  # a formula may end: a root of what is below 0
            return np.full(3, np.nan)

    return at


def names_at(time: float, look_up: LookUp) -> LookUp:
    """Return what looks up the variables of a file and t, which is ``time`` (s)."""

    def named(name: str) -> object:
        if name == "t":
            return Quantity(time, SECOND)
        try:
            return look_up(name)
        except WordError as fault:
            fault.accepted = "t" if fault.accepted == NONE_DEFINED else f"t, {fault.accepted}"
            raise

    return named
