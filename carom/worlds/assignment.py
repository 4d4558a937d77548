"""Assignments to a world in mid-run: ``crate.material.friction *= 0.5``, ``gravity.y = -1.62``. No code is run."""

from __future__ import annotations

import re
from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np

from carom.ecs import RigidBody, World
from carom.ecs.column import Floats, Integers
from carom.ecs.errors import CaromError, did_you_mean
from carom.ecs.spatial import quaternion
from carom.systems.simulation import Simulation
from carom.worlds.check import check
from carom.worlds.errors import WordError
from carom.worlds.expect_moment import frame_of
from carom.worlds.expression import evaluate
from carom.worlds.generated.settings import SETTING_UNITS, setting_types
from carom.worlds.quantity import quantity
from carom.worlds.source import Source
from carom.worlds.term import AXES, Place, Term
from carom.worlds.terms import read_term
from carom.worlds.units import parse_unit, read_quantity

FORM = re.compile(r"\s*([^=]+?)\s*([-+*/]?)=(?!=)\s*(.+?)\s*")
ACCEPTED = "'crate.material.friction *= 0.5', 'rain[*].linear.y = 3 m/s', 'gravity.y = -1.62' and the like"
CHANGES = {"+": np.add, "-": np.subtract, "*": np.multiply, "/": np.divide}
FIXED = ("seed", "dimensions")  # settings that are of the start
ROTATIONS = ("rotation", "principal_axes")


def assign(simulation: Simulation, text: str, place: str = "assign") -> None:
    """Change columns of entities, or a setting, as a text says: ``assign(simulation, "gravity.y *= 0.5")``.

    ``=``, ``+=``, ``-=``, ``*=`` and ``/=`` take an expression over columns, settings and numbers with units, or a list
    of them; a pattern of names assigns to each. With a mass its moments of inertia change as well, and after a new dt
    the frames are counted as if it had always been so. Raises CaromError, which begins with ``place`` and the text, for
    everything that cannot be, and changes nothing then.
    """
    try:
        found = FORM.fullmatch(text)
        if found is None:
            raise WordError("is no assignment", accepted=ACCEPTED)
        target, operator, value = found.groups()
        if target.partition(".")[0] in setting_types():
            _assign_setting(simulation, target, operator, value)
        else:
            _assign_column(simulation, target, operator, value)
    except WordError as fault:
        if fault.name and not fault.hint:  # of no entity; it may have been meant for a setting
            fault.hint = did_you_mean(fault.name, setting_types())
        raise CaromError(fault.line(f"{place}: {text}")) from None


def _assign_column(simulation: Simulation, target: str, operator: str, text: str) -> None:
    world = simulation.world
    term = read_term(target, world)
    place = term.place
    if place is None or place.kind.columns[place.name].dtype.kind != "f":
        raise WordError("is no column of numbers", received=repr(target), accepted=ACCEPTED)
    column = place.kind.columns[place.name]
    if column.role not in ("state", "input") or place.name.startswith("inverse_"):
        what = f"{place.kind.__name__}.{place.name} follows from other columns"
        raise WordError(what, received=repr(target), accepted="columns that a step does not compute anew")
    if not term.there(world).all():
        raise WordError(term.absence(world), received=repr(target), accepted="who is there")
    before = term.read(world)
    after = _changed(before, operator, _value(text, "1" if operator in ("*", "/") else term.unit, simulation))
    for value in np.unique(after).tolist():
        read_quantity(value, term.unit, **column.bounds)
    _write(world, term, place, after)
    simulation.wake(*world.entities(_rows(term, world)))


def _rows(term: Term, world: World) -> Integers:
    assert term.cast is not None, "a column is of somebody"
    return term.cast.rows(world)


def _write(world: World, term: Term, place: Place, values: Floats) -> None:
    """Write values (entities, size) into a column, and what goes with them."""
    rows = _rows(term, world)
    with world.edit(place.kind) as table:
        column = getattr(table, place.name)
        if isinstance(table, RigidBody) and place.name == "mass":  # of the same shape
            share = values[:, 0] / column[rows]
            table.inertia[rows] *= share[:, None]
            table.inverse_mass[rows] /= share
            table.inverse_inertia[rows] /= share[:, None]
        if place.axis is not None:
            column[rows, place.axis] = values[:, 0]
        else:
            column[rows] = values.reshape(len(rows), *column.shape[1:])
        if place.name in ROTATIONS:
            column[rows] = quaternion.normalise(column[rows])


