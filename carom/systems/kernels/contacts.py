"""What follows of a contact from its two colliders."""

from __future__ import annotations

import numpy as np

# mypy: disable-error-code="no-untyped-def"
from carom.ecs.components.material import Combine
from carom.systems.kernels.balls import BOX, HALF_SPACE
from carom.systems.kernels.blow_points import is_smooth
from carom.systems.kernels.cores import CONE_SHAPE, CONVEX_SHAPE, CYLINDER_SHAPE, ELLIPSOID_SHAPE
from carom.systems.kernels.crew import runs_of, shared
from carom.systems.kernels.kernel import woven
from carom.systems.kernels.narrow import POINT_SHAPE, SPHERE_SHAPE, kind_and_extent, reach_of_pair
from carom.systems.kernels.offsets import find_offsets
from carom.systems.kernels.recycling import seat_pair, turned
from carom.systems.kernels.rolling import roll_on
from carom.systems.kernels.shares import find_faces, find_shares, is_land, is_round

AVERAGE, SQRT, MIN, MULTIPLY = Combine.AVERAGE.value, Combine.SQRT.value, Combine.MIN.value, Combine.MULTIPLY.value


@woven
def combined(x, y, rule_x, rule_y, default):
    """Return one value of two materials by the stronger of their rules, or by the quantity's default."""
    rule = max(rule_x, rule_y)
    if rule == 0:
        rule = default
    if rule == AVERAGE:
        return 0.5 * (x + y)
    if rule == SQRT:
        return np.sqrt(x * y)
    if rule == MIN:
        return min(x, y)
    if rule == MULTIPLY:
        return x * y
    return max(x, y)


@shared(
    "changed", "friction", "restitution", "rolling", "spinning", "surface", "row_a", "row_b", "body_a", "body_b",
    "offset_a", "offset_b", "share", "kind", "ball", "other", "sign", "radius", "extent",
    "other_position", "other_rotation", "seat_a", "seat_b", "lean_a", "lean_b", "seat_depth", "seat_reach", "form",
)  # fmt: skip
def complete_contacts(
    crew, count, match, recycled_from, known, belts, middle, changed, normal, depth, point, row_a, row_b,
    body_row, shape, size, geometry, polyhedron, face_start, normals, bound_half, bound_radius,
    pose_position, pose_rotation, center, rotation, reach, asleep, passes, angular, inverse_mass,
    material_friction, material_restitution, material_rolling, material_spinning, friction_rule, restitution_rule,
    surface_velocity,
    friction, restitution, rolling, spinning, surface, body_a, body_b, offset_a, offset_b, share,
    kind, ball, other, sign, radius, extent, other_position, other_rotation,
    seat_a, seat_b, lean_a, lean_b, seat_depth, seat_reach, form,
):  # fmt: skip
    """Fill in what follows from the two colliders: bodies, offsets, material, surface, and whether impacts are exact.

    Of those that were not recycled (``recycled_from`` is below 0), also where they are on the two shapes; of others
    `recycle_contacts` says their offsets. Contacts of what is round and a face are where they will have rolled on to in
    the ``middle`` (s) of what is foreseen. Exact are balls about their body's centre of mass against balls, boxes
    likewise centred, and half spaces. Where all are ``known``, what follows from shapes and materials, and where others
    stand, is there of pairs that are where they were (``match``), and what does not hang on exact arcs of those
    recycled. Each thread tells in ``changed`` whether it was not, or a surface runs; without ``belts`` none does.
    """
    end, until = runs_of(crew, row_a[:count], row_b[:count])
    while end < until:
        recycled = recycled_from[end] >= 0
        if recycled and known and not belts and kind[end] < 0:  # most often
            end += 1
            continue
        first, a, b, there = end, row_a[end], row_b[end], known
        while end < until and row_a[end] == a and row_b[end] == b:
            there &= match[end] == end
            end += 1
        if not recycled:
            seat_pair(
                first, end, a, b, reach_of_pair(a, b, body_row, reach, asleep, passes), normal, depth, point,
                shape, size, geometry, pose_position, pose_rotation,
                seat_a, seat_b, lean_a, lean_b, seat_depth, seat_reach, form,
            )  # fmt: skip
        on_a, on_b = body_row[a], body_row[b]
        belt = belts and (runs(a, surface_velocity) or runs(b, surface_velocity))
        what, i, o, sense, ex, ey, ez = exact_pair(
            a, b, shape, size, body_row, pose_position, pose_rotation, center, rotation, inverse_mass
        )
        anew = not there or what != kind[first]
        changed[crew[1]] |= anew or belt
        if anew:
            rubs = combined(material_friction[a], material_friction[b], friction_rule[a], friction_rule[b], SQRT)
            bounces = combined(
                material_restitution[a], material_restitution[b], restitution_rule[a], restitution_rule[b], 0
            )
            lever = smaller_lever(
                roll_radius(a, shape, size, bound_half, bound_radius),
                roll_radius(b, shape, size, bound_half, bound_radius),
            )
            # Never more than friction can carry, else resistance to rolling would make the body slide.
            rolls = min(max(material_rolling[a], material_rolling[b]), rubs) * lever
            spins = max(material_spinning[a], material_spinning[b]) * lever
            for c in range(first, end):
                body_a[c], body_b[c] = on_a, on_b
                friction[c], restitution[c], rolling[c], spinning[c], kind[c] = rubs, bounces, rolls, spins, what
                surface[c, 0], surface[c, 1], surface[c, 2] = 0.0, 0.0, 0.0
                if what < 0:
                    continue
                sign[c], ball[c], other[c], radius[c] = sense, body_row[i], body_row[o], size[i, 0]
                extent[c, 0], extent[c, 1], extent[c, 2] = ex, ey, ez
                if body_row[o] >= 0:
                    continue  # the body says where it is
                for k in range(3):
                    other_position[c, k] = pose_position[o, k]
                    if what == HALF_SPACE:
                        other_position[c, k] += size[o, 3] * extent[c, k]
                for k in range(4):
                    other_rotation[c, k] = pose_rotation[o, k]
        for c in range(first, end if belt else first):
            surface[c, 0], surface[c, 1], surface[c, 2] = surface_of_pair(
                c, a, b, normal, surface_velocity, pose_rotation
            )
        if not recycled:
            find_offsets(first, end, a, b, normal, depth, point, body_row, pose_position, center, offset_a, offset_b)
            find_shares(first, end, a, b, normal, shape, pose_rotation, share)
            if is_round(a, shape) or is_round(b, shape):
                find_faces(
                    first, end, a, b, normal, point, shape, size, geometry, pose_position, pose_rotation,
                    polyhedron, face_start, normals, share,
                )  # fmt: skip
            for i, o, body, outward, flat, offset, offset_other in (
                (a, b, on_a, 1.0, 0.0, offset_a, offset_b), (b, a, on_b, -1.0, 1.0, offset_b, offset_a),
            ):  # fmt: skip
                if body >= 0 and (is_land(o, shape) or share[first] == flat) and is_smooth(i, shape):
                    roll_on(
                        first, end, i, body, outward, middle, shape, size, pose_position, pose_rotation, center,
                        angular, normal, offset, offset_other,
                    )  # fmt: skip


