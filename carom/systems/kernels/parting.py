"""The fifteen axes that may part two boxes: the normals of their faces and the common normals of their edges."""

from __future__ import annotations

from math import sqrt

# mypy: disable-error-code="no-untyped-def"
from carom.systems.constants import BIAS, PARALLEL_EDGES
from carom.systems.kernels.kernel import inlined, woven
from carom.systems.kernels.spatial import product, turn

# Pairs are parted side by side, in lanes that the compiler makes vectors of: the same arithmetic for all, without a
# branch. Rows of a lane are what one box sees of the other, in its own frame: the other's axes as columns of a matrix,
# the other's centre, its own half edges and the other's. The view of the other box follows, then what parts the two,
# and what is put in: their orientations and the way between their centres.
LANES = 32
TURN, PLACE, OWN, OTHER, VIEW = 0, 9, 12, 15, 18
FACES, EDGES, FIRST, SECOND, WAY, ROWS = 36, 40, 42, 46, 50, 53
FAR = 1e300


@inlined
def after(axis):
    """Return the axis after x, y or z."""
    return axis + 1 if axis < 2 else 0


@woven
def put_in(view, lane, position, rotation, size, i, o):
    """Put boxes i and o into a lane."""
    for d in range(4):
        view[FIRST + d, lane], view[SECOND + d, lane] = rotation[i, d], rotation[o, d]
    for d in range(3):
        view[WAY + d, lane] = position[o, d] - position[i, d]
        view[OWN + d, lane] = view[VIEW + OTHER + d, lane] = 0.5 * size[i, d]
        view[OTHER + d, lane] = view[VIEW + OWN + d, lane] = 0.5 * size[o, d]


@woven
def write(view, row, lane, x, y, z):
    """Write three rows of a lane."""
    view[row, lane], view[row + 1, lane], view[row + 2, lane] = x, y, z


