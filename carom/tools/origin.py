"""Origin: back along the chain of pushes from a body that moves to whatever set the first of them going."""

from __future__ import annotations

from collections.abc import Iterator
from math import inf
from typing import NamedTuple

import numpy as np

from carom.ecs import Motion, RigidBody, World
from carom.ecs.column import Floats, Integers
from carom.ecs.components.joint import Joint
from carom.ecs.relations.contact import Contact
from carom.ecs.relations.impact import Impact
from carom.systems.causes import take_step
from carom.systems.compound import bodies_of
from carom.systems.constants import SLEEP_SPEED
from carom.systems.ends import ends_there
from carom.systems.settings import Settings
from carom.tools.side import Side

MOST = 0.5  # of a change of velocity: what pushes less did not set a body going


class Link(NamedTuple):
    """One of the chain: who was at rest until ``frame``, and ``by`` whom or what it was set going; in words."""

    frame: int
    entity: str
    by: str
    text: str


class Pushes(NamedTuple):
    """Impulses (n, 3) in N s of bodies b (n,) by bodies a (n,), handles, and when (n,), s."""

    a: Integers
    b: Integers
    impulse: Floats
    time: Floats

    def on(self, entity: int) -> Iterator[tuple[float, int, Floats]]:
        """Yield those of somebody: when, by whom, and the impulse (3,)."""
        for own, other, sign in ((self.b, self.a, 1.0), (self.a, self.b, -1.0)):
            for k in np.nonzero(own == entity)[0].tolist():
                yield float(self.time[k]), int(other[k]), sign * self.impulse[k]


class Frame(NamedTuple):
    """Who lives (n,), handles, how they move (n, 3) after a frame, impacts of it, and what all contacts did in it."""

    handles: Integers
    linear: Floats
    impacts: Pushes
    pushes: Pushes

    def velocity(self, entity: int) -> Floats:
        """Return the velocity (3,) of somebody, 0 for who is not there."""
        place = np.nonzero(self.handles == entity)[0]
        return np.asarray(self.linear[place[0]] if len(place) else np.zeros(3))

    def moves(self, entity: int) -> bool:
        """Tell whether somebody is faster than what may fall asleep."""
        return float(np.linalg.norm(self.velocity(entity))) > SLEEP_SPEED


def trace_back(side: Side, entity: int, last: int) -> list[Link]:
    """Return who set a body (handle) going that moves in a frame, and who set that going, back to where it began.

    All from the first frame on is simulated again.
    """
    simulation = side.start()
    first, frames = simulation.frame, [_look(simulation.world)]
    while simulation.frame < last:
        side.step()
        frames.append(_look(simulation.world))
    world = simulation.world
    chain: list[Link] = []
    who, at, until, seen = entity, last, inf, set[int]()
    while who not in seen:
        seen.add(who)
        name = world.name(who)
        while at > first and not (frames[at - first].moves(who) and not frames[at - first - 1].moves(who)):
            at, until = at - 1, inf
        if at == first:
            speed = float(np.linalg.norm(frames[0].velocity(who)))
            moved = f"moves since then, at {speed:.3g} m/s" if speed else "has not moved since then"
            return [*chain, Link(at, name, "", f"frame {at}: '{name}' {moved}")]
        pushed = world[RigidBody].inverse_mass[world.row(who)] > 0.0  # else it goes its own way
        pusher = _pusher(frames[at - first - 1], frames[at - first], who, until) if pushed else None
        if pusher is None:
            by = _beginning(side, who, at)
            return [*chain, Link(at, name, by, f"frame {at}: '{name}' was at rest until {by} set it going")]
        until, who, impulse = pusher
        by, size = world.name(who), float(np.linalg.norm(impulse))
        did = f"struck it at {until:.6g} s, by {size:.3g} N s" if until < inf else f"pushed it, by {size:.3g} N s in it"
        chain.append(Link(at, name, by, f"frame {at}: '{name}' was at rest until '{by}' {did}"))
    return chain


def _beginning(side: Side, entity: int, frame: int) -> str:
    """Return what set somebody going whom nobody pushed."""
    simulation = side.simulation_at(frame - 1)
    rest = simulation[entity].motion.linear.copy()
    side.redo(simulation)
    if (simulation[entity].motion.linear != rest).any():
        return "code outside the step"
    cause = take_step(simulation, entity).causes[0]
    return f"{cause.source} of '{simulation.world.name(cause.other)}'" if cause.other >= 0 else cause.source


def _look(world: World) -> Frame:
    """Keep how everybody moves, and who pushed whom in the step."""
    contact, impact, joint, handles = world[Contact], world[Impact], world[Joint], world.handles()
    live, struck, bodies = slice(0, contact.count), slice(0, impact.count), bodies_of(world)
    rows, a, b = ends_there(world, Joint)
    pressed = _impulses(contact, live), joint.force[rows] * world[Settings].dt
    pushes = np.concatenate([contact.body_a[live], a]), np.concatenate([contact.body_b[live], b])
    a, b = (bodies[world.slots.rows(side[struck])] for side in (impact.a, impact.b))
    return Frame(
        handles,
        world[Motion].linear[: world.used()].copy(),
        _between(handles, a, b, _impulses(impact, struck), impact.time[struck]),
        _between(handles, *pushes, np.concatenate(pressed), np.full(len(pushes[0]), inf)),
    )


def _impulses(table: Contact | Impact, rows: slice) -> Floats:
    return np.asarray(table.impulse[rows, None] * table.normal[rows] + table.friction_impulse[rows])


def _between(handles: Integers, a: Integers, b: Integers, impulse: Floats, time: Floats) -> Pushes:
    """Return those between two bodies, by their rows."""
    both = (a >= 0) & (b >= 0)
    return Pushes(handles[a[both]], handles[b[both]], impulse[both], time[both])


def _pusher(before: Frame, after: Frame, who: int, until: float) -> tuple[float, int, Floats] | None:
    """Return who struck somebody first in a frame, before a time, or pushed most; None where forces did it."""
    struck = [one for one in after.impacts.on(who) if one[0] < until]
    if struck:
        return min(struck, key=lambda one: one[0])
    change = after.velocity(who) - before.velocity(who)
    way = change / np.linalg.norm(change)
    along: dict[int, Floats] = {}
    for _, other, impulse in after.pushes.on(who):
        along[other] = along.get(other, np.zeros(3)) + impulse
    pushed = {other: push for other, push in along.items() if before.moves(other) or after.moves(other)}
    if not pushed:
        return None
    most = max(pushed, key=lambda other: float(pushed[other] @ way))
    enough = MOST * max(float(push @ way) for push in along.values())
    return (inf, most, pushed[most]) if pushed[most] @ way > enough else None
