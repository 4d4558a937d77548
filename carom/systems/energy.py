"""Energy and momentum of a world, for observers; the step never calls this."""

from __future__ import annotations

import numpy as np

from carom.ecs import BodyType, Motion, RigidBody, Transform, World
from carom.ecs.column import Floats, Integers
from carom.ecs.spatial import quaternion
from carom.systems.forces.law import Forces
from carom.systems.forces.mutual_gravitation import MutualGravitation
from carom.systems.settings import Settings


def dynamic_rows(world: World) -> Integers:
    """Return the rows of the bodies that obey forces."""
    rows = world.row_numbers(Transform, Motion, RigidBody)
    return np.asarray(rows[world[RigidBody].type[rows] == BodyType.DYNAMIC])


def centers_of_mass(world: World, rows: Integers, poses: Transform | None = None) -> Floats:
    """Return centres of mass (n, 3) in m, world frame, now or at other poses of all rows."""
    transform = world[Transform] if poses is None else poses
    offset = quaternion.rotate(transform.rotation[rows], world[RigidBody].center_of_mass[rows])
    return np.asarray(transform.position[rows] + offset)


def kinetic_energies(world: World, rows: Integers) -> Floats:
    """Return each body's energy of motion and rotation (n,) in J."""
    body, linear = world[RigidBody], world[Motion].linear[rows]
    spin, _ = _in_principal_axes(world, rows)
    moving = body.mass[rows] * (linear * linear).sum(axis=1)
    return np.asarray(0.5 * (moving + (body.inertia[rows] * spin * spin).sum(axis=1)))


def kinetic_energy(world: World) -> float:
    """Return the energy of motion and rotation of all dynamic bodies in J."""
    return float(kinetic_energies(world, dynamic_rows(world)).sum())


def potential_energies(world: World) -> dict[str, float]:
    """Return -s m g.x summed, and -G m1 m2 / r (softened as the force is), in J, by the force they are of.

    The scale s is what each body makes of gravity.
    """
    rows = dynamic_rows(world)
    body, center = world[RigidBody], centers_of_mass(world, rows)
    weighing = body.mass[rows] * body.gravity_scale[rows]
    weight = -float((weighing * (center @ np.array(world[Settings].gravity))).sum())
    laws = world[Forces].acting(MutualGravitation, world)
    return {
        "gravity": weight,
        MutualGravitation.key: sum(_attraction_energy(world, acting, law) for law, acting in laws),
    }


def potential_energy(world: World) -> float:
    """Return the energy of all `potential_energies` in J."""
    return sum(potential_energies(world).values())


def _attraction_energy(world: World, rows: Integers, law: MutualGravitation) -> float:
    mass, center = world[RigidBody].mass[rows], centers_of_mass(world, rows)
    first, second = np.triu_indices(len(rows), 1)
    gap = center[first] - center[second]
    distance = np.sqrt((gap * gap).sum(axis=1) + law.softening**2)
    return -law.constant * float((mass[first] * mass[second] / distance).sum())


def total_energy(world: World) -> float:
    """Return kinetic and potential energy in J."""
    return kinetic_energy(world) + potential_energy(world)


def momenta(world: World, rows: Integers) -> Floats:
    """Return each body's mass times velocity (n, 3) in kg m/s."""
    return np.asarray(world[RigidBody].mass[rows, None] * world[Motion].linear[rows])


def momentum(world: World) -> Floats:
    """Return the momentum of all dynamic bodies (3,) in kg m/s."""
    return np.asarray(momenta(world, dynamic_rows(world)).sum(axis=0))


def angular_momenta(world: World, rows: Integers) -> Floats:
    """Return each body's angular momentum about the world's origin (n, 3) in kg m2/s."""
    spin, axes = _in_principal_axes(world, rows)
    orbital = np.cross(centers_of_mass(world, rows), momenta(world, rows))
    return np.add(orbital, quaternion.rotate(axes, world[RigidBody].inertia[rows] * spin))


def angular_momentum(world: World) -> Floats:
    """Return the angular momentum of all dynamic bodies about the world's origin (3,) in kg m2/s."""
    return np.asarray(angular_momenta(world, dynamic_rows(world)).sum(axis=0))


def _in_principal_axes(world: World, rows: Integers) -> tuple[Floats, Floats]:
    """Return angular velocities (n, 3) along the principal axes, and those axes as quaternions (n, 4) to the world."""
    axes = quaternion.multiply(world[Transform].rotation[rows], world[RigidBody].principal_axes[rows])
    return quaternion.rotate(quaternion.conjugate(axes), world[Motion].angular[rows]), axes
