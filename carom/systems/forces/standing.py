"""Standing: forces that are the same in every substep of a step are summed in the first."""

from __future__ import annotations

from carom.ecs import World
from carom.ecs.column import Integers
from carom.ecs.component import Resource
from carom.ecs.components.spring import Spring
from carom.systems.awake import Awake
from carom.systems.forces.law import Forces
from carom.systems.progress import Progress


class Standing(Resource):
    """The bodies (rows) whose accelerations stay what they were summed to in this step; None where they may not.

    Weight, damping and forces from outside stay. Laws, springs and systems that are not carom's may look at poses,
    velocities and the time, and what a torque does depends on how a body is turned. Who hears of every system is told
    of each force in every substep.
    """

    rows: Integers | None = None
    heard: bool = False

    def judge(self, world: World, *, turns: bool) -> None:
        """Say whether the forces just summed stay; ``turns`` tells of torques among them."""
        awake = world[Awake]
        varies = self.heard or turns or awake.strangers or world[Forces].count or len(world.row_numbers(Spring))
        self.rows = None if varies else awake.now(world)


def forces_vary(world: World) -> bool:
    """Tell whether forces are to be summed in this substep: in the first, for who woke since, and where they vary."""
    return world[Progress].substep == 1 or world[Standing].rows is not world[Awake].now(world)
