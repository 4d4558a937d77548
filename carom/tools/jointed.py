"""Jointed: where joints and springs are, from body to body, as lines."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from carom.ecs import RigidBody, Transform, World
from carom.ecs.column import Floats, Integers
from carom.ecs.components.joint import LIMITED, LINE, LOCKED, Joint
from carom.ecs.components.spring import Spring
from carom.ecs.spatial import quaternion
from carom.systems.bodies import centers_of_mass
from carom.systems.ends import ends_there

ARC = 25  # points of an arc
COILS = 8
TURN = 2.0 * math.pi


class Jointed(NamedTuple):
    """Joints or springs (rows): anchors, and where the lines to them begin, (n, 3), m, and how a's side is turned.

    A line begins at the centre of mass of a body, and at the anchor itself on what stands.
    """

    rows: Integers
    from_a: Floats
    at_a: Floats
    at_b: Floats
    from_b: Floats
    turn_a: Floats


class Ways(NamedTuple):
    """Ways that are not locked: of which of `Jointed` and which slot (m,), and its axis in the world (m, 3)."""

    joint: Integers
    slot: Integers
    axis: Floats


def jointed(world: World, kind: type[Joint] | type[Spring], transform: Transform) -> Jointed:
    """Return all whose ends are there, at poses of all rows."""
    rows, *ends = ends_there(world, kind)
    table, is_body = world[kind], world.table(RigidBody).present
    found, turns = [], []
    for of, anchors in zip(ends, (table.anchor_a[rows], table.anchor_b[rows]), strict=True):
        turn = np.where((of >= 0)[:, None], transform.rotation[of], quaternion.IDENTITY)
        at = np.where((of >= 0)[:, None], transform.position[of], 0.0) + quaternion.rotate(turn, anchors)
        moves = (of >= 0) & is_body[of]
        found.append((np.where(moves[:, None], centers_of_mass(world, of, transform), at), at))
        turns.append(turn)
    (from_a, at_a), (from_b, at_b) = found
    return Jointed(rows, from_a, at_a, at_b, from_b, turns[0])


def ways_of(world: World, found: Jointed) -> Ways:
    """Return the ways of joints along and about axes; of those that are free all three ways there is nothing to say."""
    joint = world[Joint]
    loose = (joint.mode[found.rows] != LOCKED) & (joint.along[found.rows] != LINE)[:, None]
    loose[:, :3] &= ~loose[:, :3].all(axis=1, keepdims=True)
    loose[:, 3:] &= ~loose[:, 3:].all(axis=1, keepdims=True)
    number, slot = np.nonzero(loose)
    frame = quaternion.multiply(found.turn_a[number], joint.frame_a[found.rows[number]])
    return Ways(number, slot, quaternion.rotate(frame, np.eye(3)[slot % 3]))


def limits_of(world: World, found: Jointed, radius: float) -> tuple[Floats, Floats]:
    """Return lines (k, 2, 3) that show limits, and needles (j, 2, 3) where joints are: arcs about axes, tracks along.

    The needle of an arc of ``radius`` (m) points to the centre of b.
    """
    joint, lines, needles = world[Joint], [np.zeros((0, 2, 3))], [np.zeros((0, 2, 3))]
    ways = ways_of(world, found)
    rows = found.rows[ways.joint]
    lower, upper = (side[rows, ways.slot] for side in (joint.lower, joint.upper))
    bounded = (joint.mode[rows, ways.slot] == LIMITED) & np.isfinite(lower) & np.isfinite(upper)
    for way in np.nonzero(bounded)[0]:
        number, slot, row = ways.joint[way], ways.slot[way], rows[way]
        at, here = found.at_a[number], joint.position[row, slot]
        if slot < 3:
            track = at + np.array([[lower[way]], [upper[way]]]) * ways.axis[way]
            lines.append(track[None])
            needles.append(np.stack([at, at + here * ways.axis[way]])[None])
            continue
        ahead = across(ways.axis[way], found.from_b[number] - at)
        aside = np.cross(ways.axis[way], ahead)
        angles = np.linspace(lower[way], min(upper[way], lower[way] + TURN), ARC)[:, None] - here
        arc = at + radius * (np.cos(angles) * ahead + np.sin(angles) * aside)
        rim = np.stack([arc[:-1], arc[1:]], axis=1)
        lines += [rim, np.stack([[at, arc[0]], [at, arc[-1]]])]
        needles.append(np.stack([at, at + 1.25 * radius * ahead])[None])
    return np.concatenate(lines), np.concatenate(needles)


def across(axis: Floats, towards: Floats) -> Floats:
    """Return the unit vector across a unit axis that goes towards what is there, or any where that is along it."""
    aside = towards - (towards @ axis) * axis
    if aside @ aside < 1e-12:
        aside = np.cross(axis, (0.0, 0.0, 1.0) if abs(axis[2]) < 0.9 else (1.0, 0.0, 0.0))
    return np.asarray(aside / np.sqrt(aside @ aside))


def coiled(starts: Floats, ends: Floats, radius: float) -> Floats:
    """Return points (n, k, 3) of zigzags from starts to ends (n, 3), as wide as ``radius`` (m) to either side."""
    along = ends - starts
    length = np.sqrt((along * along).sum(axis=1, keepdims=True))
    ahead = along / np.maximum(length, 1e-12)
    aside = np.array([across(axis, np.zeros(3)) for axis in ahead]).reshape(-1, 3)
    share = np.concatenate([[0.0, 0.15], np.linspace(0.15, 0.85, 4 * COILS + 1)[1:-1:2], [0.85, 1.0]])
    swing = np.concatenate([[0.0, 0.0], np.tile([1.0, -1.0], COILS), [0.0, 0.0]])
    return np.asarray(
        starts[:, None] + share[None, :, None] * along[:, None] + radius * swing[None, :, None] * aside[:, None]
    )


def is_coil(world: World, found: Jointed) -> Integers:
    """Return the numbers of joints along a line that pull by a spring."""
    joint, rows = world[Joint], found.rows
    return np.nonzero((joint.along[rows] == LINE) & joint.driven[rows, 0])[0]
