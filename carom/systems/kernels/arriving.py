"""Arriving: points of fast pairs that were too far to be contacts when these were sought, and touch in a substep."""

from __future__ import annotations

from math import sqrt

# mypy: disable-error-code="no-untyped-def"
from carom.systems.constants import AS_LOW, FAST, ROLLED_ON, TRUST
from carom.systems.kernels.cores import (
    AROUND,
    CONE,
    CORE,
    CYLINDER,
    EXTENT,
    HALF_SPACE,
    KIND,
    SEGMENT,
    farthest,
    most_overlap,
    write_place,
)
from carom.systems.kernels.frames import placed, put_both, turned, turned_back
from carom.systems.kernels.kernel import inlined
from carom.systems.kernels.parting_cores import part_from_half_space
from carom.systems.kernels.spatial import turn
from carom.systems.kernels.swinging import REACH, TRUSTED


@inlined
def sought_to(p, i, o, numbers, reach):
    """Return how far (m) contacts of pair p were sought: both bodies' ``reach``, or how far the fast come at least."""
    together = (reach[i] if i >= 0 else 0.0) + (reach[o] if o >= 0 else 0.0)
    return max(together, FAST / TRUST * numbers[p, TRUSTED])


@inlined
def came_since(
    p, i, o, numbers, core, center, turns, detected_center, detected_turns, local_position, local_rotation
):  # fmt: skip
    """Return how far (m) any two points of pair p may have come nearer since bodies were where they were detected."""
    squared, by_turning = 0.0, 0.0
    for k in range(3):
        way = (center[i, k] - detected_center[i, k]) if i >= 0 else 0.0
        way -= (center[o, k] - detected_center[o, k]) if o >= 0 else 0.0
        squared += way * way
    for side in range(2):
        body = i if side == 0 else o
        if body >= 0:
            by_turning += swung_since(
                p, side, body, numbers, core, turns, detected_turns, local_position, local_rotation
            )  # fmt: skip
    return sqrt(squared) + by_turning


@inlined
def swung_since(p, side, i, numbers, core, turns, detected_turns, local_position, local_rotation):
    """Return how far (m) one of pair p has moved at most as body i has turned since it was detected."""
    x, y, z = local_position[p, side, 0], local_position[p, side, 1], local_position[p, side, 2]
    own, around = numbers[p, REACH + side] - sqrt(x * x + y * y + z * z), 0.0
    if x != 0.0 or y != 0.0 or z != 0.0:
        around = apart_by_turning(i, x, y, z, turns, detected_turns)
    kind = core[side * CORE + KIND]
    if kind in (SEGMENT, CYLINDER, CONE):  # their axes move, what turns about these does not
        x, y, z = turn(
            local_rotation[p, side, 0], local_rotation[p, side, 1], local_rotation[p, side, 2],
            local_rotation[p, side, 3], 0.0, 1.0, 0.0,
        )  # fmt: skip
        return around + own * apart_by_turning(i, x, y, z, turns, detected_turns)
    cosine = 0.0  # of half the angle
    for k in range(4):
        cosine += turns[i, k] * detected_turns[i, k]
    return around + 2.0 * sqrt(max(0.0, 1.0 - cosine * cosine)) * own


@inlined
def apart_by_turning(i, x, y, z, turns, detected_turns):
    """Return how far a place in the frame of body i has come since as that turned."""
    ax, ay, az = turned(turns, i, x, y, z)
    bx, by, bz = turned(detected_turns, i, x, y, z)
    return sqrt((ax - bx) ** 2 + (ay - by) ** 2 + (az - bz) ** 2)


