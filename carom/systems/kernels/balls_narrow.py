"""Narrow phase of balls and points against balls, points, boxes and half spaces, in closed form."""

from __future__ import annotations

from math import inf

from carom.systems.constants import REACH_KEPT
from carom.systems.kernels.balls import HALF_SPACE, gap_of_ball, gap_of_balls

# mypy: disable-error-code="no-untyped-def"
from carom.systems.kernels.contacts import exact_pair
from carom.systems.kernels.crew import part_of, shared, wait_for_all
from carom.systems.kernels.kernel import woven
from carom.systems.kernels.narrow import BOX_SHAPE, PLANE_SHAPE, is_ball, kind_and_extent
from carom.systems.kernels.offsets import find_offsets
from carom.systems.kernels.recycling import first_of_pair, is_pair
from carom.systems.kernels.shares import find_shares
from carom.systems.kernels.validity import SOUND, fault_of
from carom.systems.kernels.writing import write_point


@shared("start", "count", "feature", "normal", "depth", "point")
def measure_balls(
    crew, which, first, second, reaches, taken, room, shape, size, position, rotation, geometry, hulls, meshes,
    apart, start, count, feature, normal, depth, point,
):  # fmt: skip
    """Measure pairs whose first collider is a ball or point.

    Every function of the narrow phase has this form: pair ``which[k]`` has the collider rows ``first[k]`` and
    ``second[k]``; its points are written where they are nearer than ``reaches[which[k]]``, behind those ``taken`` so
    far, with ``room`` for so many of each pair; ``apart`` is how far (m) from each other those at least are that have
    none, 0 where nobody says, as of balls, which are soon measured again. ``hulls`` and ``meshes`` are those of
    `PackedHulls` and `PackedMeshes`.
    """
    begin, end = part_of(crew, len(which))
    taken += room * begin
    for k in range(begin, end):
        p, i = which[k], first[k]
        gap, nx, ny, nz, x, y, z = contact_of_ball(i, second[k], shape, size, position, rotation)
        write_point(taken, 0, gap, -nx, -ny, -nz, x, y, z, feature, normal, depth, point)
        # No branch: who is near is past foreseeing. What is not counted is written over.
        start[p], count[p] = taken, 0 if gap > reaches[p] else 1
        taken += count[p]