def _assign_setting(simulation: Simulation, target: str, operator: str, text: str) -> None:
    name, dot, part = target.partition(".")
    before = getattr(simulation.settings, name)
    if name in FIXED:
        raise WordError(f"{name} is settled at the start", received=repr(target))
    if isinstance(before, (str, bool)):
        value: Any = _word(text, operator)
    else:
        parts = AXES[: len(before)] if isinstance(before, tuple) else ()
        if dot and part not in parts:
            raise WordError(f"{name} has no {part}", received=repr(target), accepted=", ".join(parts) or name)
        unit = "1" if operator in ("*", "/") else SETTING_UNITS.get(name, "1")
        values = np.array([before], np.float64).reshape(1, -1)
        axes = [parts.index(part)] if dot else list(range(values.shape[1]))
        values[:, axes] = _changed(values[:, axes], operator, _value(text, unit, simulation))
        value = values[0].tolist() if parts else values[0, 0].item()
    _settle(simulation, name, value)


def _settle(simulation: Simulation, name: str, value: Any) -> None:
    """Let a simulation go on by another setting; the time is the same."""
    source = Source("", "")
    if isinstance(getattr(simulation.settings, name), int) and isinstance(value, float) and value.is_integer():
        value = int(value)
    taken = check(source, setting_types()[name], value, (name,))
    for fault in source.faults:
        raise WordError(fault.what, received=fault.received, accepted=fault.accepted, hint=fault.hint)
    settings = replace(simulation.settings, **{name: taken})
    frame = simulation.frame if settings.dt == simulation.settings.dt else frame_of(simulation.time, settings.dt)
    simulation.settings, simulation.world.frame = settings, frame
    simulation.world.add(settings)


def _word(text: str, operator: str) -> Any:
    if operator:
        raise WordError("computes with what is no number", accepted="= and a word")
    return {"true": True, "false": False}.get(text, text)


def _value(text: str, unit: str, simulation: Simulation) -> Floats:
    """Return what an expression, or a list of them, comes to in a unit, (1,) or (n,)."""
    look_up = partial(_look_up, simulation)
    parts = text[1:-1].split(",") if text.startswith("[") and text.endswith("]") else [text]
    found: list[float] = []
    for part in parts:
        value = evaluate(part.strip(), look_up)
        found += [read_quantity(one, unit) for one in (value if isinstance(value, list) else [value])]
    return np.array(found)


def _look_up(simulation: Simulation, name: str) -> object:
    """Return the value of a setting or a column, with its unit, in an expression."""
    first, dot, part = name.partition(".")
    if first in SETTING_UNITS:
        values, unit = np.atleast_1d(getattr(simulation.settings, first)), SETTING_UNITS[first]
        if dot and part not in AXES[: len(values)]:
            raise WordError(f"{first} has no {part}", accepted=", ".join(AXES[: len(values)]))
        values = values[[AXES.index(part)]] if dot else values
    else:
        term = read_term(name, simulation.world)
        if len(term.names) > 1:
            raise WordError("is of several entities", received=repr(name), accepted="the name of one")
        if not term.there(simulation.world).all():
            raise WordError(term.absence(simulation.world), received=repr(name), accepted="who is there")
        values, unit = term.read(simulation.world)[0], term.unit
    made = [quantity(float(value), parse_unit(unit).dimension) for value in values]
    return made[0] if len(made) == 1 else made


def _changed(before: Floats, operator: str, value: Floats) -> Floats:
    """Return values (n, size) changed by one number, or one for each component."""
    size = before.shape[1]
    if len(value) not in (1 if size == 1 or operator in ("*", "/") else size, size):
        accepted = "one number" if size == 1 else f"a list of {size} numbers"
        raise WordError("takes as many numbers as it has components", accepted=accepted)
    if not operator:
        return np.broadcast_to(value, before.shape).astype(np.float64)
    with np.errstate(all="ignore"):
        return np.asarray(CHANGES[operator](before, value))
