"""Sampling: what each field of a world does at points of space, for who looks on."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Iterator
from typing import NamedTuple

from carom.ecs import RigidBody, Transform, World
from carom.ecs.column import Floats
from carom.ecs.components.flight import Flight
from carom.systems.forces.law import Forces, Law
from carom.systems.forces.reach import Reach
from carom.systems.forces.stand_in import StandIn, felt_laws
from carom.systems.settings import Settings

Points = Callable[[Reach], Floats]


class Sample(NamedTuple):
    """A law at points (n, 3) in m: the force (n, 3) in N on 1 kg at rest, the velocity (n, 3) of a medium in m/s."""

    name: str
    reach: Reach
    point: Floats
    force: Floats
    flow: Floats


def probe(most: int) -> StandIn:
    """Return bodies of 1 kg at rest that feel fields alone, not the world's even gravity."""
    stand = StandIn(most)
    with stand.faces(None):
        body = stand[RigidBody]
        body.mass[:] = body.inverse_mass[:] = 1.0
        body.gravity_scale[:] = 0.0
    return stand


def sampled(stand: StandIn, world: World, time: float, points: Points) -> Iterator[Sample]:
    """Yield each law that is a field, at those of the points (n, 3) of its reach where it does anything at a time (s).

    Bodies that stand in, a `probe` of at least n, are taken for such as it acts on. What goes with a medium, such as
    drags, is told in the flow that all bodies meet. Several of a kind have numbers.
    """
    numbers: defaultdict[str, int] = defaultdict(int)
    for law, reach in [entry for entries in world[Forces].entries.values() for entry in entries]:
        numbers[law.key] += 1
        if not reach.acts_at(time):
            continue
        at = points(reach)
        force, flow = _felt(stand, world, law, time, at)
        there = force.any(axis=1) | flow.any(axis=1)
        if there.any():
            name = law.key.replace("_", " ") + (f" {numbers[law.key]}" if numbers[law.key] > 1 else "")
            yield Sample(name, reach, at[there], force[there], flow[there])


def _felt(stand: StandIn, world: World, law: Law, time: float, at: Floats) -> tuple[Floats, Floats]:
    """Return the force (N) of a law and the velocity (m/s) of its medium at points within its reach."""
    stand.shown = count = len(at)
    with stand.faces(None):
        stand[Transform].position[:count] = stand[Flight].start_center[:count] = at

    def felt(other: Law, reach: Reach) -> bool:
        everybody = reach.entities is None and reach.layers is None
        return other is law or (other.moves_medium and not law.moves_medium and everybody)

    settings = world[Settings]
    step = settings.dt / settings.substeps
    force = stand.feel(felt_laws(world, time, felt), settings, time - 0.5 * step, step)
    flow = force.medium[:count] if law.moves_medium else law.flow(world, at)
    return force.force[:count] + force.drag_flow[:count], flow.copy()
