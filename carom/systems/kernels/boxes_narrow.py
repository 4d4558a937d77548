"""Narrow phase of two boxes: the axis that parts them most, then the points of the faces or edges it names."""

from __future__ import annotations

import numpy as np

# mypy: disable-error-code="no-untyped-def"
from carom.systems.constants import BIAS, FACE_CONE, LEAST_PART
from carom.systems.kernels.edges import EDGE_FEATURES, along_other, crossing_edges, edge_normal, nearest_corner
from carom.systems.kernels.faces import FEATURES, MOST_OVER, points_over
from carom.systems.kernels.frames import placed, turned
from carom.systems.kernels.kernel import inlined, kernel
from carom.systems.kernels.parting import EDGES, FACES, LANES, OWN, PLACE, ROWS, TURN, VIEW, after, part, put_in
from carom.systems.kernels.reduction import reduce_area
from carom.systems.kernels.writing import write_point

EDGES_FROM = 12 * FEATURES  # features: of 6 faces of either box, then of pairs of edges, then of corners
CORNERS_FROM = EDGES_FROM + EDGE_FEATURES


@kernel("start", "count", "feature", "normal", "depth", "point")
def measure_boxes(
    which, first, second, reaches, taken, shape, size, position, rotation, geometry, hulls, meshes,
    start, count, feature, normal, depth, point,
):  # fmt: skip
    """Measure pairs of boxes; return how many points are taken now (`measure_balls` says what the arguments are).

    The depth is that of the least way out, however deep or concentric the pose: the 15 axes are all there are
    (Gottschalk, Collision Queries using Oriented Bounding Boxes, 2000, section 3.3). A gap is that of the nearest
    points, along the line between them. A face within FACE_CONE of the way out gives up to four points, that of the
    box with the longer diagonal if both do; edges and corners give one. Since that box also goes first in the
    arithmetic, swapping boxes of different size turns normals and changes no other bit.
    """
    view, way, place = np.zeros((ROWS, LANES)), np.empty(3), np.empty(3)
    over, height, over_feature = np.empty(3 * MOST_OVER), np.empty(MOST_OVER), np.empty(MOST_OVER, np.int64)
    for k in range(len(which)):
        lane = k % LANES
        if lane == 0:
            for n in range(k, min(k + LANES, len(which))):
                i, o, _ = longer_first(size, first[n], second[n])
                put_in(view, n - k, position, rotation, size, i, o)
            part(view)
        p, reach = which[k], reaches[which[k]]
        i, o, sense = longer_first(size, first[k], second[k])
        start[p] = taken
        apart_i, apart_o, edges_apart = view[FACES + 1, lane], view[FACES + 3, lane], view[EDGES + 1, lane]
        if not max(apart_i, apart_o, edges_apart) <= reach:
            continue
        face_i, face_o, edges = int(view[FACES, lane]), int(view[FACES + 2, lane]), int(view[EDGES, lane])
        towards_o = 1.0 if view[PLACE + face_i, lane] >= 0.0 else -1.0
        towards_i = 1.0 if view[VIEW + PLACE + face_o, lane] >= 0.0 else -1.0

        # The way out is along the normal of a face, to which one of the other box may be level, or of two edges.
        out_of_o = apart_o > apart_i + BIAS
        gap, level = apart_o if out_of_o else apart_i, -towards_o * towards_i * view[TURN + 3 * face_i + face_o, lane]
        facing_i, facing_o = level if out_of_o else 1.0, 1.0 if out_of_o else level
        if edges >= 0:
            edge_normal(view, lane, edges, way)
            if edges_apart > gap + BIAS:
                gap = edges_apart
                facing_i, facing_o = towards_o * way[face_i], -towards_i * along_other(view, lane, face_o, way)

        found, on_face = 0, False
        for side in range(0 if facing_i >= FACE_CONE else 1, 2 if facing_o >= FACE_CONE else 1):
            f, t, facing, c = (face_i, towards_o, 1.0, i) if side == 0 else (face_o, towards_i, -1.0, o)
            found, deepest = points_over(view, lane, side * VIEW, f, t, reach, over, height, over_feature)
            if abs(deepest + gap) > 2.0 * BIAS + (1.0 - FACE_CONE) * abs(gap):
                continue
            on_face = True
            found = reduce_area(over, height, over_feature, found, 0.0, 0.0, 1.0)
            along = t * facing * sense
            nx, ny, nz = turned(
                rotation, c, along if f == 0 else 0.0, along if f == 1 else 0.0, along if f == 2 else 0.0
            )
            number = FEATURES * (6 * side + 2 * f + (1 if t > 0.0 else 0))
            for q in range(found):
                place[f] = t * (view[side * VIEW + OWN + f, lane] + 0.5 * height[q])
                place[after(f)], place[after(after(f))] = over[3 * q], over[3 * q + 1]
                x, y, z = placed(position, rotation, c, place[0], place[1], place[2])
                write_point(
                    taken + q, number + over_feature[q], height[q], nx, ny, nz, x, y, z, feature, normal, depth, point
                )
            break
        if not on_face:
            c, inside, number = i, False, 0
            if edges >= 0:
                inside, number = crossing_edges(view, lane, edges, way, place)
                number, gap = EDGES_FROM + number, edges_apart
            if not inside and max(apart_i, apart_o, edges_apart) > LEAST_PART:
                number, gap = nearest_corner(view, lane, way, place)
                c, sense = (o, -sense) if number >= 8 else (c, sense)
                number += CORNERS_FROM
            if not gap <= reach:
                continue
            nx, ny, nz = turned(rotation, c, sense * way[0], sense * way[1], sense * way[2])
            x, y, z = placed(position, rotation, c, place[0], place[1], place[2])
            write_point(taken, number, gap, nx, ny, nz, x, y, z, feature, normal, depth, point)
            found = 1
        count[p] = found
        taken += found
    return taken


@inlined
def longer_first(size, i, o):
    """Return two boxes, that with the longer diagonal first, and -1 where they are swapped."""
    if diagonal(size, o) > diagonal(size, i):
        return o, i, -1.0
    return i, o, 1.0


@inlined
def diagonal(size, i):
    """Return the squared length of a box's diagonal."""
    return size[i, 0] * size[i, 0] + size[i, 1] * size[i, 1] + size[i, 2] * size[i, 2]
