"""Compounds: a collider that is carried belongs to the nearest body above it, and that body weighs what they all do."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np

from carom.ecs import Collider, Material, Parent, RigidBody, Transform, Visual, World
from carom.ecs.column import Floats, Integers
from carom.ecs.component import Resource
from carom.ecs.errors import DeclarationError
from carom.ecs.hierarchy import levels
from carom.ecs.spatial import quaternion
from carom.systems.bodies import centers_of_mass
from carom.systems.mass import Part, rigid_body
from carom.systems.settings import Settings
from carom.systems.shapes import BY_NUMBER, Shape
from carom.systems.shapes.geometry import Geometries


class StatedBodies(Resource):
    """What was stated of each body, for when further colliders come to belong to it."""

    def __init__(self) -> None:
        self.words: dict[int, Mapping[str, Any]] = {}

    def note(self, entities: Integers, words: Mapping[str, Any]) -> None:
        """Note the words of bodies, in which numbers may have a row for each."""
        widths = {key: len(column.shape) for key, column in RigidBody.columns.items()}
        each = [key for key in words if key in widths and np.ndim(words[key]) > widths[key]]
        for number, entity in enumerate(entities.tolist()):
            self.words[entity] = {**words, **{key: words[key][number] for key in each}} if each else words


def bodies_of(world: World) -> Integers:
    """Return for each row in use the row of the body it belongs to: itself, the nearest that carries it, or -1."""
    own = world.own_rows(RigidBody)
    carried = levels(world, world.row_numbers(Parent, Transform))
    if not carried:
        return own
    body: Integers = own.copy()
    for level in carried:
        carriers = world.slots.rows(world[Parent].entity[level])
        body[level] = np.where(own[level] >= 0, level, body[carriers])
    return body


def joining(world: World, rows: Integers) -> Integers:
    """Return the bodies (rows) that carry colliders among ``rows``; raise DeclarationError for a static shape."""
    body = bodies_of(world)[rows]
    joins = (body >= 0) & (body != rows) & world.table(Collider).present[rows]
    for row, owner in zip(rows[joins].tolist(), body[joins].tolist(), strict=True):
        shape = BY_NUMBER[int(world[Collider].shape[row])]
        if shape.static:
            name = world.name(world.entity(owner))
            raise DeclarationError(f"collider.{shape.key}: only a static entity may have it, and '{name}' has a body")
    return np.unique(body[joins])


def weigh(world: World, bodies: Integers) -> None:
    """Give bodies (rows) the mass, centre and inertia of all colliders that belong to them, each by its own material.

    What was stated of a body goes before; sensors it carries weigh nothing. Raises DeclarationError for one without
    mass.
    """
    stated, dimensions = world[StatedBodies].words, world[Settings].dimensions
    for body, parts in parts_of(world, bodies):
        made = rigid_body(stated.get(world.entity(body), {}), parts, dimensions)
        with world.edit(RigidBody) as table:
            for name, value in vars(made).items():
                getattr(table, name)[body] = value


def parts_of(world: World, bodies: Integers) -> Iterator[tuple[int, list[Part]]]:
    """Yield each of some bodies (rows) with what it weighs by: its colliders, and those it carries but for sensors."""
    belongs, rows = bodies_of(world), world.row_numbers(Collider)
    rows = rows[~world[Collider].sensor[rows] | (belongs[rows] == rows)]
    rows = rows[np.argsort(belongs[rows], kind="stable")]
    first, last = (np.searchsorted(belongs[rows], bodies, side) for side in ("left", "right"))
    for body, begin, end in zip(bodies.tolist(), first, last, strict=True):
        yield body, [part_at(world, row, body) for row in rows[begin:end].tolist()]


def part_at(world: World, row: int, body: int) -> Part:
    """Return a collider as a part of the body that carries it, or whose row it is."""
    collider, parent = world[Collider], world[Parent]
    solid, density = shape_at(world, row).mass_properties(), float(world[Material].density[row])
    position, rotation = collider.position[row], collider.rotation[row]
    while row != body:
        turn = parent.rotation[row]
        position = parent.position[row] + quaternion.rotate(turn, position)
        rotation = quaternion.multiply(turn, rotation)
        row = world.row(int(parent.entity[row]))
    return Part(solid, density, position, rotation)


def shape_at(world: World, row: int, kind: type[Collider | Visual] = Collider) -> Shape:
    """Return the shape of a collider, or of a visual."""
    shaped = world[kind]
    number = int(shaped.geometry[row])
    geometry = world[Geometries].items[number] if number >= 0 else None
    return BY_NUMBER[int(shaped.shape[row])].from_size(shaped.size[row], geometry)


def bound_centers(world: World, rows: Integers) -> Floats:
    """Return the middles (n, 3), m, world frame, of the bounds of colliders (rows)."""
    transform = world[Transform]
    middle = quaternion.rotate(transform.rotation[rows], world[Collider].bound_center[rows])
    return np.asarray(transform.position[rows] + middle)


def reaches(world: World) -> Floats:
    """Return for each row in use how far (m) the colliders of that body reach from its centre of mass; 0 for none."""
    belongs, rows = bodies_of(world), world.row_numbers(Collider, Transform)
    rows = rows[belongs[rows] >= 0]
    away = np.linalg.norm(bound_centers(world, rows) - centers_of_mass(world, belongs[rows]), axis=1)
    found = np.zeros(len(belongs))
    np.maximum.at(found, belongs[rows], away + bounding_radii(world, rows))
    return found


def bounding_radii(world: World, rows: Integers) -> Floats:
    """Return the radii (n,) in m of balls about the bounds of colliders, around their middles; inf without an end."""
    collider = world[Collider]
    return np.asarray(np.linalg.norm(collider.bound_half[rows], axis=1) + collider.bound_radius[rows])
