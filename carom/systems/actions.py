"""Actions: what an event of a world may do, each a dataclass whose ``key`` is its word in files."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import ClassVar

import numpy as np

from carom.ecs import Component, RigidBody, Transform, World
from carom.ecs.column import Floats, Integers
from carom.ecs.components.joint import Joint
from carom.ecs.components.path import Path
from carom.ecs.components.rigid_body import BodyType
from carom.ecs.components.spring import Spring
from carom.ecs.spatial import quaternion
from carom.systems.bodies import centers_of_mass
from carom.systems.declared import Stated, Steps, called
from carom.systems.explosion import Explosion, blast
from carom.systems.parameters import vector
from carom.systems.pushes import Pushes

Vector = tuple[float, float, float]


class Action(Stated):
    """What is done at a time, between two phases of a step."""

    key: ClassVar[str] = ""
    entities: tuple[str, ...] = ()

    def rows(self, world: World) -> Integers:
        """Return the rows of whom it names, of those who are there now, each once."""
        found = [world.slots.rows(world.find_all(pattern)) for pattern in self.entities]
        return np.unique(np.concatenate(found)) if found else np.zeros(0, np.int64)

    def unfit(self, world: World, row: int) -> str:
        """Return what is wrong with an entity that it names; nothing where it is right."""
        return ""

    def pushes(self, world: World) -> Pushes | None:
        """Return the impulses it gives."""
        return None

    def change(self, world: World) -> None:
        """Change what it changes beside velocities."""

    def again(self, number: int) -> Action:
        """Return what is done the time of that number, from 0, where it is done several times."""
        return self


@dataclass(frozen=True)
class Impulse(Action):
    """Gives bodies an impulse, all at once."""

    key: ClassVar[str] = "impulse"
    entities: tuple[str, ...] = called(doc="names of bodies, or patterns like shell_*")
    linear: Vector = vector(unit="N s", doc="impulse, frame of the world", default=(0.0, 0.0, 0.0))
    angular: Vector = vector(unit="N m s", doc="angular impulse, frame of the world", default=(0.0, 0.0, 0.0))
    at: Vector | None = vector(unit="m", doc="where, frame of the body; its centre of mass by default", default=None)

    def faults(self) -> Iterator[tuple[Steps, str]]:
        """Refuse an impulse of nothing."""
        if not any((*self.linear, *self.angular)):
            yield (), "must give linear or angular, received neither"

    def unfit(self, world: World, row: int) -> str:
        """Refuse what has no body; a kinematic one may obey forces by then."""
        return "" if world.table(RigidBody).present[row] else "has no body"

    def pushes(self, world: World) -> Pushes:
        """Return the impulse on each body that obeys forces."""
        rows = dynamic_among(world, self.rows(world))
        center = point = centers_of_mass(world, rows)
        if self.at is not None:
            transform = world[Transform]
            point = transform.position[rows] + quaternion.rotate(transform.rotation[rows], np.array(self.at))
        impulse: Floats = np.tile(self.linear, (len(rows), 1))
        return Pushes(self.key, rows, impulse, np.cross(point - center, impulse) + self.angular, point)


@dataclass(frozen=True)
class Explode(Explosion, Action):
    """Lets momentum go out from a point in all directions."""

    key: ClassVar[str] = "explode"

    def pushes(self, world: World) -> Pushes:
        """Return what bodies take of it."""
        return blast(world, self)


@dataclass(frozen=True)
class Release(Action):
    """Lets go: joints and springs hold nobody any more, kinematic bodies obey forces from the velocity they have."""

    key: ClassVar[str] = "release"
    entities: tuple[str, ...] = called(doc="names of joints, springs and kinematic bodies, or patterns")

    def unfit(self, world: World, row: int) -> str:
        """Refuse what holds nobody, and bodies that weigh nothing."""
        if world.table(Joint).present[row] or world.table(Spring).present[row]:
            return ""
        if not world.table(RigidBody).present[row]:
            return "is no joint, no spring and no kinematic body"
        return "" if world[RigidBody].mass[row] > 0.0 else "has no mass; state body.mass"

    def change(self, world: World) -> None:
        """Take joints, springs and keyframes from them, and let bodies be dynamic."""
        rows = self.rows(world)
        for kind in (Joint, Spring, Path):
            if len(held := rows[world.table(kind).present[rows]]):
                world.detach(world.entities(held), kind)
        bodies = rows[world.table(RigidBody).present[rows]]
        entities = world.entities(bodies[world[RigidBody].mass[bodies] > 0.0])
        if len(entities):
            let_move(world, entities)


@dataclass(frozen=True)
class Despawn(Action):
    """Takes entities out of the world, with those they carry."""

    key: ClassVar[str] = "despawn"
    entities: tuple[str, ...] = called(doc="names, or patterns")

    def change(self, world: World) -> None:
        """Remove them."""
        world.despawn(world.entities(self.rows(world)))


@dataclass(frozen=True)
class Spawn(Action):
    """Brings an entity, or several that are alike, into the world, at ``positions`` (n, 3), m."""

    key: ClassVar[str] = "spawn"
    positions: Floats
    names: tuple[str, ...] | None
    bundles: tuple[Component, ...]

    def change(self, world: World) -> None:
        """Add them; copies whose name somebody has by then have none."""
        taken = set(world.names())
        names = None if self.names is None else ["" if name in taken else name for name in self.names]
        world.spawn_many(len(self.positions), *self.bundles, Transform(position=self.positions), names=names)

    def again(self, number: int) -> Spawn:
        """Return those who come that time, called ``hail[number]``, copies ``rain[number,3,0,1]``."""
        if self.names is None:
            return self
        parted = (name.partition("[") for name in self.names)
        names = (f"{base}[{number},{rest}" if rest else f"{base}[{number}]" for base, _, rest in parted)
        return replace(self, names=tuple(names))


ACTIONS: dict[str, type[Action]] = {kind.key: kind for kind in (Impulse, Explode, Release, Despawn, Spawn)}


def dynamic_among(world: World, rows: Integers) -> Integers:
    """Return those of rows that are bodies and obey forces."""
    bodies = rows[world.table(RigidBody).present[rows]]
    return np.asarray(bodies[world[RigidBody].inverse_mass[bodies] > 0.0])


def let_move(world: World, entities: Integers) -> None:
    """Let bodies of any mass obey forces."""
    rows = world.slots.rows(entities)
    with world.edit(RigidBody) as body:
        body.type[rows] = BodyType.DYNAMIC
        body.inverse_mass[rows] = 1.0 / body.mass[rows]
        inertia = body.inertia[rows]
        body.inverse_inertia[rows] = np.where(inertia > 0.0, 1.0 / np.where(inertia > 0.0, inertia, 1.0), 0.0)
