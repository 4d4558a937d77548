"""Kernels of kinematics: bodies where their joints ask them to be, and joints so that a body comes to a target."""

from __future__ import annotations

from math import sqrt

# mypy: disable-error-code="no-untyped-def,no-untyped-call"
import numpy as np

from carom.ecs.components.joint import SLOTS
from carom.systems.constants import REACH_DAMPING, REACH_LEAST_DAMPING, REACH_MOST_DAMPING, REACH_ROUNDS
from carom.systems.kernels.kernel import inlined, kernel, making
from carom.systems.kernels.spatial import cross, product, sine_cosine, turn


@kernel()
def place_links(tree, angles, links):
    """Place link after link where the joint to the one before it asks, and write the axes of all ways in the world.

    ``tree`` is parent, forwards, anchor and frame on the way in, anchor and frame on the way out, way, rest; ``links``
    are position, rotation, axis and pivot, written but for the pose of link 0. Joint e goes from link ``parent[e]`` to
    link e + 1: ``forwards`` where that is its b. Ways with a number in ``way`` (e, slot) are where ``angles`` say,
    others at ``rest``. The axis of a way is that along or about which it moves what comes after, about its ``pivot``.
    """
    place(tree, angles, links)


@making
def place(tree, angles, links):
    """Do what `place_links` does."""
    parent, forwards, anchor_in, frame_in, anchor_out, frame_out, way, rest = tree
    position, rotation, axis, pivot = links
    at = np.empty(SLOTS)
    for e in range(len(parent)):
        p, c = parent[e], e + 1
        for s in range(SLOTS):
            at[s] = angles[way[e, s]] if way[e, s] >= 0 else rest[e, s]
        px, py, pz, pw = rotation[p, 0], rotation[p, 1], rotation[p, 2], rotation[p, 3]
        ax, ay, az = turn(px, py, pz, pw, anchor_in[e, 0], anchor_in[e, 1], anchor_in[e, 2])
        ax, ay, az = position[p, 0] + ax, position[p, 1] + ay, position[p, 2] + az
        fx, fy, fz, fw = product(px, py, pz, pw, frame_in[e, 0], frame_in[e, 1], frame_in[e, 2], frame_in[e, 3])
        sx, cx = sine_cosine(0.5 * at[3])
        sy, cy = sine_cosine(0.5 * at[4])
        sz, cz = sine_cosine(0.5 * at[5])
        tx, ty, tz, tw = product(sx, 0.0, 0.0, cx, 0.0, sy, 0.0, cy)
        qx, qy, qz, qw = product(tx, ty, tz, tw, 0.0, 0.0, sz, cz)
        if forwards[e]:
            gx, gy, gz, gw = product(fx, fy, fz, fw, qx, qy, qz, qw)  # the frame beyond the joint
            sign, ox, oy, oz, ow = 1.0, fx, fy, fz, fw
        else:
            gx, gy, gz, gw = product(fx, fy, fz, fw, -qx, -qy, -qz, qw)
            sign, ox, oy, oz, ow = -1.0, gx, gy, gz, gw
        dx, dy, dz = turn(ox, oy, oz, ow, at[0], at[1], at[2])
        bx, by, bz = ax + sign * dx, ay + sign * dy, az + sign * dz
        qx, qy, qz, qw = product(gx, gy, gz, gw, -frame_out[e, 0], -frame_out[e, 1], -frame_out[e, 2], frame_out[e, 3])
        rotation[c, 0], rotation[c, 1], rotation[c, 2], rotation[c, 3] = qx, qy, qz, qw
        x, y, z = turn(qx, qy, qz, qw, anchor_out[e, 0], anchor_out[e, 1], anchor_out[e, 2])
        position[c, 0], position[c, 1], position[c, 2] = bx - x, by - y, bz - z
        if not forwards[e]:  # it turns about the anchor of b, which is the one before it
            bx, by, bz = ax, ay, az
        rx, ry, rz, rw = product(ox, oy, oz, ow, sx, 0.0, 0.0, cx)
        tx, ty, tz, tw = product(ox, oy, oz, ow, tx, ty, tz, tw)
        for s in range(SLOTS):
            m = way[e, s]
            if m < 0:
                continue
            ux, uy, uz = 1.0 if s % 3 == 0 else 0.0, 1.0 if s % 3 == 1 else 0.0, 1.0 if s % 3 == 2 else 0.0
            if s <= 3:
                ux, uy, uz = turn(ox, oy, oz, ow, ux, uy, uz)
            elif s == 4:
                ux, uy, uz = turn(rx, ry, rz, rw, ux, uy, uz)
            else:
                ux, uy, uz = turn(tx, ty, tz, tw, ux, uy, uz)
            axis[m, 0], axis[m, 1], axis[m, 2] = sign * ux, sign * uy, sign * uz
            pivot[m, 0], pivot[m, 1], pivot[m, 2] = bx, by, bz


@kernel("jacobian")
def fill_jacobian(moves, turns, axis, pivot, x, y, z, jacobian):
    """Write how a point of the world goes (rows 0 to 2) and turns (3 to 5) with each way that ``moves`` it."""
    differentiate(moves, turns, axis, pivot, x, y, z, jacobian)


