"""The arcs of bodies that rest on others."""

from __future__ import annotations

# mypy: disable-error-code="no-untyped-def,no-untyped-call"
from carom.systems.kernels import groups as of
from carom.systems.kernels.crew import eights_of, part_of_run, shared, wait_for_all
from carom.systems.kernels.groups import RUNS
from carom.systems.kernels.kernel import woven
from carom.systems.kernels.lane_columns import in_a_row, load_flat, load_three, store_flat, store_three
from carom.systems.kernels.lane_vectors import dot, minus, three, times
from carom.systems.kernels.lanes import WIDTH, address, choose, gather_four, load, planes, scatter_four, spread
from carom.systems.kernels.packing import CHANGE, MASS_AND_FELT
from carom.systems.kernels.resting_balls import are_even
from carom.systems.kernels.rubbing import IDLE


@shared("bodies", "linear", "angular", "acceleration", "angular_acceleration")
def bend_arcs(
    crew, h, rows, leans, levels, run_ends, index_a, index_b, row, asks, lanes, bodies,
    start_linear, start_angular, linear, angular, acceleration, angular_acceleration,
):  # fmt: skip
    """Let balls that only rest on others fly the substep at constant acceleration instead of at their last velocity.

    What friction and rolling resistance took is spread over the substep, which makes sliding and rolling exact between
    changes of state, and speeds right at impacts in between. Along the contact normals the velocity stays the last one.
    """
    change, packed, of_a, of_b = bodies[CHANGE], planes(bodies), address(index_a), address(index_b)
    begin, end = eights_of(crew, len(rows))
    mine, passed = rows[begin:end], 1
    for n in range(0, len(mine), WIDTH):
        if are_bent(leans, mine, n):
            v, start = load_three(address(linear), mine[n]), load_three(address(start_linear), mine[n])
            x, y, z = minus(v, start)
            eight = mine[n : n + WIDTH].reshape(1, WIDTH)
            scatter_four(packed[CHANGE], address(eight), 0, 0, (x, y, z, spread(0.0)))
            continue
        for i in mine[n : n + WIDTH]:
            for k in range(3):
                change[i, k] = linear[i, k] - start_linear[i, k] if is_bent(leans, i) else 0.0
    wait_for_all(crew, passed)
    for level in range(levels):
        for run in range(RUNS * level, RUNS * (level + 1)):
            begin, end = part_of_run(crew, run, run_ends)
            for g in range(begin, end):
                if asks[g] != IDLE:
                    keep_across(g, row[g], of_a, of_b, lanes, packed)
        passed += 1
        wait_for_all(crew, passed)
    for n in range(0, len(mine), WIDTH):
        if are_bent(leans, mine, n):
            eight = mine[n : n + WIDTH].reshape(1, WIDTH)
            x, y, z, _ = gather_four(packed[CHANGE], address(eight), 0, 0)
            store_three(address(acceleration), mine[n], (x / h, y / h, z / h))
            for at in range(3 * mine[n], 3 * (mine[n] + WIDTH), WIDTH):
                w = load_flat(angular, at)
                turning = (w - load_flat(start_angular, at)) / h
                store_flat(angular_acceleration, at, turning)
                store_flat(angular, at, w - h * turning)
                store_flat(linear, at, load_flat(linear, at) - h * load_flat(acceleration, at))
            continue
        for i in mine[n : n + WIDTH]:
            if is_bent(leans, i):
                for k in range(3):
                    acceleration[i, k] = change[i, k] / h
                    angular_acceleration[i, k] = (angular[i, k] - start_angular[i, k]) / h
                    linear[i, k] -= h * acceleration[i, k]
                    angular[i, k] -= h * angular_acceleration[i, k]


@woven
def are_bent(leans, rows, n):
    """Tell of eight rows from the n-th on whether they are next to each other, and all of them are bent."""
    if not in_a_row(rows, n):
        return False
    bent = True
    for i in range(rows[n], rows[n] + WIDTH):
        bent &= is_bent(leans, i)
    return bent


@woven
def is_bent(leans, i):
    """Tell whether a body leans on others as balls on exact arcs do, and not otherwise."""
    return leans[1, i] and not leans[0, i]


@woven
def keep_across(g, r, index_a, index_b, lanes, bodies):
    """Keep what is across the normals of the manifolds that rest, of what velocities have changed by."""
    rows = address(lanes)
    n, rests = three(rows, r + of.NORMAL), load(rows, r + of.RESTS)
    for index in (index_a, index_b):
        v = gather_four(bodies[CHANGE], index, g, 0)
        along = times(rests * dot(n, v), n)
        if not are_even(r, lanes):
            masses, zero = gather_four(bodies[MASS_AND_FELT], index, g, 0), spread(0.0)
            along = (
                choose(masses[0], along[0], zero), choose(masses[1], along[1], zero), choose(masses[2], along[2], zero)
            )  # fmt: skip
        x, y, z = minus(v, along)
        scatter_four(bodies[CHANGE], index, g, 0, (x, y, z, v[3]))