@shared(
    "row_a", "row_b", "normal", "depth", "point", "offset_a", "offset_b", "share", "near", "chosen", "measured", "told",
    "found_a", "found_b", "found_feature", "found_normal", "found_depth", "found_point", "found_by_fcl", "old",
)  # fmt: skip
def find_ball_contacts(
    crew, pairs, reaches, shape, size, position, rotation, body_row, center, body_rotation, inverse_mass,
    handles, row_shift, count, a, b, kind, row_a, row_b, feature, normal, depth, point, by_fcl,
    offset_a, offset_b, share, near, chosen, measured, told,
    found_a, found_b, found_feature, found_normal, found_depth, found_point, found_by_fcl, old,
):  # fmt: skip
    """Find the contacts of pairs that `measure_balls` is for, sorted, as all that measure and collect would.

    Those that the table holds, ``count`` of them, stay until they are farther, by REACH_KEPT. Where they are all that
    is found, and meet as they did (`exact_pair`), only where they are now is written, and into it. Each thread has a
    row of ``told``: how many of its pairs are contacts, how many are of other shapes or unsound, and whether there are
    others than those that the table holds. ``near``, ``chosen`` and ``measured`` are room for each pair.
    """
    _, part, parts = crew
    begin, end = part_of(crew, len(pairs))
    taken = begin
    for p in range(begin, end):
        x, y = pairs[p, 0], pairs[p, 1]
        sense = -1.0 if is_ball(x, shape) else 1.0
        i, o = (x, y) if sense < 0.0 else (y, x)
        if not (is_ball(i, shape) and (is_ball(o, shape) or shape[o] == BOX_SHAPE or shape[o] == PLANE_SHAPE)):
            told[part, 1] += 1
            continue
        gap, nx, ny, nz, px, py, pz = contact_of_ball(i, o, shape, size, position, rotation)
        near[taken], measured[taken, 0] = p, -gap
        measured[taken, 1], measured[taken, 2], measured[taken, 3] = sense * nx, sense * ny, sense * nz
        measured[taken, 4], measured[taken, 5], measured[taken, 6] = px, py, pz
        taken += 0 if gap > REACH_KEPT * reaches[p] else 1
    o, kept, new, faulty = 0, begin, 0, 0
    for m in range(begin, taken):
        p = near[m]
        x, y = pairs[p, 0], pairs[p, 1]
        held = is_pair(o, count, x, y, a, b, handles)
        if not held:  # seldom
            o = first_of_pair(o, count, x, y, a, b, handles, row_shift)
            held = is_pair(o, count, x, y, a, b, handles)
            if not held and -measured[m, 0] > reaches[p]:
                continue
        what, _, _, _, _, _, _ = exact_pair(
            x, y, shape, size, body_row, position, rotation, center, body_rotation, inverse_mass
        )
        new += not (held and feature[o] == 0 and not by_fcl[o] and kind[o] == what)
        fault, _, _ = fault_of(
            measured[m, 1], measured[m, 2], measured[m, 3], measured[m, 0],
            measured[m, 4], measured[m, 5], measured[m, 6], inf, inf,
        )  # fmt: skip
        faulty += fault != SOUND
        near[kept], chosen[kept] = p, m
        kept += 1
        o += 1 if held else 0
    told[part, 0], told[part, 1] = kept - begin, told[part, 1] + faulty
    wait_for_all(crew, 1)
    to, total = 0, 0
    for one in range(parts):
        to, total = to + (told[one, 0] if one < part else 0), total + told[one, 0]
    told[part, 2] = new + (total != count)
    wait_for_all(crew, 2)
    same = True
    for one in range(parts):
        same &= told[one, 2] == 0
        if told[one, 1]:
            return
    for k in range(kept - begin):
        p, m, c = near[begin + k], chosen[begin + k], to + k
        if same:
            old[c] = c
            write_measured(c, p, m, pairs, measured, row_a, row_b, normal, depth, point)
            find_offsets(
                c, c + 1, pairs[p, 0], pairs[p, 1], normal, depth, point, body_row, position, center, offset_a, offset_b
            )
            find_shares(c, c + 1, pairs[p, 0], pairs[p, 1], normal, shape, rotation, share)
        else:
            old[c], found_feature[c], found_by_fcl[c] = -1, 0, False
            write_measured(c, p, m, pairs, measured, found_a, found_b, found_normal, found_depth, found_point)


@woven
def write_measured(c, p, m, pairs, measured, row_a, row_b, normal, depth, point):
    """Write what was measured of pair p as contact c."""
    row_a[c], row_b[c], depth[c] = pairs[p, 0], pairs[p, 1], measured[m, 0]
    normal[c, 0], normal[c, 1], normal[c, 2] = measured[m, 1], measured[m, 2], measured[m, 3]
    point[c, 0], point[c, 1], point[c, 2] = measured[m, 4], measured[m, 5], measured[m, 6]


@woven
def contact_of_ball(i, o, shape, size, position, rotation):
    """Return (gap, normal to i, point) of a ball or point i and another, a box or a half space, o."""
    radius, x, y, z = size[i, 0], position[i, 0], position[i, 1], position[i, 2]
    ox, oy, oz = position[o, 0], position[o, 1], position[o, 2]
    if is_ball(o, shape):  # most often: how it is turned need not be read
        gap, nx, ny, nz = gap_of_balls(x - ox, y - oy, z - oz, radius + size[o, 0])
    else:
        kind, ex, ey, ez = kind_and_extent(
            shape[o], size[o, 0], size[o, 1], size[o, 2],
            rotation[o, 0], rotation[o, 1], rotation[o, 2], rotation[o, 3],
        )  # fmt: skip
        if kind == HALF_SPACE:
            ox, oy, oz = ox + size[o, 3] * ex, oy + size[o, 3] * ey, oz + size[o, 3] * ez
        gap, nx, ny, nz = gap_of_ball(
            kind, x, y, z, radius, ox, oy, oz,
            rotation[o, 0], rotation[o, 1], rotation[o, 2], rotation[o, 3], ex, ey, ez,
        )  # fmt: skip
    lever = radius + 0.5 * gap
    return gap, nx, ny, nz, x - lever * nx, y - lever * ny, z - lever * nz
