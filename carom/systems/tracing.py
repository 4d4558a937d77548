"""Tracing: the system after which a number is none for the first time, and the contact or joint it came by."""

from __future__ import annotations

import numpy as np

from carom.ecs import Component, ExternalForce, Force, Motion, NonFiniteError, Transform, World
from carom.ecs.column import Booleans, Floats, Integers
from carom.ecs.components.flight import Flight
from carom.ecs.components.joint import Joint
from carom.ecs.relations.contact import Contact
from carom.systems.awake import Awake
from carom.systems.ends import ends_there

Columns = dict[type[Component], tuple[str, ...]]
MOTION: Columns = {Motion: ("linear", "angular"), Transform: ("position", "rotation")}
SUMS: Columns = {Force: ("force", "torque", "drag", "drag_flow"), ExternalForce: ("force", "torque")}
MOVING: Columns = {Flight: ("felt", "angular_acceleration", "acceleration"), **MOTION}
OF_CONTACTS = ("normal", "depth", "point", "friction", "restitution", "impulse", "friction_impulse")
BY_CONTACTS = ("hold", "drift", "settle", "relax")  # systems in which contacts and joints act
END = "found at the end of the step"
UNIT = 1e-6  # by which the length of a normal may be off 1


def refuse_not_finite(world: World) -> None:
    """Raise NonFiniteError for a pose or velocity that is no number at the end of a step."""
    _of_bodies(world, MOTION, world[Awake].now(world), END)


def refuse_contacts(world: World) -> None:
    """Raise NonFiniteError for a number of a contact that is none, which may pass by everybody unnoticed."""
    contact = world[Contact]
    live = slice(0, contact.count)
    if not np.isfinite(sum(getattr(contact, name)[live].sum() for name in ("normal", "depth", "impulse"))):
        _of_contacts(world, END)


def refuse_stated(world: World) -> None:
    """Raise NonFiniteError for what code outside the step has set to no number."""
    stated: Columns = {ExternalForce: SUMS[ExternalForce], **MOTION}
    _of_bodies(world, stated, world[Awake].now(world), "set by code outside the step", ahead=1)


def find_source(world: World, system: str) -> None:
    """Raise NonFiniteError for the first number that is none right after a system.

    Forces and contacts are looked at before what they move, so that what is named is where it began.
    """
    rows, by = world[Awake].now(world), f"written by system '{system}'"
    _of_bodies(world, SUMS, rows, by)
    _of_contacts(world, by)
    _of_bodies(world, MOVING, rows, by, through=system in BY_CONTACTS)


def not_finite(values: Floats) -> Booleans:
    """Return for each row (n, *size) whether a number of it is none."""
    return np.asarray(~np.isfinite(values).reshape(len(values), int(np.prod(values.shape[1:]))).all(axis=1))


def _of_bodies(world: World, kinds: Columns, rows: Integers, by: str, *, through: bool = False, ahead: int = 0) -> None:
    for kind, names in kinds.items():
        for name in names:
            values = getattr(world[kind], name)[rows]
            for place in np.nonzero(not_finite(values))[0][:1]:
                entity, column = world.name(world.entity(rows[place])), f"{kind.__name__}.{name}"
                cause = _through(world, int(rows[place])) if through else ""
                raise NonFiniteError(world.frame + ahead, column, entity, str(values[place].tolist()), by + cause)


def _of_contacts(world: World, by: str) -> None:
    contact = world[Contact]
    for name in OF_CONTACTS:
        values = getattr(contact, name)[: contact.count]
        for place in np.nonzero(not_finite(values))[0][:1]:
            pair = " and ".join(world.names_told(np.array([contact.a[place], contact.b[place]])))
            raise NonFiniteError(world.frame, f"Contact.{name}", pair, str(values[place].tolist()), by)


def _through(world: World, row: int) -> str:
    """Return in words the contacts and joints that acted on a body, those with a normal that is none before all."""
    contact = world[Contact]
    live = slice(0, contact.count)
    touching = np.nonzero((contact.body_a[live] == row) | (contact.body_b[live] == row))[0]
    length = np.sqrt((contact.normal[touching] ** 2).sum(axis=1))
    bad = touching[np.abs(length - 1.0) > UNIT]
    for place in bad[:1]:
        pair = " and ".join(world.names_told(np.array([contact.a[place], contact.b[place]])))
        return f", by the contact of {pair}, whose normal is {contact.normal[place].tolist()}"
    rows, a, b = ends_there(world, Joint)
    joints = world.names_told(world.entities(rows[(a == row) | (b == row)]))
    others = np.where(contact.body_a[touching] == row, contact.b[touching], contact.a[touching])
    told = [f"its contact with {', '.join(world.names_told(np.unique(others)))}"] if len(touching) else []
    told += [f"its joint {', '.join(joints)}"] if joints else []
    return f", by {' or '.join(told)}" if told else ""