@woven
def roll_radius(i, shape, size, bound_half, bound_radius):
    """Return how far (m) from its middle a collider rolls, the mean where that varies; 0 of boxes and planes."""
    if shape[i] == CYLINDER_SHAPE or shape[i] == CONE_SHAPE:
        return size[i, 0]
    if shape[i] == ELLIPSOID_SHAPE or shape[i] == CONVEX_SHAPE:
        return (bound_half[i, 0] + bound_half[i, 1] + bound_half[i, 2]) / 3.0
    return bound_radius[i]


@woven
def smaller_lever(x, y):
    """Return the smaller of two radii, of which one that is 0 says nothing."""
    return max(x, y) if x == 0.0 or y == 0.0 else min(x, y)


@woven
def exact_pair(a, b, shape, size, body_row, pose_position, pose_rotation, center, rotation, inverse_mass):
    """Return how a ball meets another of exact arcs, the ball, the other, 1 or -1 where it is b, and an extent.

    The first is -1 where there is no such pair.
    """
    i, o, sense = a, b, 1.0
    if not is_free_ball(a, shape, body_row, pose_position, center, inverse_mass):
        i, o, sense = b, a, -1.0
        if not is_free_ball(b, shape, body_row, pose_position, center, inverse_mass):
            return -1, i, o, sense, 0.0, 0.0, 0.0
    what, ex, ey, ez = kind_and_extent(
        shape[o], size[o, 0], size[o, 1], size[o, 2],
        pose_rotation[o, 0], pose_rotation[o, 1], pose_rotation[o, 2], pose_rotation[o, 3],
    )  # fmt: skip
    body = body_row[o]
    if body >= 0 and not (
        is_centred(o, body, pose_position, center) and (what != BOX or is_aligned(o, body, pose_rotation, rotation))
    ):
        what = -1
    return what, i, o, sense, ex, ey, ez


@woven
def surface_of_pair(c, a, b, normal, surface_velocity, pose_rotation):
    """Return the velocity of b's surface against a's, beyond that of their bodies, along contact c."""
    ax, ay, az = turned(a, a, surface_velocity, pose_rotation)
    bx, by, bz = turned(b, b, surface_velocity, pose_rotation)
    x, y, z = bx - ax, by - ay, bz - az
    across = normal[c, 0] * x + normal[c, 1] * y + normal[c, 2] * z
    return x - across * normal[c, 0], y - across * normal[c, 1], z - across * normal[c, 2]


@woven
def runs(i, surface_velocity):
    """Tell whether a collider's surface runs like a belt."""
    return surface_velocity[i, 0] != 0.0 or surface_velocity[i, 1] != 0.0 or surface_velocity[i, 2] != 0.0


@woven
def is_centred(collider, body, pose_position, center):
    """Tell whether a collider's shape lies about its body's centre of mass."""
    return (
        pose_position[collider, 0] == center[body, 0]
        and pose_position[collider, 1] == center[body, 1]
        and pose_position[collider, 2] == center[body, 2]
    )


@woven
def is_aligned(collider, body, pose_rotation, rotation):
    """Tell whether a collider's shape is turned as its body is."""
    return (
        pose_rotation[collider, 0] == rotation[body, 0]
        and pose_rotation[collider, 1] == rotation[body, 1]
        and pose_rotation[collider, 2] == rotation[body, 2]
        and pose_rotation[collider, 3] == rotation[body, 3]
    )


@woven
def is_free_ball(collider, shape, body_row, pose_position, center, inverse_mass):
    """Tell whether a collider is a ball or point about the centre of mass of a body that impulses can move."""
    if shape[collider] != SPHERE_SHAPE and shape[collider] != POINT_SHAPE:
        return False
    body = body_row[collider]
    if body < 0 or inverse_mass[body] == 0.0:
        return False
    return is_centred(collider, body, pose_position, center)
