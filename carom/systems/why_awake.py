"""Why a body is awake: who keeps its island from falling asleep, told in words with numbers."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from carom.ecs import Motion, RigidBody, World
from carom.ecs.column import Integers
from carom.ecs.relations.contact import Contact
from carom.systems.compound import bodies_of
from carom.systems.constants import SLEEP_SPEED, SLEEP_TIME
from carom.systems.forces.law import Forces
from carom.systems.forces.springs import bodies_on_springs
from carom.systems.links import companies, islands, links, nearby
from carom.systems.settings import Settings, time_of
from carom.systems.sleep_state import surface_speeds

if TYPE_CHECKING:
    from carom.systems.simulation import Simulation


def why_awake(of: World | Simulation, entity: int | str) -> str:
    """Say why a body (handle or name, or that of a part of it) did not fall asleep in the last step, or that it sleeps.

    The fastest body of its island is named with its speed and the limit; then who may not fall asleep, what keeps the
    island up, and how long it has been still.
    """
    world = of if isinstance(of, World) else of.world
    handle = world.find(entity) if isinstance(entity, str) else int(entity)
    row, name = int(bodies_of(world)[world.row(handle)]), f"'{world.name(handle)}'"
    if row < 0:
        return f"{name} has no body; it stands"
    body, motion = world[RigidBody], world[Motion]
    if motion.asleep[row]:
        return f"{name} sleeps"
    if body.inverse_mass[row] == 0.0:
        return f"{name} is kinematic; it neither rests nor sleeps"
    if not world[Settings].sleeping:
        return f"{name} is awake since nobody falls asleep in this world: sleeping is off"
    rows = world.row_numbers(RigidBody)
    rows = rows[body.inverse_mass[rows] > 0.0]
    island, company = islands(world, rows, Contact), companies(world)
    own = rows[island[rows] == island[row]]
    if reason := _unrest(world, row, name, own):
        return reason
    beside = rows[(company[rows] == company[row]) & (island[rows] != island[row])]
    for other in np.unique(island[beside]).tolist():
        if reason := _unrest(world, other, f"'{world.name(world.entity(other))}'", beside[island[beside] == other]):
            whom = "it" if len(own) == 1 else f"its island of {len(own)} bodies"
            return f"{name} is awake since others are near enough to touch {whom} within a step: {reason}"
    return f"{name} is awake, and falls asleep in the next step"


def _unrest(world: World, row: int, name: str, island: Integers) -> str | None:
    """Say what keeps a body and its island (rows) awake, None where they by themselves might fall asleep."""
    body, motion = world[RigidBody], world[Motion]
    others = "" if len(island) == 1 else f", in its island of {len(island)} bodies"
    speed = surface_speeds(world, island)
    fastest, quickest = island[np.argmax(speed)], speed.max()

    def told(who: int, reason: str) -> str:
        if who == row:
            return f"{name} is awake since it {reason}"
        return f"{name} is awake since '{world.name(world.entity(who))}'{others}, {reason}"

    if quickest > SLEEP_SPEED:
        return told(fastest, f"moves at {quickest:.3g} m/s; at {SLEEP_SPEED:g} m/s or less it may fall asleep")
    for restless in island[~body.sleeps[island]]:
        return told(restless, "may not fall asleep: its body says so (sleeps)")
    for law, rows in world[Forces].at(world, time_of(world)).restless(world):
        for pulled in island[np.isin(island, rows)]:
            return told(pulled, f"is pushed another way in every step, by {law.key}")
    for pulled in island[np.isin(island, bodies_on_springs(world))]:
        return told(pulled, "is pulled by a spring, so another way as soon as its other end moves")
    moving, held = _supports_of(world, island, links(world, Contact))
    for support in moving:
        return f"{name} is awake since '{world.name(world.entity(support))}', which moves, touches or holds it{others}"
    for support in _supports_of(world, island, nearby(world))[0]:
        return f"{name} is awake since '{world.name(world.entity(support))}', which moves, may touch it{others}"
    if not held and not world[Forces].borne(world)[island].all():
        return f"{name} is awake since nothing that stands touches or holds it{others}: what drifts slowly goes on"
    newest = island[np.argmin(motion.still[island])]
    if motion.still[newest] >= SLEEP_TIME:
        return None
    return told(newest, f"has been still for {motion.still[newest]:.3g} s; after {SLEEP_TIME:g} s it falls asleep")


def _supports_of(world: World, island: Integers, pairs: tuple[Integers, Integers]) -> tuple[list[int], bool]:
    """Return the kinematic bodies of pairs with an island that move, and whether anything that stands is of one."""
    motion, inverse_mass = world[Motion], world[RigidBody].inverse_mass
    both = np.stack(pairs, axis=1)
    of_island = np.isin(both, island) & (both >= 0)
    supports = both[:, ::-1][of_island]
    supports = supports[(supports < 0) | (inverse_mass[supports] == 0.0)]
    kinematic = np.unique(supports[supports >= 0])
    moves = (motion.linear[kinematic] != 0.0).any(axis=1) | (motion.angular[kinematic] != 0.0).any(axis=1)
    return kinematic[moves].tolist(), len(supports) > 0
