"""Progress: where in the step the current substep is."""

from __future__ import annotations

from typing import NamedTuple

from carom.ecs import World, system
from carom.ecs.component import Resource
from carom.ecs.relations.enter import Enter, Exit
from carom.ecs.relations.hit import Hit
from carom.ecs.relations.impact import Impact
from carom.ecs.relations.joint_break import JointBreak
from carom.ecs.relations.touching import ContactBegin, ContactEnd
from carom.systems.settings import Settings

EVENTS = (Impact, Hit, Enter, Exit, ContactBegin, ContactEnd, JointBreak)


class Stop(NamedTuple):
    """Why and when (s) the flight of a substep has stopped, as `fly_on` tells it.

    That was after so many impacts and looks; the next look is ``soon`` (s), and by so much ``more`` looks are counted
    if detection holds. It ``goes_on`` where anything has been since the last look.
    """

    reason: int
    at: float
    events: int
    looks: float
    soon: float
    more: float
    goes_on: bool


class Progress(Resource):
    """Simulated time at the start of the substep, what the step has left after it (s), and its resting manifolds.

    Where it is ``crowded``, so many may meet within the step that detection foresees a substep only. There were so many
    ``detections`` in the step. Once it has ``gone_on`` nothing is left to do in the substep, but where its flight has
    ``stopped``.
    """

    clock: float = 0.0
    left: float = 0.0
    substep: int = 0
    resting: int = 0
    crowded: bool = False
    gone_on: bool = False
    detections: int = 0
    stopped: Stop | None = None

    def come_to(self, substep: int, dt: float, world: World) -> None:
        """Set the clock to the start of a substep, from 1 on, of the current step."""
        settings = world[Settings]
        self.substep = substep
        self.clock = (world.frame - 1) * settings.dt + (substep - 1) * dt
        self.left = (settings.substeps - substep) * dt

    @property
    def foreseen(self) -> float:
        """For how long after the substep (s) detection is to foresee."""
        return 0.0 if self.crowded else self.left


@system(reads=(Settings,), writes=(Progress, *EVENTS))
def begin_step(world: World, dt: float) -> None:
    """Forget the events of the step before and set the clock."""
    progress = world[Progress]
    progress.substep, progress.crowded, progress.detections = 0, False, 0
    for kind in EVENTS:
        if world[kind].count:
            world.resize(kind, 0)


@system(reads=(Settings,), writes=(Progress,))
def begin_substep(world: World, dt: float) -> None:
    """Set the clock to the start of the substep."""
    progress = world[Progress]
    progress.come_to(progress.substep + 1, dt, world)
    progress.gone_on = False
