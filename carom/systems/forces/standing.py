"""Standing: forces that are the same in every substep of a step are summed in the first."""

from __future__ import annotations

from carom.ecs import ExternalForce, RigidBody, World
from carom.ecs.column import Integers
from carom.ecs.component import Resource
from carom.ecs.components.spring import Spring
from carom.systems.awake import Awake
from carom.systems.forces.law import Forces
from carom.systems.kernels.forces import some_are_turned


class Standing(Resource):
    """Whether forces stay what they are in this step, and of which bodies (rows) they were summed.

    Weight, damping and forces from outside stay. Laws, springs and systems that are not carom's may look at poses,
    velocities and the time, and what a torque does depends on how a body is turned. Who hears of every system is told
    of each force in every substep.
    """

    stay = False
    rows: Integers | None = None
    heard = False

    def judge(self, world: World) -> None:
        """Say at the beginning of a step whether its forces stay."""
        looked_at = self.heard or world[Awake].strangers or world[Forces].count or len(world.row_numbers(Spring))
        self.stay = not looked_at and not some_are_turned(world.row_numbers(RigidBody), world[ExternalForce].torque)
        self.rows = None


def forces_vary(world: World) -> bool:
    """Tell whether forces are to be summed in this substep: where they do not stay, in the first, and of who woke."""
    standing = world[Standing]
    return not standing.stay or standing.rows is not world[Awake].now(world)


def laws_may_act(world: World) -> bool:
    """Tell whether laws, springs or systems that are not carom's may act: where forces stay there are none."""
    return not world[Standing].stay
