"""Quantities: numbers of a whole world over time, for plots of recordings, films and pictures."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from carom.ecs import RigidBody, World
from carom.ecs.errors import did_you_mean
from carom.ecs.relations.contact import Contact
from carom.systems.energy import kinetic_and_potential, momentum
from carom.worlds.errors import WordError
from carom.worlds.term import AXES
from carom.worlds.terms import read_term

MILLIMETRES = 1e3


class Quantity(NamedTuple):
    """What is measured, its unit, and ``read``, which returns the value of each of its curves by name."""

    title: str
    unit: str
    read: Callable[[World], dict[str, float]]


def energies(world: World) -> dict[str, float]:
    """Return the energies of all dynamic bodies in J."""
    kinetic, potential = kinetic_and_potential(world)
    return {"kinetic": kinetic, "potential": potential, "total": kinetic + potential}


def momenta(world: World) -> dict[str, float]:
    """Return the momentum of all dynamic bodies in kg m/s."""
    return dict(zip(AXES[:3], momentum(world).tolist(), strict=True))


def overlap(world: World) -> dict[str, float]:
    """Return the deepest overlap in mm, 0 where nothing does."""
    contact = world[Contact]
    return {"deepest_mm": MILLIMETRES * max(0.0, float(np.max(contact.depth[: contact.count], initial=0.0)))}


def counts(world: World) -> dict[str, float]:
    """Return how many bodies and contacts there are."""
    return {"bodies": world.count(RigidBody), "contacts": world[Contact].count}


QUANTITIES = {
    "energy": Quantity("energy", "J", energies),
    "momentum": Quantity("momentum", "kg m/s", momenta),
    "overlap": Quantity("deepest overlap", "mm", overlap),
    "counts": Quantity("counts", "1", counts),
}


def quantity(text: str, world: World) -> Quantity:
    """Return the quantity of that name, or a value as expectations state it, such as ``speed(ball)``.

    Raises WordError for what is neither.
    """
    if text in QUANTITIES:
        return QUANTITIES[text]
    try:
        term = read_term(text, world)
    except WordError as fault:
        hint = did_you_mean(text, QUANTITIES) or fault.hint
        accepted = ", ".join((*QUANTITIES, fault.accepted))
        raise WordError(str(fault), received=fault.received, accepted=accepted, hint=hint) from None
    ends = [f".{axis}" for axis in AXES[: term.size]] if 1 < term.size <= len(AXES) else [""] * term.size
    names = [f"{name}{end}" for name in term.names for end in ends]
    return Quantity(text, term.unit, lambda world: dict(zip(names, term.read(world).ravel().tolist(), strict=True)))
