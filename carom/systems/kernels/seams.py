"""Seams: boxes laid side by side are one surface, and what glides over it does not strike the side of the next one."""

from __future__ import annotations

import numpy as np

# mypy: disable-error-code="no-untyped-def"
from carom.systems.constants import FLUSH, LEANING
from carom.systems.kernels.frames import turned_back
from carom.systems.kernels.kernel import inlined, kernel, woven
from carom.systems.kernels.narrow import BOX_SHAPE, POINT_SHAPE, SPHERE_SHAPE


@kernel("rolls", "glides", "lies", makes_arrays=True)
def may_hide(rows, shape, body_row, rolls, glides, lies):
    """Say which colliders (rows) are balls that are bodies of their own, which glide, and on which boxes those may.

    Return whether boxes may hide contacts from others.
    """
    compound = np.zeros(len(shape), np.bool_)
    for i in rows:
        if body_row[i] >= 0 and body_row[i] != i:
            compound[body_row[i]] = True
    gliding = lying = 0
    for i in rows:
        ball = shape[i] == SPHERE_SHAPE or shape[i] == POINT_SHAPE
        rolls[i] = body_row[i] >= 0 and ball and not compound[body_row[i]]
        glides[i] = body_row[i] >= 0 and not rolls[i]
        lies[i] = shape[i] == BOX_SHAPE and (body_row[i] < 0 or compound[body_row[i]])
        lying += lies[i]
        gliding += glides[i] or (lies[i] and body_row[i] >= 0)
    return gliding > 0 and lying > 1


@kernel("hidden", makes_arrays=True)
def hide_at_seams(
    row_a, row_b, normal, depth, point, rolls, glides, lies,
    size, bound_half, bound_radius, position, rotation, body_row, hidden,
):  # fmt: skip
    """Say which contacts are ``hidden`` by another box, and return how many they are.

    A box hides those of another that is a part of the same body, or stands still as it does, where what meets both has
    the other wholly behind the plane in which it meets the first, and would touch it only where the two adjoin: it
    cannot get there but through the first. To FLUSH of its longest half extent, by which what lies on the first may
    have sunk in. A ball that is a body of its own has exact contacts with boxes that stand or are bodies of their own,
    which know the edges it passes (`is_borne_beside`).
    """
    count, rows = len(row_a), len(lies)

    # The manifolds that what glides has with boxes that may hide each other, as slices of one array.
    beginning, pairs = np.empty(count, np.int64), 0
    first = np.zeros(rows + 1, np.int64)
    for c in range(count):
        hidden[c] = False
        a, b = row_a[c], row_b[c]
        if not (lies[a] or lies[b]) or (c > 0 and a == row_a[c - 1] and b == row_b[c - 1]):
            continue
        beginning[pairs] = c
        pairs += 1
        first[a + 1] += is_over(a, b, glides, rolls, lies, body_row)
        first[b + 1] += is_over(b, a, glides, rolls, lies, body_row)
    for i in range(rows):
        first[i + 1] += first[i]
    met, place = np.empty(first[rows], np.int64), first[:rows].copy()
    for m in range(pairs):
        c = beginning[m]
        a, b = row_a[c], row_b[c]
        if is_over(a, b, glides, rolls, lies, body_row):
            met[place[a]] = c
            place[a] += 1
        if is_over(b, a, glides, rolls, lies, body_row):
            met[place[b]] = c
            place[b] += 1

    number = 0
    for one in range(rows):
        for i in range(first[one], first[one + 1]):
            c = met[i]
            a, b = row_a[c], row_b[c]
            other = b if one == a else a
            for j in range(first[one], first[one + 1]):
                k = met[j]
                by = row_b[k] if one == row_a[k] else row_a[k]
                if j == i or hidden[k] or body_row[by] != body_row[other]:
                    continue
                flush = FLUSH * (bound_radius[one] + max(bound_half[one, 0], bound_half[one, 1], bound_half[one, 2]))
                if not is_behind(one, other, k, by, c, flush, row_a, normal, depth, point, size, position, rotation):
                    continue
                end, adjoin = c, True
                while end < count and row_a[end] == a and row_b[end] == b:
                    adjoin = adjoin and is_on(
                        one, end, by, flush, row_a, normal, depth, point, size, position, rotation
                    )
                    end += 1
                if adjoin:
                    hidden[c:end] = True
                    number += end - c
                    break
    return number


@woven
def is_over(one, box, glides, rolls, lies, body_row):
    """Tell whether a collider glides over a box, or is a ball that rolls over one that is a part of a body."""
    return lies[box] and (glides[one] or (rolls[one] and body_row[box] >= 0))


@inlined
def is_behind(one, other, k, by, c, flush, row_a, normal, depth, point, size, position, rotation):
    """Tell whether a box lies behind the plane of contact k with another, and would be met from elsewhere (c)."""
    sense = -1.0 if row_a[k] == one else 1.0
    turn = -1.0 if row_a[c] == one else 1.0
    x, y, z = sense * normal[k, 0], sense * normal[k, 1], sense * normal[k, 2]
    dx, dy, dz = turn * normal[c, 0] - x, turn * normal[c, 1] - y, turn * normal[c, 2] - z
    if dx * dx + dy * dy + dz * dz <= LEANING * LEANING:
        return False
    level = x * point[k, 0] + y * point[k, 1] + z * point[k, 2] + 0.5 * depth[k]
    level -= x * position[other, 0] + y * position[other, 1] + z * position[other, 2]
    x, y, z = turned_back(rotation, other, x, y, z)
    reach = 0.5 * (abs(x) * size[other, 0] + abs(y) * size[other, 1] + abs(z) * size[other, 2])
    return reach <= level + flush


@inlined
def is_on(one, c, by, flush, row_a, normal, depth, point, size, position, rotation):
    """Tell whether the place where contact c would be on its box is on another box, too."""
    half = (-0.5 if row_a[c] == one else 0.5) * depth[c]
    x, y, z = turned_back(
        rotation, by,
        point[c, 0] + half * normal[c, 0] - position[by, 0],
        point[c, 1] + half * normal[c, 1] - position[by, 1],
        point[c, 2] + half * normal[c, 2] - position[by, 2],
    )  # fmt: skip
    return max(abs(x) - 0.5 * size[by, 0], abs(y) - 0.5 * size[by, 1], abs(z) - 0.5 * size[by, 2]) <= flush
