"""The end of a substep."""

from __future__ import annotations

# mypy: disable-error-code="no-untyped-def,no-untyped-call"
from carom.systems.constants import STALE_TURN
from carom.systems.kernels import groups as of
from carom.systems.kernels.balls_in_lanes import are_balls
from carom.systems.kernels.crew import eights_of, part_of, shared, wait_for_all
from carom.systems.kernels.groups import MANIFOLD_ROWS, POINT_ROWS
from carom.systems.kernels.kernel import inlined, woven
from carom.systems.kernels.kinematic import keep_course
from carom.systems.kernels.lane_columns import are_all, in_a_row, load_flat, store_flat
from carom.systems.kernels.lane_vectors import dot, minus, three
from carom.systems.kernels.lanes import (
    WIDTH,
    address,
    choose,
    gather,
    gather_four,
    larger,
    load,
    planes,
    some,
    spread,
    store,
)
from carom.systems.kernels.manifolds import turn_about
from carom.systems.kernels.packing import WAY, weigh_anew, write_ways
from carom.systems.kernels.resting_balls import are_even
from carom.systems.kernels.sinking import sink_points
from carom.systems.kernels.spatial import turn


@shared("rotation", "center", "linear", "angular", "position")
def finish_drift(
    crew, rows, ended, h, inverse_mass, center_of_mass, freedom, start_position, start_rotation,
    decay, angular_decay, flow, rotation, center, linear, angular, position,
):  # fmt: skip
    """End the substep of h seconds: the second half of drag, and the origins placed."""
    begin, end = eights_of(crew, len(rows))
    rows = rows[begin:end]
    for n in range(0, len(rows), WIDTH):
        if in_a_row(rows, n) and are_plain(
            rows[n], ended, inverse_mass, center_of_mass, freedom, decay, angular_decay
        ):  # fmt: skip
            for at in range(3 * rows[n], 3 * (rows[n] + WIDTH), WIDTH):
                store_flat(position, at, load_flat(center, at))
            continue
        for i in rows[n : n + WIDTH]:
            finish_body(
                i, ended, h, inverse_mass, center_of_mass, freedom, start_position, start_rotation, decay,
                angular_decay, flow, rotation, center, linear, angular, position,
            )  # fmt: skip


@woven
def are_plain(i, ended, inverse_mass, center_of_mass, freedom, decay, angular_decay):
    """Tell of body i and the seven behind it that they turn about their origins, without locks, drag and keyframes."""
    if not (are_all(0.0, center_of_mass, 3, i) and are_all(1.0, freedom, 6, i)):
        return False
    if not ended:
        return True
    kinematic = choose(load_flat(inverse_mass, i), spread(0.0), spread(1.0))
    return are_all(1.0, decay, 1, i) and are_all(1.0, angular_decay, 1, i) and not some(kinematic)


@inlined
def finish_body(
    i, ended, h, inverse_mass, center_of_mass, freedom, start_position, start_rotation, decay, angular_decay, flow,
    rotation, center, linear, angular, position,
):  # fmt: skip
    """End the substep of one body."""
    if ended and inverse_mass[i] == 0.0:
        keep_course(i, h, center_of_mass, start_position, start_rotation, linear, angular, center, rotation)
    qx, qy, qz, qw = rotation[i, 0], rotation[i, 1], rotation[i, 2], rotation[i, 3]
    cx, cy, cz = center_of_mass[i, 0], center_of_mass[i, 1], center_of_mass[i, 2]
    x, y, z = 0.0, 0.0, 0.0
    if cx != 0.0 or cy != 0.0 or cz != 0.0:
        x, y, z = turn(qx, qy, qz, qw, cx, cy, cz)
    position[i, 0], position[i, 1], position[i, 2] = center[i, 0] - x, center[i, 1] - y, center[i, 2] - z
    if freedom[i, 0] + freedom[i, 1] + freedom[i, 2] < 3.0:  # not by way of the centre, which rounds
        qx, qy, qz, qw = start_rotation[i, 0], start_rotation[i, 1], start_rotation[i, 2], start_rotation[i, 3]
        sx, sy, sz = turn(qx, qy, qz, qw, cx, cy, cz)
        for k, moved in enumerate((sx - x, sy - y, sz - z)):
            if freedom[i, k] == 0.0:
                position[i, k] = start_position[i, k] + moved
    for k in range(3):
        if ended and decay[i] != 1.0:
            linear[i, k] = flow[i, k] + (linear[i, k] - flow[i, k]) * decay[i]
        if ended:
            angular[i, k] *= angular_decay[i]


@shared("bodies", "lanes")
def sink_contacts(
    crew, groups, rows, start_center, center, turned, inverse_mass, inverse_inertia, principal_axes, freedom, rotation,
    index_a, index_b, points, row, fresh, bodies, lanes,
):  # fmt: skip
    """Write into the lanes of groups how deep contacts have come to be as bodies (rows) moved.

    A point goes with both bodies, to first order of their turn; then it is carried on to where it is from them by now.
    """
    begin, end = part_of(crew, len(rows))
    write_ways(rows[begin:end], start_center, center, turned, inverse_mass, bodies)
    weigh_anew(rows[begin:end], turned, inverse_inertia, principal_axes, freedom, rotation, bodies)
    wait_for_all(crew, 1)
    into, moved, index_a, index_b = address(lanes), planes(bodies), address(index_a), address(index_b)
    begin, end = part_of(crew, groups)
    for g in range(begin, end):
        r = row[g]
        if are_even(r, lanes):
            a, b = gather_four(moved[WAY], index_a, g, 0), gather_four(moved[WAY], index_b, g, 0)
            q = r + MANIFOLD_ROWS
            store(into, q + of.DEPTH, load(into, q + of.DEPTH) - dot(three(into, r + of.NORMAL), minus(b, a)))
            continue
        a, b = gather(moved[WAY], index_a, g), gather(moved[WAY], index_b, g)
        sink_points(r, points[g], fresh[g], into, a, b)
        if some(larger(dot(a[4:7], a[4:7]), dot(b[4:7], b[4:7])) - STALE_TURN * STALE_TURN):
            turn_about(g, r, 0, index_a, into, moved)
            turn_about(g, r, 1, index_b, into, moved)


@shared("depth")
def tell_depths(crew, groups, first, size, row, kind, lanes, depth):
    """Write how deep contacts are into their table; those of balls on exact arcs are measured there."""
    begin, end = part_of(crew, groups)
    for g in range(begin, end):
        for lane in range(WIDTH if not are_balls(row[g], lanes) else 0):
            tell_depth(g, lane, first, size, row, kind, lanes, depth)


@woven
def tell_depth(g, lane, first, size, row, kind, lanes, depth):
    """Write how deep the contacts of one manifold are."""
    c = first[g, lane]
    if c >= 0 and kind[c] < 0:
        for p in range(size[g, lane]):
            depth[c + p] = lanes[row[g] + MANIFOLD_ROWS + POINT_ROWS * p + of.DEPTH, lane]
