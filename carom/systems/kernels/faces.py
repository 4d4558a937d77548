"""Two faces of boxes: the points at which one lies over the other."""

from __future__ import annotations

# mypy: disable-error-code="no-untyped-def"
from carom.systems.constants import BIAS
from carom.systems.kernels.kernel import inlined, woven
from carom.systems.kernels.parting import FAR, OTHER, OWN, PLACE, TURN, after

CROSSINGS, OWN_CORNERS, FEATURES = 8, 56, 60  # points over a face: corners of the other box are numbered from 0
MOST_OVER = 16  # points over a face: 4 corners, 8 crossings and 4 own corners at the very most
LEAST_DIVISOR, STEEP = 1e-30, 1e30


@woven
def points_over(view, lane, at, axis, sign, reach, over, height, feature):
    """Find the points of the other box's facing face that lie over a face of the own box and under ``reach``.

    Return their number and the depth of the deepest. ``over`` gets (along the next axis, along the one after, 0) of
    each, ``height`` how high it is. A point is a corner of the other face, an edge of it crossing a side of the own
    face, or an own corner under the other face (Gottschalk 1996, section 4; Ericson, Real-Time Collision Detection,
    5.3.3, for edges). A corner counts as within if it sticks out by BIAS, so that equal boxes in a stack share no two
    points for one.
    """
    u, v = after(axis), after(after(axis))
    turn = at + TURN
    row = turn + 3 * axis
    facing, most = 0, abs(view[row, lane])
    for j in range(1, 3):
        if abs(view[row + j, lane]) > most + BIAS:
            facing, most = j, abs(view[row + j, lane])
    k, m = after(facing), after(after(facing))
    side = -1.0 if sign * view[row + facing, lane] > 0.0 else 1.0  # of the other box, towards the own face
    edge, hk, hm = side * view[at + OTHER + facing, lane], view[at + OTHER + k, lane], view[at + OTHER + m, lane]
    cu = view[at + PLACE + u, lane] + edge * view[turn + 3 * u + facing, lane]
    cv = view[at + PLACE + v, lane] + edge * view[turn + 3 * v + facing, lane]
    cw = sign * (view[at + PLACE + axis, lane] + edge * view[row + facing, lane]) - view[at + OWN + axis, lane]
    ku, kv, kw = view[turn + 3 * u + k, lane], view[turn + 3 * v + k, lane], sign * view[row + k, lane]
    mu, mv, mw = view[turn + 3 * u + m, lane], view[turn + 3 * v + m, lane], sign * view[row + m, lane]
    hu, hv = view[at + OWN + u, lane], view[at + OWN + v, lane]
    per_ku, per_kv, per_mu, per_mv = reciprocal(ku), reciprocal(kv), reciprocal(mu), reciprocal(mv)
    found, deepest = 0, -FAR
    for e in range(4):  # edges of the other face: two along k, two along m, from their lower to their upper end
        upper = e % 2 == 1
        if e < 2:
            along, step, length, fu, fv, fw, per_u, per_v = k, m, hk, ku, kv, kw, per_ku, per_kv
            reached = hm if upper else -hm
            ou, ov, ow = cu + reached * mu, cv + reached * mv, cw + reached * mw
        else:
            along, step, length, fu, fv, fw, per_u, per_v = m, k, hm, mu, mv, mw, per_mu, per_mv
            reached = hk if upper else -hk
            ou, ov, ow = cu + reached * ku, cv + reached * kv, cw + reached * kw
        if ow - length * abs(fw) > reach + BIAS:
            continue
        begin, end, begin_side, end_side = -length, length, -1, -1  # what poses decide is chosen, not branched on
        middle, half = -ou * per_u, (hu + BIAS) * abs(per_u)
        begin_side, begin = (1 if fu < 0.0 else 0, middle - half) if middle - half > begin else (begin_side, begin)
        end_side, end = (1 if fu > 0.0 else 0, middle + half) if middle + half < end else (end_side, end)
        middle, half = -ov * per_v, (hv + BIAS) * abs(per_v)
        begin_side, begin = (3 if fv < 0.0 else 2, middle - half) if middle - half > begin else (begin_side, begin)
        end_side, end = (3 if fv > 0.0 else 2, middle + half) if middle + half < end else (end_side, end)
        if begin > end:
            continue
        low = (1 << facing if side > 0.0 else 0) | (1 << step if upper else 0)
        number = CROSSINGS + 4 * (4 * along + (1 if upper else 0) + (2 if side > 0.0 else 0))
        for last in range(2):
            t, crossed = (end, end_side) if last == 1 else (begin, begin_side)
            w = ow + t * fw
            if (w > reach + BIAS) | ((crossed < 0) & (e >= 2)):  # a corner is an end of an edge along k too
                continue
            deepest = max(deepest, -w)
            if w <= reach:
                over[3 * found], over[3 * found + 1], over[3 * found + 2] = ou + t * fu, ov + t * fv, 0.0
                height[found] = w
                feature[found] = number + crossed if crossed >= 0 else low | (last << along)
                found += 1
    inverse = 1.0 / (ku * mv - kv * mu)  # the other face is never seen edge-on: it faces the own one most
    for corner in range(4):
        pu, pv = (hu if corner & 1 else -hu) - cu, (hv if corner & 2 else -hv) - cv
        a, b = (pu * mv - pv * mu) * inverse, (pv * ku - pu * kv) * inverse
        w = cw + a * kw + b * mw
        if (w <= reach) & (abs(a) < hk - BIAS) & (abs(b) < hm - BIAS):
            deepest = max(deepest, -w)
            over[3 * found], over[3 * found + 1], over[3 * found + 2], height[found] = pu + cu, pv + cv, 0.0, w
            feature[found] = OWN_CORNERS + corner
            found += 1
    return found, deepest


@inlined
def reciprocal(x):
    """Return 1 / x, and a large number for 0."""
    return 1.0 / x if abs(x) > LEAST_DIVISOR else STEEP
