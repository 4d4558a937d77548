"""Footprints: the points at which two cores meet, from what each turns to the other."""

from __future__ import annotations

# mypy: disable-error-code="no-untyped-def"
from carom.systems.constants import BIAS, FLAT_COSINE
from carom.systems.kernels.cores import AROUND, CORE, CYLINDER, EXTENT, HALF_SPACE, KIND
from carom.systems.kernels.kernel import inlined
from carom.systems.kernels.outlines import outline
from carom.systems.kernels.overlays import beside_line, over_face
from carom.systems.kernels.polytope import NONE


@inlined
def points_between(
    core, place, hulls, gap, nx, ny, nz, px, py, pz, reach,
    one, one_tag, one_plane, two, two_tag, two_plane, spot, gaps, names,
):  # fmt: skip
    """Write the points of the first core that are nearer than ``reach`` to the second along n; return how many.

    A face turned to the normal has what the other turns to it clipped by its sides, a half space all of it, and lines
    and edges side by side have two points. All others have one, the point x; it is added where rounding has cut away
    the deepest, and where round sides lie across each other between their ends.
    """
    corners, others, cosine, other_cosine = NONE, NONE, 0.0, 0.0
    half_space = core[CORE + KIND] == HALF_SPACE
    for side in range(1 if half_space else 2):
        polygon, tag, plane = (one, one_tag, one_plane) if side == 0 else (two, two_tag, two_plane)
        sense = 1.0 - 2.0 * side
        count, turned = outline(
            core, side * CORE, place, hulls, sense * nx, sense * ny, sense * nz, polygon, tag, plane
        )
        if side == 0:
            corners, cosine = count, turned
        else:
            others, other_cosine = count, turned
    flat = corners > 2 and cosine >= FLAT_COSINE
    other_flat = others > 2 and other_cosine >= FLAT_COSINE
    found, lines, round_one, round_other = 0, False, 0.0, 0.0
    if half_space:
        found = over_half_space(gap, nx, ny, nz, px, py, pz, reach, one, one_tag, corners, spot, gaps, names)
    elif (flat and others > 1) or (other_flat and corners > 1):
        on_first = flat and others > 1 and (not other_flat or cosine >= other_cosine - BIAS)
        face, face_tag, sides, plane = (
            (one, one_tag, corners, one_plane) if on_first else (two, two_tag, others, two_plane)
        )
        polygon, tag, count = (two, two_tag, others) if on_first else (one, one_tag, corners)
        found = over_face(
            face, face_tag, sides, plane, polygon, tag, count, on_first, gap, nx, ny, nz, reach, spot, gaps, names
        )
    elif corners > 1 and others > 1:
        keep_foremost_edge(one, corners, nx, ny, nz)
        keep_foremost_edge(two, others, -nx, -ny, -nz)
        lines = True
        round_one, round_other = radius_of(core, 0, corners), radius_of(core, CORE, others)
        found = beside_line(one, two, round_one, round_other, gap, nx, ny, nz, reach, spot, gaps, names)
    least = 1e300
    for c in range(found):
        least = min(least, gaps[c])
    if least > gap + 2.0 * BIAS:
        if lines and round_one + round_other == 0.0:
            found = 0  # sharp ones that cross touch at one point
        gaps[found], names[found] = gap, 0
        spot[3 * found], spot[3 * found + 1], spot[3 * found + 2] = px, py, pz
        return found + 1
    for c in range(found):
        gaps[c] -= least - gap  # rounding: the deepest is as deep as the pair
    return found


@inlined
def radius_of(core, at, count):
    """Return how round a core is across the line it turns to another; an edge is sharp, and a cone is at its apex."""
    if count > 2:
        return 0.0
    return core[at + EXTENT] if core[at + KIND] == CYLINDER else core[at + AROUND]


@inlined
def keep_foremost_edge(polygon, count, x, y, z):
    """Move the edge of an outline that is foremost along a direction to its front; a line is its own edge."""
    best, most = 0, -1e300
    for k in range(count if count > 2 else 0):
        i, j = 3 * k, 3 * (k + 1 if k + 1 < count else 0)
        here, there = (
            x * polygon[i] + y * polygon[i + 1] + z * polygon[i + 2],
            x * polygon[j] + y * polygon[j + 1] + z * polygon[j + 2],
        )
        if min(here, there) > most + BIAS:
            best, most = k, min(here, there)
    if best > 0:
        i, j = 3 * best, 3 * (best + 1 if best + 1 < count else 0)
        ax, ay, az, bx, by, bz = (
            polygon[i], polygon[i + 1], polygon[i + 2], polygon[j], polygon[j + 1], polygon[j + 2],
        )  # fmt: skip
        polygon[0], polygon[1], polygon[2], polygon[3], polygon[4], polygon[5] = ax, ay, az, bx, by, bz


@inlined
def over_half_space(gap, nx, ny, nz, px, py, pz, reach, polygon, tag, count, spot, gaps, names):
    """Write the points of an outline that are nearer than ``reach`` to a half space; x is as far as ``gap`` from it."""
    found = 0
    for c in range(count):
        x, y, z = polygon[3 * c], polygon[3 * c + 1], polygon[3 * c + 2]
        apart = gap + nx * (px - x) + ny * (py - y) + nz * (pz - z)
        if apart <= reach:
            gaps[found], names[found] = apart, 1 + tag[c]
            spot[3 * found], spot[3 * found + 1], spot[3 * found + 2] = x, y, z
            found += 1
    return found
