"""Broad phase: what of the pair cache still holds, and which of its pairs have bounds that overlap now."""

from __future__ import annotations

import numpy as np

# mypy: disable-error-code="no-untyped-def,no-untyped-call"
from carom.systems.constants import AHEAD, FAT, MOST_AHEAD
from carom.systems.kernels.bodies import length_of
from carom.systems.kernels.crew import part_of, shared, wait_for_all
from carom.systems.kernels.frames import turned
from carom.systems.kernels.kernel import kernel, woven
from carom.systems.kernels.lane_columns import ALL, SMALLEST, in_a_row, load_three
from carom.systems.kernels.lanes import WIDTH, address, which
from carom.systems.shapes.plane import Plane

HALF_SPACE = Plane.number
IS_SENSOR, IS_FLAT, STANDS = 1, 2, 4  # flags that no two of a pair share: sensor, half space, moved by nothing
REBUILD = -1  # what `find_leavers` returns where the whole structure must be built anew
ENDLESS = 1e300  # m; a bound beyond this is taken for infinite


@woven
def meets_half_space(plane, box, size, pose_position, pose_rotation, lower, upper, comes):
    """Tell whether the deepest corner of the bounds of row ``box`` lies in the half space of row ``plane``.

    That ``comes`` as far as told (m). An axis along the surface counts for nothing, also where the bounds have no end
    along it.
    """
    nx, ny, nz = turned(pose_rotation, plane, size[plane, 0], size[plane, 1], size[plane, 2])
    depth = size[plane, 3] + comes
    for k, n in enumerate((nx, ny, nz)):
        corner = lower[box, k] if n > 0.0 else upper[box, k]
        depth -= n * (corner - pose_position[plane, k]) if n != 0.0 else 0.0
    return depth >= 0.0


@kernel("met")
def find_met(rows, layer, mask, met):
    """Write the rows on a layer that others may accept and that accept any, and return their count."""
    count = 0
    for i in rows:
        met[count] = i
        count += 1 if layer[i] != 0 and mask[i] != 0 else 0
    return count


@kernel()
def are_those_met(rows, layer, mask, met):
    """Tell whether ``met`` are the rows that `find_met` writes, in their order."""
    count, same = 0, True
    for i in rows:
        if layer[i] != 0 and mask[i] != 0:
            same &= count < len(met) and met[count] == i
            count += 1
    return same and count == len(met)


@kernel("fat_lower", "fat_upper", "known", "seat", "leavers")
def find_leavers(
    anew, rows, shape, size, bound_half, bound_radius, body_row, inverse_mass, layer, mask, sensor,
    pose_position, pose_rotation, lower, upper, linear, angular, reach, dt, frame,
    fat_lower, fat_upper, known, seat, leavers,
):  # fmt: skip
    """Write the rows that left their fat bounds or whose pairs others may be now, with new fat bounds; count them.

    Returns REBUILD where that is not enough: a half space moved, or a row became one, or bounds have no end. ``anew``
    takes every row for a leaver. Fat bounds reach on the way that a body goes, which it will not leave at once again,
    and around one that turns. They are in a ``frame`` (2, 3) that moves, as its velocity (m/s) and where it is (m) say.
    Two of which nothing can push either are no pair: `known` has one flag for them.
    """
    count = 0
    for n in range(0, len(rows), WIDTH):
        if not anew and stay(
            rows, n, shape, body_row, inverse_mass, layer, mask, sensor, lower, upper, frame,
            fat_lower, fat_upper, known,
        ):  # fmt: skip
            continue
        for i in rows[n : n + WIDTH]:
            b, flat = body_row[i], shape[i] == HALF_SPACE
            flags = flags_of(i, b, flat, inverse_mass, sensor)
            same = is_known(i, b, flags, layer, mask, known)
            ends = not flat and known[i, 3] & IS_FLAT == 0
            least = np.inf
            for k in range(3):
                if flat:
                    same &= pose_position[i, k] == seat[i, k]
                else:
                    low, high = lower[i, k] - frame[1, k], upper[i, k] - frame[1, k]
                    same &= (fat_lower[i, k] <= low) & (high <= fat_upper[i, k])
                    ends &= (fat_lower[i, k] > -ENDLESS) & (fat_upper[i, k] < ENDLESS)
                    ends &= (low > -ENDLESS) & (high < ENDLESS)
                    least = min(least, upper[i, k] - lower[i, k])
            if flat:
                for k in range(4):
                    same &= (pose_rotation[i, k] == seat[i, 3 + k]) & (size[i, k] == seat[i, 7 + k])
            if same and not anew:
                continue
            if not (ends or anew):
                return REBUILD
            diagonal = length_of(i, bound_half)
            turning = dt * length_of(b, angular) * diagonal
            widest = bound_radius[i] + diagonal + turning + (reach[b] if b >= 0 else 0.0)  # as `place_bounds` has it
            for k in range(3):
                margin, way = 0.0, 0.0
                if ends:
                    turns = min(AHEAD * turning, MOST_AHEAD * least, widest - 0.5 * (upper[i, k] - lower[i, k]))
                    margin = 0.5 * FAT * least + max(0.0, turns)
                    way = AHEAD * dt * ((linear[b, k] if b >= 0 else 0.0) - frame[0, k])
                    way = max(-MOST_AHEAD * least, min(way, MOST_AHEAD * least)) if way != 0.0 else 0.0
                fat_lower[i, k] = lower[i, k] - frame[1, k] - margin + min(way, 0.0)
                fat_upper[i, k] = upper[i, k] - frame[1, k] + margin + max(way, 0.0)
                if flat:
                    seat[i, k] = pose_position[i, k]
            if flat:
                for k in range(4):
                    seat[i, 3 + k], seat[i, 7 + k] = pose_rotation[i, k], size[i, k]
            known[i, 0], known[i, 1], known[i, 2], known[i, 3] = b, layer[i], mask[i], flags
            leavers[count] = i
            count += 1
    return count


