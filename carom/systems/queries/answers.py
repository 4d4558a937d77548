"""Answers of queries about places, in batches and one by one."""

from __future__ import annotations

from typing import NamedTuple

from carom.ecs import Entity
from carom.ecs.column import Floats, Integers


class Closest(NamedTuple):
    """The nearest place of each collider within reach, in order of queries and distance."""

    query: Integers  # which of the points, or of the places of a shape
    entity: Integers
    collider: Integers
    distance: Floats  # m; below 0 inside: how far out is
    point: Floats  # (n, 3), m, on the collider
    own: Floats  # (n, 3), m, on the shape that asks, or the point itself
    normal: Floats  # (n, 3), unit, out of the collider


class Nearest(NamedTuple):
    """The nearest of all, to one point or shape; see `Closest`."""

    entity: Entity
    collider: Entity
    distance: float
    point: Floats
    own: Floats
    normal: Floats


class Overlaps(NamedTuple):
    """Who overlaps a shape where it is, in order of queries and, the deepest first, of depth."""

    query: Integers
    entity: Integers
    collider: Integers
    depth: Floats  # m
    point: Floats  # (n, 3), m, midway between the surfaces
    normal: Floats  # (n, 3), unit, out of the collider


class Overlap(NamedTuple):
    """The deepest of all overlaps of one shape; see `Overlaps`."""

    entity: Entity
    collider: Entity
    depth: float
    point: Floats
    normal: Floats


class Insides(NamedTuple):
    """Which points are inside of which colliders, in order of points and colliders."""

    point: Integers
    entity: Integers
    collider: Integers


def nearest(found: Closest) -> Nearest | None:
    """Return the first of all by itself, None where there is none."""
    if not len(found.query):
        return None
    _, entity, collider, distance, point, own, normal = (column[0] for column in found)
    return Nearest(Entity(int(entity)), Entity(int(collider)), float(distance), point, own, normal)


def deepest(found: Overlaps) -> Overlap | None:
    """Return the first of all by itself, None where there is none."""
    if not len(found.query):
        return None
    _, entity, collider, depth, point, normal = (column[0] for column in found)
    return Overlap(Entity(int(entity)), Entity(int(collider)), float(depth), point, normal)
