"""Narrow phase of two boxes: the axis that parts them most, then the points of the faces or edges it names."""

from __future__ import annotations

import numpy as np

# mypy: disable-error-code="no-untyped-def"
from carom.systems.constants import BIAS, FACE_CONE, LEAST_PART
from carom.systems.kernels.edges import EDGE_FEATURES, crossing_edges, nearest_corner
from carom.systems.kernels.faces import FEATURES, MOST_OVER, keep_four, points_over
from carom.systems.kernels.frames import placed, turned
from carom.systems.kernels.kernel import inlined, kernel
from carom.systems.kernels.parting import (
    OWN,
    TURN,
    VIEW,
    after,
    along_axis,
    edge_normal,
    look,
    widest_edges,
    widest_face,
)

MOST_KEPT = 4
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
    view, place = np.empty(2 * VIEW), np.empty(3)
    over, over_feature = np.empty(3 * MOST_OVER), np.empty(MOST_OVER, np.int64)
    for k in range(len(which)):
        p, i, o, sense = which[k], first[k], second[k], 1.0
        start[p], reach = taken, reaches[p]
        if diagonal(size, o) > diagonal(size, i):
            i, o, sense = o, i, -1.0
        look(view, position, rotation, size, i, o)
        face_i, towards_o, apart_i = widest_face(view, 0)
        if not apart_i <= reach:
            continue
        face_o, towards_i, apart_o = widest_face(view, VIEW)
        if not apart_o <= reach:
            continue
        edges, edges_apart = widest_edges(view, max(apart_i, apart_o))
        if edges_apart > reach:
            continue

        gap, f, t = apart_i, face_i, towards_o  # the way out, n, is in the frame of i and leads to o
        nx, ny, nz = t if f == 0 else 0.0, t if f == 1 else 0.0, t if f == 2 else 0.0
        if apart_o > gap + BIAS:
            gap, f, t = apart_o, face_o, -towards_i
            nx, ny, nz = t * view[TURN + f], t * view[TURN + 3 + f], t * view[TURN + 6 + f]
        if edges_apart > gap + BIAS:
            gap = edges_apart
            nx, ny, nz = edge_normal(view, edges)

        found, on_face = 0, False
        for side in range(2):
            f, t, facing, c = (face_i, towards_o, 1.0, i) if side == 0 else (face_o, towards_i, -1.0, o)
            if facing * t * along_axis(view, side * VIEW, f, nx, ny, nz) < FACE_CONE:
                continue
            found, deepest = points_over(view, side * VIEW, f, t, reach, over, over_feature)
            if abs(deepest + gap) > 2.0 * BIAS + (1.0 - FACE_CONE) * abs(gap):
                continue
            on_face = True
            if found > MOST_KEPT:
                found = keep_four(found, over, over_feature)
            turn_sign = t * facing * sense
            mx, my, mz = turned(
                rotation, c, turn_sign if f == 0 else 0.0, turn_sign if f == 1 else 0.0, turn_sign if f == 2 else 0.0
            )
            number = FEATURES * (6 * side + 2 * f + (1 if t > 0.0 else 0))
            for q in range(found):
                height = over[3 * q + 2]
                place[f] = t * (view[side * VIEW + OWN + f] + 0.5 * height)
                place[after(f)], place[after(after(f))] = over[3 * q], over[3 * q + 1]
                x, y, z = placed(position, rotation, c, place[0], place[1], place[2])
                depth[taken + q], feature[taken + q] = -height, number + over_feature[q]
                normal[taken + q, 0], normal[taken + q, 1], normal[taken + q, 2] = mx, my, mz
                point[taken + q, 0], point[taken + q, 1], point[taken + q, 2] = x, y, z
            break
        if not on_face:
            c, inside, number, x, y, z = i, False, 0, 0.0, 0.0, 0.0
            if edges >= 0:
                nx, ny, nz = edge_normal(view, edges)
                inside, number, x, y, z = crossing_edges(view, edges, nx, ny, nz)
                number, gap = EDGES_FROM + number, edges_apart
            if max(apart_i, apart_o, edges_apart) > LEAST_PART:
                nearest, corner, wx, wy, wz, px, py, pz = nearest_corner(view)
                if not inside or nearest < edges_apart:
                    number, gap, nx, ny, nz, x, y, z = CORNERS_FROM + corner, nearest, wx, wy, wz, px, py, pz
                    if corner >= 8:
                        c, sense = o, -sense
            if not gap <= reach:
                continue
            found, depth[taken], feature[taken] = 1, -gap, number
            mx, my, mz = turned(rotation, c, sense * nx, sense * ny, sense * nz)
            normal[taken, 0], normal[taken, 1], normal[taken, 2] = mx, my, mz
            point[taken, 0], point[taken, 1], point[taken, 2] = placed(position, rotation, c, x, y, z)
        count[p] = found
        taken += found
    return taken


@inlined
def diagonal(size, i):
    """Return the squared length of a box's diagonal."""
    return size[i, 0] * size[i, 0] + size[i, 1] * size[i, 1] + size[i, 2] * size[i, 2]