@inlined
def differentiate(moves, turns, axis, pivot, x, y, z, jacobian):
    """Do what `fill_jacobian` does (Siciliano et al., Robotics, 2009, 3.1)."""
    for m in range(len(moves)):
        ux, uy, uz = axis[m, 0], axis[m, 1], axis[m, 2]
        vx, vy, vz, wx, wy, wz = ux, uy, uz, 0.0, 0.0, 0.0
        if turns[m]:
            vx, vy, vz = cross(ux, uy, uz, x - pivot[m, 0], y - pivot[m, 1], z - pivot[m, 2])
            wx, wy, wz = ux, uy, uz
        for k, value in enumerate((vx, vy, vz, wx, wy, wz)):
            jacobian[k, m] = value if moves[m] else 0.0


@kernel("angles", "jacobian", makes_arrays=True)
def reach_target(tree, links, moves, turns, lower, upper, end, point, target, wanted, rows, close, angles, jacobian):
    """Turn and slide joints until a point of link ``end`` is at the target; return how far off it is (m and rad).

    Of ``rows`` 3 only its place counts, of 6 also how the link is turned. Damped least squares on the Jacobian, with
    more damping where a step does not help and less where it does (Nakamura and Hanafusa, J. Dyn. Sys. Meas. Control
    108, 163, 1986; Marquardt, J. Soc. Indust. Appl. Math. 11, 431, 1963): so what cannot be reached is come as near to
    as can be. Ways at a limit that would go beyond it stay out of a step. Ends at ``close``.
    """
    count, damping = len(angles), REACH_DAMPING
    tried, inside = np.empty(count), np.empty(count, np.bool_)
    error, missed, pull = np.empty(6), np.empty(6), np.empty(6)
    square, lower_part = np.empty((6, 6)), np.empty((6, 6))
    place(tree, angles, links)
    off = miss(links, end, point, target, wanted, rows, error)
    for _ in range(REACH_ROUNDS):
        if off <= close:
            break
        differentiate(
            moves, turns, links[2], links[3], target[0] - error[0], target[1] - error[1], target[2] - error[2], jacobian
        )
        scale = weigh(jacobian, error, angles, lower, upper, rows, inside, square)
        helps, now = False, off
        while scale > 0.0 and not helps and damping < REACH_MOST_DAMPING:
            solve(rows, square, damping * scale, error, lower_part, pull)
            for m in range(count):
                tried[m] = angles[m]
                if inside[m]:
                    for k in range(rows):
                        tried[m] += jacobian[k, m] * pull[k]
                tried[m] = min(max(tried[m], lower[m]), upper[m])
            place(tree, tried, links)
            now = miss(links, end, point, target, wanted, rows, missed)
            helps = now < off
            damping *= 8.0
        if not helps:
            break
        damping = max(damping / 64.0, REACH_LEAST_DAMPING)
        off = now
        for m in range(count):
            angles[m] = tried[m]
        for k in range(rows):
            error[k] = missed[k]
    return off


@inlined
def miss(links, end, point, target, wanted, rows, error):
    """Write what a point of a link lacks to its target, and the turn to what is wanted; return its length."""
    position, rotation = links[0], links[1]
    qx, qy, qz, qw = rotation[end, 0], rotation[end, 1], rotation[end, 2], rotation[end, 3]
    for k, p in enumerate(turn(qx, qy, qz, qw, point[0], point[1], point[2])):
        error[k] = target[k] - (position[end, k] + p)
    if rows == 6:
        x, y, z, w = product(wanted[0], wanted[1], wanted[2], wanted[3], -qx, -qy, -qz, qw)
        sign = 2.0 if w >= 0.0 else -2.0
        error[3], error[4], error[5] = sign * x, sign * y, sign * z
    total = 0.0
    for k in range(rows):
        total += error[k] * error[k]
    return sqrt(total)


@inlined
def weigh(jacobian, error, angles, lower, upper, rows, inside, square):
    """Find the ways that may take part in a step; write J J^T of those and return its trace."""
    for m in range(len(angles)):
        slope = 0.0
        for k in range(rows):
            slope += jacobian[k, m] * error[k]
        inside[m] = not ((angles[m] <= lower[m] and slope < 0.0) or (angles[m] >= upper[m] and slope > 0.0))
    trace = 0.0
    for k in range(rows):
        for n in range(rows):
            square[k, n] = 0.0
            for m in range(len(angles)):
                if inside[m]:
                    square[k, n] += jacobian[k, m] * jacobian[n, m]
        trace += square[k, k]
    return trace


@inlined
def solve(rows, square, damping, right, low, found):
    """Solve (A + d 1) x = b of a symmetric A that is not negative, by Cholesky's L L^T (Golub and Van Loan, 4.2)."""
    for k in range(rows):
        for n in range(k + 1):
            total = square[k, n] + (damping if k == n else 0.0)
            for m in range(n):
                total -= low[k, m] * low[n, m]
            low[k, n] = sqrt(max(total, damping)) if k == n else total / low[n, n]
    for k in range(rows):
        total = right[k]
        for n in range(k):
            total -= low[k, n] * found[n]
        found[k] = total / low[k, k]
    for k in range(rows - 1, -1, -1):
        total = found[k]
        for n in range(k + 1, rows):
            total -= low[n, k] * found[n]
        found[k] = total / low[k, k]
