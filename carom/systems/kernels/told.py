"""Told: where the contacts in the table are on fast bodies, which take them along as they move and turn."""

from __future__ import annotations

# mypy: disable-error-code="no-untyped-def"
from carom.systems.kernels import groups as of
from carom.systems.kernels.blow_points import is_smooth, round_of
from carom.systems.kernels.fast_pairs import first_of_pairs, is_of_pair
from carom.systems.kernels.frames import put_on
from carom.systems.kernels.groups import ABSENT, MANIFOLD_ROWS, POINT_ROWS
from carom.systems.kernels.kernel import inlined, kernel
from carom.systems.kernels.spatial import spun, turn


@kernel("spans", "around", "places")
def write_told(
    pairs, count, kind, row_a, row_b, body_a, body_b, normal, depth, point, bound_radius, center, rotation,
    spans, around, places,
):  # fmt: skip
    """Write where the ``count`` contacts in the table are on the cores of both bodies, and which are of which pair.

    ``spans`` (n, 2) are the first contact of each of the ``pairs`` and the one behind its last. Places (count, 2, 3)
    are in the frames of bodies about their centres, of what stands in the world. What is ``around`` both cores (m) does
    not turn. Of balls on exact arcs nothing is told.
    """
    p = 0
    for q in range(len(pairs)):
        spans[q, 0], spans[q, 1] = 0, 0
    for c in range(count):
        p = first_of_pairs(p, pairs, row_a[c], row_b[c])
        if kind[c] >= 0 or not is_of_pair(p, pairs, row_a[c], row_b[c]):
            continue
        if spans[p, 1] == 0:
            spans[p, 0] = c
        spans[p, 1] = c + 1
        around[c] = bound_radius[row_a[c]] + bound_radius[row_b[c]]
        for side, i, row in ((0, body_a[c], row_a[c]), (1, body_b[c], row_b[c])):
            on = (1.0 - 2.0 * side) * (0.5 * depth[c] - bound_radius[row])
            x, y, z = normal[c, 0], normal[c, 1], normal[c, 2]
            x, y, z = point[c, 0] + on * x, point[c, 1] + on * y, point[c, 2] + on * z
            put_on(c, side, i, x, y, z, center, rotation, places)


@inlined
def place_told(c, side, i, time, places, center, rotation, linear, angular):
    """Return where contact c is on the core of body i, or of what stands, ``time`` seconds on as that moves now."""
    x, y, z = places[c, side, 0], places[c, side, 1], places[c, side, 2]
    if i >= 0:
        qx, qy, qz, qw = rotation[i, 0], rotation[i, 1], rotation[i, 2], rotation[i, 3]
        qx, qy, qz, qw = spun(qx, qy, qz, qw, angular[i, 0], angular[i, 1], angular[i, 2], time)
        x, y, z = turn(qx, qy, qz, qw, x, y, z)
        x, y, z = x + center[i, 0], y + center[i, 1], z + center[i, 2]
        x, y, z = x + time * linear[i, 0], y + time * linear[i, 1], z + time * linear[i, 2]
    return x, y, z


@inlined
def gap_told(c, time, body_a, body_b, normal, around, places, center, rotation, linear, angular):
    """Return how far apart (m) both bodies are at contact c ``time`` seconds on as they move now."""
    ax, ay, az = place_told(c, 0, body_a[c], time, places, center, rotation, linear, angular)
    bx, by, bz = place_told(c, 1, body_b[c], time, places, center, rotation, linear, angular)
    return normal[c, 0] * (bx - ax) + normal[c, 1] * (by - ay) + normal[c, 2] * (bz - az) - around[c]


@inlined
def renew_told(
    count, start, group_of, lane_of, row, stale, row_a, row_b, shape, bound_radius, body_a, body_b, normal,
    spans, around, places, trust, tells, center, rotation, linear, angular, depth, offset_a, offset_b, resting, lanes,
):  # fmt: skip
    """Write how deep the contacts of pairs are that tell where these meet, and where on round surfaces; let them go.

    ``start`` are the first contacts of the ``count`` manifolds. What is not round takes its contacts along anyway.
    Nobody rests on them who may turn onto another; their groups are ``stale``.
    """
    p = 0
    for m in range(count):
        while p < len(spans) and spans[p, 1] <= start[m]:
            p += 1
        if p == len(spans) or not tells[p] or start[m] < spans[p, 0]:
            continue
        g, lane = group_of[m], lane_of[m]
        stale[g] |= resting[start[m]]
        for c in range(start[m], start[m + 1]):
            gap = gap_told(c, 0.0, body_a, body_b, normal, around, places, center, rotation, linear, angular)
            if depth[c] == ABSENT and gap > trust[p]:
                continue
            depth[c] = -gap
            lanes[row[g] + MANIFOLD_ROWS + POINT_ROWS * (c - start[m]) + of.DEPTH, lane] = depth[c]
            resting[c] = False
            for i, collider, outward, side, offset in (
                (body_a[c], row_a[c], 1.0, 0, offset_a), (body_b[c], row_b[c], -1.0, 1, offset_b),
            ):  # fmt: skip
                if i >= 0 and is_smooth(collider, shape):
                    x, y, z = place_told(c, side, i, 0.0, places, center, rotation, linear, angular)
                    rx, ry, rz = round_of(c, collider, outward, normal, bound_radius)
                    offset[c, 0], offset[c, 1] = x - center[i, 0] + rx, y - center[i, 1] + ry
                    offset[c, 2] = z - center[i, 2] + rz


@inlined
def let_astray_go(
    count, start, group_of, lane_of, row, body_a, body_b, normal, spans, around, places, trust, strays, near,
    center, rotation, linear, angular, depth, resting, lanes,
):  # fmt: skip
    """Let contacts go that are not trusted, of pairs that stray: followed straight on they would be met by chance.

    Those are farther than the ``trust`` (m), and all of who was not ``near`` when they were found.
    """
    p = 0
    for m in range(count):
        while p < len(spans) and spans[p, 1] <= start[m]:
            p += 1
        if p == len(spans) or not strays[p] or start[m] < spans[p, 0] or resting[start[m]]:
            continue
        for c in range(start[m], start[m + 1]):
            gap = gap_told(c, 0.0, body_a, body_b, normal, around, places, center, rotation, linear, angular)
            if gap > trust[p] or not near[p]:
                depth[c] = ABSENT
                lanes[row[group_of[m]] + MANIFOLD_ROWS + POINT_ROWS * (c - start[m]) + of.DEPTH, lane_of[m]] = ABSENT


@kernel("depth")
def tell_let_go(spans, body_a, body_b, normal, around, places, center, rotation, still, depth):
    """Write how far apart bodies are where contacts of pairs that are looked after were let go; all are ``still``."""
    for p in range(len(spans)):
        for c in range(spans[p, 0], spans[p, 1]):
            if depth[c] == ABSENT:
                depth[c] = -gap_told(c, 0.0, body_a, body_b, normal, around, places, center, rotation, still, still)
