"""Narrow phase of two boxes: the axis that parts them most, then the points of the faces or edges it names."""

from __future__ import annotations

import numpy as np

# mypy: disable-error-code="no-untyped-def"
from carom.systems.constants import BIAS, FACE_CONE, FLAT_COSINE, LEAST_PART
from carom.systems.kernels.crew import part_of, shared
from carom.systems.kernels.edges import EDGE_FEATURES, along_other, crossing_edges, edge_normal, nearest_corner
from carom.systems.kernels.faces import FEATURES, MOST_OVER, points_over
from carom.systems.kernels.frames import placed, turned
from carom.systems.kernels.kernel import inlined
from carom.systems.kernels.parting import EDGES, FACES, LANES, OWN, PLACE, ROWS, TURN, VIEW, part, put_in
from carom.systems.kernels.reduction import reduce_area
from carom.systems.kernels.writing import write_point

EDGES_FROM = 12 * FEATURES  # features: of 6 faces of either box, then of pairs of edges, then of corners
CORNERS_FROM = EDGES_FROM + EDGE_FEATURES


@shared("start", "count", "apart", "feature", "normal", "depth", "point", makes_arrays=True)
def measure_boxes(
    crew, which, first, second, reaches, taken, room, shape, size, position, rotation, geometry, hulls, meshes,
    apart, start, count, feature, normal, depth, point,
):  # fmt: skip
    """Measure pairs of boxes, in the form of `measure_balls`.

    The depth is that of the least way out, however deep or concentric the pose: the 15 axes are all there are
    (Gottschalk, Collision Queries using Oriented Bounding Boxes, 2000, section 3.3). A gap is that of the nearest
    points, along the line between them. A face within FACE_CONE of the way out gives up to eight points, that of the
    box with the longer diagonal if both do. Edges of faces that are level to FLAT_COSINE give the points between these
    faces, other edges and corners one. Since that box also goes first in the
    arithmetic, swapping boxes of different size turns normals and changes no other bit.
    """
    view, way, place = np.zeros((ROWS, LANES)), np.empty(3), np.empty(3)
    over, height, over_feature = np.empty(3 * MOST_OVER), np.empty(MOST_OVER), np.empty(MOST_OVER, np.int64)
    begin, end = part_of(crew, len(which))
    taken += room * begin
    for k in range(begin, end):
        lane = (k - begin) % LANES
        if lane == 0:
            for n in range(k, min(k + LANES, end)):
                i, o, _ = longer_first(size, first[n], second[n])
                put_in(view, n - k, position, rotation, size, i, o)
            part(view)
        p, reach = which[k], reaches[which[k]]
        i, o, sense = longer_first(size, first[k], second[k])
        start[p] = taken
        apart_i, apart_o, edges_apart = view[FACES + 1, lane], view[FACES + 3, lane], view[EDGES + 1, lane]
        apart[p] = max(apart_i, apart_o, edges_apart)
        if not apart[p] <= reach:
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

        found, inside, number = 0, False, 0
        for attempt in range(3):  # a face of either, and at last two edges of faces that are nearly level
            side, lean, off = attempt, 1.0, 2.0 * BIAS + (1.0 - FACE_CONE) * abs(gap)
            if attempt == 2:
                if edges < 0:
                    break
                inside, number = crossing_edges(view, lane, edges, way, place)
                gap, side, off = edges_apart, 0 if facing_i >= facing_o else 1, BIAS
                lean = max(facing_i, facing_o)
                if not inside or lean < FLAT_COSINE:
                    break
            elif (facing_i if attempt == 0 else facing_o) < FACE_CONE:
                continue
            f, t, facing, c = (face_i, towards_o, 1.0, i) if side == 0 else (face_o, towards_i, -1.0, o)
            between, deepest = points_over(view, lane, side * VIEW, f, t, reach / lean, over, height, over_feature)
            if between == 0 or abs(deepest * lean + gap) > off:
                continue
            found = reduce_area(over, height, over_feature, between, 0.0, 0.0, 1.0)
            if attempt == 2:
                nx, ny, nz = turned(rotation, i, sense * way[0], sense * way[1], sense * way[2])
            else:
                along = t * facing * sense
                nx, ny, nz = turned(
                    rotation, c, along if f == 0 else 0.0, along if f == 1 else 0.0, along if f == 2 else 0.0
                )
            face = FEATURES * (6 * side + 2 * f + (1 if t > 0.0 else 0))
            for q in range(found):
                out = t * (view[side * VIEW + OWN + f, lane] + 0.5 * height[q])
                x, y = over[3 * q], over[3 * q + 1]
                x, y, z = (out, x, y) if f == 0 else (y, out, x) if f == 1 else (x, y, out)
                x, y, z = placed(position, rotation, c, x, y, z)
                write_point(
                    taken + q, face + over_feature[q], lean * height[q], nx, ny, nz, x, y, z,
                    feature, normal, depth, point,
                )  # fmt: skip
            break
        if found == 0:
            c = i
            number += EDGES_FROM
            if not inside and apart[p] > LEAST_PART:
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
