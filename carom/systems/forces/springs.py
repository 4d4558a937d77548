"""Springs: two bodies, or a body and a point, pulled towards each other along a line."""

from __future__ import annotations

import numpy as np

from carom.ecs import Force, Motion, RigidBody, Transform, World, system
from carom.ecs.column import Integers
from carom.ecs.components.spring import Spring
from carom.ecs.spatial import quaternion
from carom.systems.ends import ends_there
from carom.systems.forces.standing import Standing
from carom.systems.kernels.springs import add_springs


# Standing is what the phase of laws is asked by.
@system(reads=(Transform, Motion, RigidBody, Standing), writes=(Spring,), adds=(Force,))
def apply_springs(world: World, dt: float) -> None:
    """Add what springs and their dampers pull, equal and opposite, with its torque about the centres of mass."""
    rows, row_a, row_b = ends_there(world, Spring)
    if not len(rows):
        return
    spring, force = world[Spring], world[Force]
    transform, motion, body = world[Transform], world[Motion], world[RigidBody]
    add_springs(
        rows, row_a, row_b, spring.anchor_a, spring.anchor_b, spring.rest_length, spring.stiffness, spring.damping,
        transform.position, transform.rotation, motion.linear, motion.angular, body.center_of_mass, body.inverse_mass,
        spring.length, spring.tension, force.force, force.torque,
    )  # fmt: skip


def bodies_on_springs(world: World) -> Integers:
    """Return the rows of the bodies that springs pull; they are pulled another way as soon as anybody moves."""
    _, row_a, row_b = ends_there(world, Spring)
    ends = np.unique(np.concatenate([row_a, row_b]))
    return np.asarray(ends[(ends >= 0) & (world[RigidBody].inverse_mass[ends] > 0.0)])


def spring_energy(world: World) -> float:
    """Return k (l - l0)^2 / 2 of all springs in J."""
    rows, row_a, row_b = ends_there(world, Spring)
    if not len(rows):
        return 0.0
    spring, transform = world[Spring], world[Transform]
    ends = []
    for anchors, of in ((spring.anchor_a[rows], row_a), (spring.anchor_b[rows], row_b)):
        turned = transform.position[of] + quaternion.rotate(transform.rotation[of], anchors)
        ends.append(np.where((of >= 0)[:, None], turned, anchors))
    apart = ends[1] - ends[0]
    stretch = np.sqrt((apart * apart).sum(axis=1)) - spring.rest_length[rows]
    return 0.5 * float((spring.stiffness[rows] * stretch * stretch).sum())
