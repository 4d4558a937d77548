"""Energy and momentum of a world, for observers; the step never calls this."""

from __future__ import annotations

import numpy as np

from carom.ecs import Motion, RigidBody, Transform, World
from carom.ecs.column import Floats, Integers
from carom.ecs.spatial import quaternion
from carom.systems.bodies import centers_of_mass, dynamic_rows
from carom.systems.forces.law import Forces
from carom.systems.forces.springs import spring_energy
from carom.systems.kernels.observing import find_kinetic_energies, find_weights, sum_energies
from carom.systems.settings import Settings


def kinetic_energies(world: World, rows: Integers) -> Floats:
    """Return each body's energy of motion and rotation (n,) in J."""
    energies = np.empty(len(rows))
    with world.faces(None):  # as within a system: else kernels are handed copies of columns
        body, motion, rotation = world[RigidBody], world[Motion], world[Transform].rotation
        find_kinetic_energies(
            rows, body.mass, body.inertia, body.principal_axes, rotation, motion.linear, motion.angular, energies
        )
    return energies


def kinetic_energy(world: World) -> float:
    """Return the energy of motion and rotation of all dynamic bodies in J."""
    return float(kinetic_energies(world, dynamic_rows(world)).sum())


def potential_energies(world: World) -> dict[str, float]:
    """Return -s m g.x summed, k (l - l0)^2 / 2 and what force laws have, in J, by their forces.

    The scale s is what each body makes of gravity. Laws with a region or a time window have none: a body does not get
    back in it, or later, what it left there.
    """
    rows, gravity = dynamic_rows(world), np.array(world[Settings].gravity, np.float64)
    weights = np.empty(len(rows))
    with world.faces(None):
        body, pose = world[RigidBody], world[Transform]
        find_weights(
            rows, body.mass, body.gravity_scale, body.center_of_mass, pose.position, pose.rotation, gravity, weights
        )
    return {"gravity": float(weights.sum())} | _held(world)


def _held(world: World) -> dict[str, float]:
    """Return what springs and force laws hold of bodies, in J, by their forces."""
    energies = {"springs": spring_energy(world)}
    for kind, entries in world[Forces].entries.items():
        if kind.conservative:
            held = [(law, reach.rows(world)) for law, reach in entries if reach.conserves]
            with world.faces(None):
                energies[kind.key] = sum(law.energy_of(world, rows) for law, rows in held)
    return energies


def kinetic_and_potential(world: World) -> tuple[float, float]:
    """Return both energies in J, but for rounding as one by one and in half the time."""
    sums = np.empty(2)
    with world.faces(None):
        rows = world.row_numbers(Transform, Motion, RigidBody)
        body, motion, pose = world[RigidBody], world[Motion], world[Transform]
        sum_energies(
            rows, body.inverse_mass, body.mass, body.inertia, body.principal_axes, body.gravity_scale,
            body.center_of_mass, pose.position, pose.rotation, motion.linear, motion.angular,
            np.array(world[Settings].gravity, np.float64), sums,
        )  # fmt: skip
        held = _held(world)
    return float(sums[0]), float(sums[1]) + sum(held.values())


def potential_energy(world: World) -> float:
    """Return the energy of all `potential_energies` in J."""
    return sum(potential_energies(world).values())


def total_energy(world: World) -> float:
    """Return the sum of `kinetic_and_potential` in J."""
    kinetic, potential = kinetic_and_potential(world)
    return kinetic + potential


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
