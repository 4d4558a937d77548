"""FCL's answers, refined: its normal is where the search for the exact one begins, its point grows into a manifold."""

from __future__ import annotations

import numpy as np

# mypy: disable-error-code="no-untyped-def"
from carom.systems.kernels.cores import AROUND, CORE, PLACE, write_core, write_place
from carom.systems.kernels.footprints import points_between
from carom.systems.kernels.frames import turned
from carom.systems.kernels.hulls_narrow import most_of
from carom.systems.kernels.kernel import kernel
from carom.systems.kernels.low_points import reduce_round
from carom.systems.kernels.nearing import MOST_STEPS
from carom.systems.kernels.parting_cores import part
from carom.systems.kernels.polytope import MOST_CORNERS, MOST_FACES
from carom.systems.kernels.writing import write_points
from carom.systems.shapes.rim import RIM_POINTS


@kernel("start", "count", "feature", "normal", "depth", "point", makes_arrays=True)
def refine_answers(
    which, first, second, overlaps, hints, pairs, reaches, taken, shape, size, position, rotation, geometry, hulls,
    start, count, feature, normal, depth, point,
):  # fmt: skip
    """Write the contacts of pairs that FCL has answered; return how many points are taken now.

    Pair ``which[k]`` is measured from collider ``first[k]`` to ``second[k]``; a half space is second. ``overlaps[k]``
    is whether FCL sees them overlap, and ``hints[k]`` its normal in the frame of the first.
    """
    core, place = np.empty(2 * CORE), np.empty(PLACE)
    corner, face = np.empty(6 * MOST_CORNERS), np.empty(3 * MOST_FACES, np.int64)
    plane, rim = np.empty(4 * MOST_FACES), np.empty(2 * 3 * MOST_FACES, np.int64)
    name, weight, seen = np.empty(8, np.int64), np.empty(4), np.empty(3 * MOST_STEPS)
    room = 2 * max(most_of(hulls.loop_start), RIM_POINTS) + 8
    one, one_tag, one_plane = np.empty(6 * room), np.empty(2 * room, np.int64), np.zeros(4)
    two, two_tag, two_plane = np.empty(6 * room), np.empty(2 * room, np.int64), np.zeros(4)
    spot, gaps, names = np.empty(3 * room), np.empty(room), np.empty(room, np.int64)
    for k in range(len(which)):
        p, a, b = which[k], first[k], second[k]
        start[p] = taken
        for side in range(2):
            write_core(shape, size, geometry, a if side == 0 else b, hulls, core, side * CORE)
        write_place(position, rotation, a, b, place)
        radius, other = core[AROUND], core[CORE + AROUND]
        reach = reaches[p] + radius + other
        gap, nx, ny, nz, px, py, pz = part(
            core, place, hulls.vertices, overlaps[k], hints[k, 0], hints[k, 1], hints[k, 2], reach,
            corner, face, plane, rim, name, weight, seen,
        )  # fmt: skip
        if gap > reach:
            continue
        found = points_between(
            core, place, hulls, gap, nx, ny, nz, px, py, pz, reach,
            one, one_tag, one_plane, two, two_tag, two_plane, spot, gaps, names,
        )  # fmt: skip
        found = reduce_round(spot, gaps, names, found, nx, ny, nz)
        if found == 1:
            names[0] = 0  # a lone point is the pair itself, however the bodies roll
        for c in range(found):
            spot[3 * c], spot[3 * c + 1], spot[3 * c + 2] = turned(
                rotation, a, spot[3 * c], spot[3 * c + 1], spot[3 * c + 2]
            )
        nx, ny, nz = turned(rotation, a, nx, ny, nz)
        count[p] = found
        taken = write_points(
            spot, gaps, names, found, position[a, 0], position[a, 1], position[a, 2], nx, ny, nz,
            1.0 if a == pairs[p, 0] else -1.0, radius, other, taken, feature, normal, depth, point,
        )  # fmt: skip
    return taken