@woven
def part(view):
    """Find in each lane how the boxes, of axes x, y, z and u, v, w, see each other, and what parts them.

    Write (axis, gap) of either's own face that parts them most, the first of those as good to BIAS, and (3 i + j, gap)
    of the edges, along axis i of the first and j of the second, whose normal parts them most; -1 where none parts them
    more than a face.
    """
    for lane in range(LANES):
        x, y, z, w = -view[FIRST, lane], -view[FIRST + 1, lane], -view[FIRST + 2, lane], view[FIRST + 3, lane]
        px, py, pz = turn(x, y, z, w, view[WAY, lane], view[WAY + 1, lane], view[WAY + 2, lane])
        qx, qy, qz, qw = view[SECOND, lane], view[SECOND + 1, lane], view[SECOND + 2, lane], view[SECOND + 3, lane]
        x, y, z, w = product(x, y, z, w, qx, qy, qz, qw)
        xx, yy, zz = 2.0 * x * x, 2.0 * y * y, 2.0 * z * z
        xy, xz, yz, wx, wy, wz = 2.0 * x * y, 2.0 * x * z, 2.0 * y * z, 2.0 * w * x, 2.0 * w * y, 2.0 * w * z
        xu, xv, xw = 1.0 - yy - zz, xy - wz, xz + wy
        yu, yv, yw = xy + wz, 1.0 - xx - zz, yz - wx
        zu, zv, zw = xz - wy, yz + wx, 1.0 - xx - yy
        pu, pv, pw = -(xu * px + yu * py + zu * pz), -(xv * px + yv * py + zv * pz), -(xw * px + yw * py + zw * pz)
        write(view, TURN, lane, xu, xv, xw)
        write(view, TURN + 3, lane, yu, yv, yw)
        write(view, TURN + 6, lane, zu, zv, zw)
        write(view, PLACE, lane, px, py, pz)
        write(view, VIEW + TURN, lane, xu, yu, zu)
        write(view, VIEW + TURN + 3, lane, xv, yv, zv)
        write(view, VIEW + TURN + 6, lane, xw, yw, zw)
        write(view, VIEW + PLACE, lane, pu, pv, pw)

        hx, hy, hz = view[OWN, lane], view[OWN + 1, lane], view[OWN + 2, lane]
        hu, hv, hw = view[OTHER, lane], view[OTHER + 1, lane], view[OTHER + 2, lane]
        axu, axv, axw, ayu, ayv, ayw = abs(xu), abs(xv), abs(xw), abs(yu), abs(yv), abs(yw)
        azu, azv, azw = abs(zu), abs(zv), abs(zw)
        axis, gap = 0.0, abs(px) - hx - (axu * hu + axv * hv + axw * hw)
        axis, gap = wider(axis, gap, 1.0, abs(py) - hy - (ayu * hu + ayv * hv + ayw * hw))
        axis, gap = wider(axis, gap, 2.0, abs(pz) - hz - (azu * hu + azv * hv + azw * hw))
        view[FACES, lane], view[FACES + 1, lane], widest = axis, gap, gap
        axis, gap = 0.0, abs(pu) - hu - (axu * hx + ayu * hy + azu * hz)
        axis, gap = wider(axis, gap, 1.0, abs(pv) - hv - (axv * hx + ayv * hy + azv * hz))
        axis, gap = wider(axis, gap, 2.0, abs(pw) - hw - (axw * hx + ayw * hy + azw * hz))
        view[FACES + 2, lane], view[FACES + 3, lane], widest = axis, gap, max(widest, gap)

        e, s, q = -1.0, widest * abs(widest), 1.0
        e, s, q = sharper(e, s, q, 0.0, yu, zu, abs(pz * yu - py * zu) - hy * azu - hz * ayu - hv * axw - hw * axv)
        e, s, q = sharper(e, s, q, 1.0, yv, zv, abs(pz * yv - py * zv) - hy * azv - hz * ayv - hw * axu - hu * axw)
        e, s, q = sharper(e, s, q, 2.0, yw, zw, abs(pz * yw - py * zw) - hy * azw - hz * ayw - hu * axv - hv * axu)
        e, s, q = sharper(e, s, q, 3.0, zu, xu, abs(px * zu - pz * xu) - hz * axu - hx * azu - hv * ayw - hw * ayv)
        e, s, q = sharper(e, s, q, 4.0, zv, xv, abs(px * zv - pz * xv) - hz * axv - hx * azv - hw * ayu - hu * ayw)
        e, s, q = sharper(e, s, q, 5.0, zw, xw, abs(px * zw - pz * xw) - hz * axw - hx * azw - hu * ayv - hv * ayu)
        e, s, q = sharper(e, s, q, 6.0, xu, yu, abs(py * xu - px * yu) - hx * ayu - hy * axu - hv * azw - hw * azv)
        e, s, q = sharper(e, s, q, 7.0, xv, yv, abs(py * xv - px * yv) - hx * ayv - hy * axv - hw * azu - hu * azw)
        e, s, q = sharper(e, s, q, 8.0, xw, yw, abs(py * xw - px * yw) - hx * ayw - hy * axw - hu * azv - hv * azu)
        gap = sqrt(abs(s) / q)
        view[EDGES, lane], view[EDGES + 1, lane] = e, gap if s > 0.0 else -gap


@inlined
def wider(axis, gap, other_axis, other_gap):
    """Return the axis with the wider gap, the first if they are as good to BIAS."""
    return (other_axis, other_gap) if other_gap > gap + BIAS else (axis, gap)


@inlined
def sharper(edges, square, per, other_edges, low, high, apart):
    """Return the edges with the wider gap, as its square with its sign and a divisor of that.

    ``low`` and ``high`` are what their cross product is made of, ``apart`` is the gap times its length.
    """
    squared = low * low + high * high
    better = (apart * abs(apart) * per > square * squared) & (squared > PARALLEL_EDGES)
    return (other_edges, apart * abs(apart), squared) if better else (edges, square, per)