@woven
def stay(
    rows, n, shape, body_row, inverse_mass, layer, mask, sensor, lower, upper, frame, fat_lower, fat_upper, known
):  # fmt: skip
    """Tell of eight rows from the n-th on, if they are in a row and none a half space, that all are as `known`."""
    if not in_a_row(rows, n):
        return False
    same, i = True, rows[n]
    for k in range(i, i + WIDTH):
        b = body_row[k]
        same &= shape[k] != HALF_SPACE
        same &= is_known(k, b, flags_of(k, b, False, inverse_mass, sensor), layer, mask, known)
    if not same:
        return False
    within = ALL
    low, high = load_three(address(lower), i), load_three(address(upper), i)
    least, most = load_three(address(fat_lower), i), load_three(address(fat_upper), i)
    for k in range(3):
        by = frame[1, k]
        within &= which((low[k] - by) - least[k] + SMALLEST) & which(most[k] - (high[k] - by) + SMALLEST)
    return within == ALL


@woven
def flags_of(i, b, flat, inverse_mass, sensor):
    """Return the flags of a row, which has body b."""
    flags = IS_SENSOR if sensor[i] else STANDS if b < 0 or inverse_mass[b] == 0.0 else 0
    return flags | (IS_FLAT if flat else 0)


@woven
def is_known(i, b, flags, layer, mask, known):
    """Tell whether a row has the body, layer, mask and flags that it had."""
    return (known[i, 0] == b) & (known[i, 1] == layer[i]) & (known[i, 2] == mask[i]) & (known[i, 3] == flags)


@shared("meeting", "counts", "found")
def keep_overlapping(
    crew, pairs, lively, shape, size, body_row, reach, passes, pose_position, pose_rotation, lower, upper,
    meeting, counts, found,
):  # fmt: skip
    """Write the pairs whose bounds overlap now and of which one is lively, in their order.

    Each thread tells in ``meeting`` which of its pairs do, and in ``counts`` how many.
    """
    begin, end = part_of(crew, len(pairs))
    count = 0
    for p in range(begin, end):
        i, j = pairs[p, 0], pairs[p, 1]
        if shape[i] == HALF_SPACE or shape[j] == HALF_SPACE:
            plane, box = (i, j) if shape[i] == HALF_SPACE else (j, i)
            comes = passes + (reach[body_row[plane]] if body_row[plane] >= 0 else 0.0)
            meets = meets_half_space(plane, box, size, pose_position, pose_rotation, lower, upper, comes)
            meets = meets and (lively[i] or lively[j])
        else:  # no branch: which of these bounds overlap is past foreseeing, a wrong guess costs more than the test
            meets = (
                (lower[i, 0] <= upper[j, 0]) & (lower[j, 0] <= upper[i, 0])
                & (lower[i, 1] <= upper[j, 1]) & (lower[j, 1] <= upper[i, 1])
                & (lower[i, 2] <= upper[j, 2]) & (lower[j, 2] <= upper[i, 2]) & (lively[i] | lively[j])
            )  # fmt: skip
        meeting[p] = meets
        count += 1 if meets else 0
    counts[crew[1]] = count
    wait_for_all(crew, 1)
    to = 0
    for part in range(crew[1]):
        to += counts[part]
    for p in range(begin, end):
        if count:  # behind the last that meets there may be no more room
            found[to, 0], found[to, 1] = pairs[p, 0], pairs[p, 1]
        to += 1 if meeting[p] else 0
        count -= 1 if meeting[p] else 0
