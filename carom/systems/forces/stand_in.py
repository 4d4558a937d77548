"""Stand-in: a small world of test bodies, on which the force systems of the step act as on any others.

So a law has one formula, for bodies, for particles and for who asks what a field is somewhere.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from typing import Any

import numpy as np

from carom.ecs import Component, Force, Motion, RigidBody, System, Transform, World
from carom.ecs.column import Integers
from carom.ecs.components.flight import Flight
from carom.systems.awake import Awake
from carom.systems.forces.attraction import apply_attraction
from carom.systems.forces.constant_push import apply_constant_push
from carom.systems.forces.drag import apply_linear_drag, apply_quadratic_drag
from carom.systems.forces.gravity import apply_gravity
from carom.systems.forces.gravity_well import apply_gravity_well
from carom.systems.forces.law import Forces, Law, choose_bodies
from carom.systems.forces.reach import Reach
from carom.systems.forces.vortex import apply_vortex
from carom.systems.forces.wind import apply_wind
from carom.systems.integration import clear_forces
from carom.systems.progress import Progress
from carom.systems.settings import Settings

STAND_AS = (Transform, Motion, RigidBody, Force, Flight)
#: What acts there, in the order of the step; the others need to know how a body is turned, or who else is there.
FIELDS = (
    choose_bodies,
    clear_forces,
    apply_wind,
    apply_vortex,
    apply_gravity,
    apply_gravity_well,
    apply_attraction,
    apply_linear_drag,
    apply_quadratic_drag,
    apply_constant_push,
)


NOWHERE = Reach(entities=())


class StandIn(World):
    """A world of ``count`` bodies, of which the first ``shown`` are there."""

    def __init__(self, count: int) -> None:
        super().__init__(capacity=count)
        self.spawn_many(count, *(kind() for kind in STAND_AS))
        self.shown = count
        self._numbers = np.arange(count)
        for resource in (Progress(), Awake()):
            self.add(resource)

    def row_numbers(self, *kinds: type[Component], **options: Any) -> Integers:
        """Return the rows of the bodies that stand here, none for what they do not have."""
        return self._numbers[: self.shown if set(kinds) <= set(STAND_AS) else 0]

    def rows(self, *kinds: type[Component], **options: Any) -> slice:
        """Return the same as a slice."""
        return slice(0, len(self.row_numbers(*kinds)))

    def feel(
        self,
        laws: Iterable[tuple[Law, Reach]],
        settings: Settings,
        clock: float,
        dt: float,
        further: Iterable[System] = (),
    ) -> Force:
        """Return what laws and further systems do to who stands here, in a substep from ``clock`` (s) of ``dt`` (s)."""
        acting = Forces()
        for law, reach in laws:
            acting.add(law, reach)
        self.add(acting)
        self.add(settings)
        self[Progress].clock = clock
        self[Awake].rows, self[Awake].found = self.row_numbers(), self.structure
        with self.faces(None):
            for system in (*FIELDS, *further):
                system(self, dt)
            return self[Force]


def felt_laws(world: World, time: float, felt: Callable[[Law, Reach], bool]) -> Iterator[tuple[Law, Reach]]:
    """Yield every law of a world with where it acts at a time (s), those that are not ``felt`` nowhere.

    These are told too, so that each is the same in number as for bodies, which gusts depend on.
    """
    for entries in world[Forces].entries.values():
        for law, reach in entries:
            yield law, Reach(region=reach.region) if felt(law, reach) and reach.acts_at(time) else NOWHERE