@inlined
def somebody_arrives(
    p, i, o, limit, nx, ny, nz, sought, rolls, core, vertices, center, turns, linear, angular,
    detected_center, detected_turns, local_position, local_rotation, position, rotation, place,
):  # fmt: skip
    """Tell whether points of pair p touch within ``limit`` (s) that were farther apart than contacts were sought.

    ``sought`` (m) is along n (world), where bodies were detected; what is still as far now is not meant. So do points
    of a rim that ``rolls`` and leans, far from where that was lowest then.
    """
    around = core[AROUND] + core[CORE + AROUND]
    put_both(i, o, limit, center, turns, linear, angular, local_position, local_rotation, p, position, rotation)
    write_place(position, rotation, 0, 1, place)
    if core[CORE + KIND] == HALF_SPACE:
        gap, mx, my, mz, ax, ay, az = part_from_half_space(core, place, vertices)
        bx, by, bz = ax + gap * mx, ay + gap * my, az + gap * mz
    else:
        mx, my, mz = turned_back(rotation, 0, nx, ny, nz)
        bx, by, bz, ax, ay, az = most_overlap(core, place, vertices, mx, my, mz)
        gap = -(mx * bx + my * by + mz * bz)
        bx, by, bz = ax - bx, ay - by, az - bz
    if gap > around:
        return False
    for side in range(2):
        if rolls and is_round(core, side) and has_rolled(
            side, p, i, o, limit, nx, ny, nz, core, vertices, center, turns, linear, angular,
            detected_center, detected_turns, local_position, local_rotation, position, rotation,
        ):  # fmt: skip
            return True
    x, y, z = placed(position, rotation, 0, bx, by, bz)
    bx, by, bz = turned_back(rotation, 1, x - position[1, 0], y - position[1, 1], z - position[1, 2])
    put_both(i, o, 0.0, center, turns, linear, angular, local_position, local_rotation, p, position, rotation)
    if apart_along(nx, ny, nz, position, rotation, ax, ay, az, bx, by, bz) - around > sought:
        return False
    put_both(
        i, o, 0.0, detected_center, detected_turns, linear, angular,
        local_position, local_rotation, p, position, rotation,
    )  # fmt: skip
    return apart_along(nx, ny, nz, position, rotation, ax, ay, az, bx, by, bz) - around > sought


@inlined
def is_round(core, side):
    """Tell whether a core is such as may touch with any point of a rim."""
    return core[side * CORE + KIND] == CYLINDER or core[side * CORE + KIND] == CONE


@inlined
def has_rolled(
    side, p, i, o, limit, nx, ny, nz, core, vertices, center, turns, linear, angular,
    detected_center, detected_turns, local_position, local_rotation, position, rotation,
):  # fmt: skip
    """Tell whether a rim leans by ``limit`` (s), far from where it was lowest along n when bodies were detected.

    Both shapes are where they are by then, and are left there.
    """
    body = i if side == 0 else o
    if body < 0:
        return False
    x, y, z = outermost(side, nx, ny, nz, core, vertices, position, rotation)
    ux, uy, uz = turned(rotation, side, 0.0, 1.0, 0.0)
    upright = nx * ux + ny * uy + nz * uz
    put_both(
        i, o, 0.0, detected_center, detected_turns, linear, angular,
        local_position, local_rotation, p, position, rotation,
    )  # fmt: skip
    tx, ty, tz = outermost(side, nx, ny, nz, core, vertices, position, rotation)
    put_both(i, o, limit, center, turns, linear, angular, local_position, local_rotation, p, position, rotation)
    x -= tx + center[body, 0] + limit * linear[body, 0] - detected_center[body, 0]
    y -= ty + center[body, 1] + limit * linear[body, 1] - detected_center[body, 1]
    z -= tz + center[body, 2] + limit * linear[body, 2] - detected_center[body, 2]
    along = nx * x + ny * y + nz * z
    squared, farthest_on = x * x + y * y + z * z - along * along, ROLLED_ON * core[side * CORE + EXTENT]
    return squared > farthest_on * farthest_on and (1.0 - upright * upright) * squared > AS_LOW * AS_LOW


@inlined
def outermost(side, nx, ny, nz, core, vertices, position, rotation):
    """Return the point (world) of a core that is farthest along n, which leads from the first to the second."""
    sense = 1.0 - 2.0 * side
    x, y, z = turned_back(rotation, side, sense * nx, sense * ny, sense * nz)
    x, y, z = farthest(core, side * CORE, vertices, x, y, z)
    return placed(position, rotation, side, x, y, z)


@inlined
def apart_along(nx, ny, nz, position, rotation, ax, ay, az, bx, by, bz):
    """Return how far (m) point b of the second is from point a of the first along n, each given in its own frame."""
    x, y, z = placed(position, rotation, 0, ax, ay, az)
    ux, uy, uz = placed(position, rotation, 1, bx, by, bz)
    return nx * (ux - x) + ny * (uy - y) + nz * (uz - z)
