"""Buoyancy: a medium with a level and a density, that bears what is in it and brings it to rest."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from carom.ecs import Collider, Force, Motion, Parent, RigidBody, Transform, World, system
from carom.ecs.column import Booleans, Floats, Integers
from carom.ecs.components.flight import Flight
from carom.systems.bodies import centers_of_mass
from carom.systems.constants import AFLOAT
from carom.systems.forces.immersion import Immersion, Surface, immersed
from carom.systems.forces.law import Forces, Law, parameter, vector
from carom.systems.kernels.buoyancy import add_buoyancy, add_wet_drag
from carom.systems.settings import Settings
from carom.systems.shapes.geometry import Geometries


@dataclass(frozen=True)
class Buoyancy(Law):
    """F = rho g V against gravity at the centre of the volume V below the surface (Archimedes), and drag of that part.

    The surface is across gravity, ``level`` up from the origin. Drag takes velocity to that of the current at the rate
    ``damping`` times the share of the volume that is below (Catto, Exact Buoyancy for Polyhedra, Game Programming Gems
    6, 2006, 2.5), and by 1/2 rho Cd V^(2/3) |u| u, V^(2/3) being the area by which drags of ships and airships are
    measured (Hoerner, Fluid-Dynamic Drag, 1965); spin likewise, by the torque 1/2 rho Cd V^(5/3) |w| w.
    """

    key: ClassVar[str] = "buoyancy"
    conservative: ClassVar[bool] = True
    density: float = parameter(unit="kg/m3", doc="density rho of the medium", default=1000.0, above=0.0)
    level: float = parameter(unit="m", doc="height of its surface", default=0.0)
    damping: float = parameter(
        unit="1/s", doc="rate at which it brings to rest what is all in it", default=0.5, least=0.0
    )
    drag_coefficient: float = parameter(
        unit="1", doc="drag coefficient Cd on V^(2/3), 1 for a cube", default=1.0, least=0.0
    )
    current: tuple[float, float, float] = vector(unit="m/s", doc="velocity of the medium", default=(0.0, 0.0, 0.0))

    def immersion(self, world: World, rows: Integers) -> Immersion:
        """Return what of bodies is in the medium now."""
        mask = np.zeros(world.used(), np.bool_)
        mask[rows] = True
        return immersed(world, mask, Surface.at(world, self.level))

    def energy_of(self, world: World, rows: Integers) -> float:
        """Return rho g V times the depth of the centre of V, summed: what it takes to push it under (J)."""
        surface, found = Surface.at(world, self.level), self.immersion(world, rows)
        if surface.weight == 0.0:
            return 0.0
        return self.density * surface.weight * float((found.volume * found.depth).sum())

    def points(self, world: World, rows: Integers) -> Floats:
        """Return the centres of buoyancy."""
        found, centers = self.immersion(world, rows), centers_of_mass(world, rows)
        volume, moment = np.zeros(world.used()), np.zeros((world.used(), 3))
        np.add.at(volume, found.body, found.volume)
        np.add.at(moment, found.body, found.volume[:, None] * found.center)
        wet = volume[rows] > 0.0
        centers[wet] = moment[rows[wet]] / volume[rows[wet], None]
        return centers

    def flow(self, world: World, points: Floats) -> Floats:
        """Return the current, which is below the surface alone."""
        surface = Surface.at(world, self.level)
        return np.where((points @ np.array(surface.up) <= surface.height)[:, None], self.current, 0.0)

    def bears(self, world: World, rows: Integers) -> Booleans:
        """Tell whom it holds up: who is in it, where it is still, and balanced as forces of the last substep were."""
        if any(self.current):
            return np.zeros(len(rows), np.bool_)
        found, force, body = self.immersion(world, rows), world[Force], world[RigidBody]
        volume = np.zeros(world.used())
        np.add.at(volume, found.body, found.volume)
        least = AFLOAT * self.density * Surface.at(world, self.level).weight * volume[rows]
        lever = np.sqrt(body.inertia[rows].max(axis=1) * body.inverse_mass[rows])
        turning = (body.inverse_inertia[rows] > 0.0).any(axis=1)
        pushed = body.mass[rows] * np.sqrt((world[Flight].felt[rows] ** 2).sum(axis=1))
        twisted = np.sqrt((force.torque[rows] ** 2 * body.freedom[rows, 3:]).sum(axis=1))
        return np.asarray((volume[rows] > 0.0) & (pushed <= least) & ((twisted <= least * lever) | ~turning))


@system(reads=(Forces, Transform, Motion, RigidBody, Collider, Parent, Geometries, Settings), adds=(Force,))
def apply_buoyancy(world: World, dt: float) -> None:
    """Add what media bear at centres of buoyancy, and their drags by the velocities at the middle of the substep."""
    for law, rows in world[Forces].acting(Buoyancy, world):
        transform, motion, body, force = world[Transform], world[Motion], world[RigidBody], world[Force]
        surface, found = Surface.at(world, law.level), law.immersion(world, rows)
        displaced, whole = np.zeros(world.used()), np.zeros(world.used())
        add_buoyancy(
            found.body, found.volume, found.center, found.whole, law.density * surface.weight, *surface.up,
            transform.position, transform.rotation, body.center_of_mass, force.force, force.torque, displaced, whole,
        )  # fmt: skip
        add_wet_drag(
            rows, displaced, whole, law.density, law.drag_coefficient, law.damping, *law.current,
            body.mass, body.inertia, body.inverse_mass, motion.linear, motion.angular,
            force.drag, force.drag_flow, force.angular_drag,
        )  # fmt: skip
