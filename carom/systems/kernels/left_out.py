"""Left out: contacts of fast pairs that were too far to be trusted; who comes near one is to be detected anew."""

from __future__ import annotations

# mypy: disable-error-code="no-untyped-def"
from carom.systems.constants import MEET
from carom.systems.kernels.fast_pairs import NEVER, first_of_pairs
from carom.systems.kernels.frames import put_on
from carom.systems.kernels.kernel import inlined, kernel
from carom.systems.kernels.spatial import cross, turn
from carom.systems.kernels.swinging import TRUSTED


@kernel("bodies", "normals", "gaps", "nears", "places")
def write_left_out(
    pairs, numbers, far, row_a, row_b, normal, depth, point, body_row, center, rotation,
    bodies, normals, gaps, nears, places,
):  # fmt: skip
    """Write the contacts that are ``far``: their bodies, their gaps, which gaps are near (m), and their places on both.

    Places are in the frames of bodies about their centres, of what stands in the world.
    """
    p, n = 0, 0
    for c in range(len(row_a)):
        if not far[c]:
            continue
        p = first_of_pairs(p, pairs, row_a[c], row_b[c])
        gaps[n], nears[n] = -depth[c], MEET * numbers[p, TRUSTED]
        for side in range(2):
            i = bodies[n, side] = body_row[row_a[c] if side == 0 else row_b[c]]
            put_on(n, side, i, point[c, 0], point[c, 1], point[c, 2], center, rotation, places)
        for k in range(3):
            normals[n, k] = normal[c, k]
        n += 1


@inlined
def when_near(span, bodies, normals, gaps, nears, places, center, rotation, linear, angular):
    """Return when (s) the first of the contacts left out is near, as all move now; NEVER if not in ``span``.

    That is well within what is near, so that it is known there. Places go with bodies as these turn, normals stay.
    """
    soonest = NEVER
    for n in range(len(bodies)):
        gap, closing = gaps[n], 0.0
        for side in range(2):
            i, sense = bodies[n, side], 1.0 - 2.0 * side
            x, y, z = places[n, side, 0], places[n, side, 1], places[n, side, 2]
            vx, vy, vz = 0.0, 0.0, 0.0
            if i >= 0:
                x, y, z = turn(rotation[i, 0], rotation[i, 1], rotation[i, 2], rotation[i, 3], x, y, z)
                vx, vy, vz = cross(angular[i, 0], angular[i, 1], angular[i, 2], x, y, z)
                vx, vy, vz = vx + linear[i, 0], vy + linear[i, 1], vz + linear[i, 2]
                x, y, z = x + center[i, 0], y + center[i, 1], z + center[i, 2]
            gap -= sense * (normals[n, 0] * x + normals[n, 1] * y + normals[n, 2] * z)
            closing += sense * (normals[n, 0] * vx + normals[n, 1] * vy + normals[n, 2] * vz)
        way = gap - 0.5 * nears[n] if gap > nears[n] else 0.0
        if closing > 0.0 and way < closing * span:
            soonest = min(soonest, way / closing)
    return soonest
