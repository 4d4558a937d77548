"""The resting stage: impulses that hold contacts, by soft steps over groups of manifolds."""

from __future__ import annotations

# mypy: disable-error-code="no-untyped-def,no-untyped-call"
from carom.systems.constants import CALM, MANIFOLD_POINTS, MORE_SWEEPS, ROLL_SWEEPS, START_SWEEPS, STIRRED
from carom.systems.kernels import groups as of
from carom.systems.kernels.crew import part_of, part_of_run, wait_for_all
from carom.systems.kernels.going_along import as_set_out
from carom.systems.kernels.groups import ABSENT, MANIFOLD_ROWS, POINT_ROWS, RUNS
from carom.systems.kernels.impulses import pressed, rolled, struck
from carom.systems.kernels.kernel import inlined, woven
from carom.systems.kernels.lane_vectors import dot, three
from carom.systems.kernels.lanes import (
    address,
    choose,
    fetch,
    gather,
    larger,
    load,
    planes,
    scatter,
    some,
    spread,
    store,
    which,
)
from carom.systems.kernels.levers import frame_of, parting_of
from carom.systems.kernels.packing import VELOCITY, read_velocities, write_velocities
from carom.systems.kernels.pressing import SCRATCH_ROWS, press_points
from carom.systems.kernels.resting_balls import outweighs, parted_by, press_balls, press_balls_warm
from carom.systems.kernels.rubbing import BALLS, IDLE, ROLLING, RUBBING, TWISTING, roll, rub, slip, swerved
from carom.systems.kernels.softness import of_any_load
from carom.systems.kernels.stirring import (
    KEPT_ROWS,
    NEVER,
    are_bearing,
    are_stirred,
    bear,
    last_of,
    put_aside,
    put_back,
    some_stir,
    stir,
)

PAGE_ROWS = max(SCRATCH_ROWS * MANIFOLD_POINTS, KEPT_ROWS)  # of points, and of what a group had before they are solved


@woven
def press_warm(g, r, points, asks, index_a, index_b, lanes, bodies):
    """Apply the impulses of a group."""
    if asks == BALLS:
        press_balls_warm(g, r, index_a, index_b, lanes, bodies)
        return
    a, b = gather(bodies[VELOCITY], index_a, g), gather(bodies[VELOCITY], index_b, g)
    total, by_t, by_u = spread(0.0), spread(0.0), spread(0.0)
    for p in range(points):
        q = r + MANIFOLD_ROWS + POINT_ROWS * p
        j = load(lanes, q + of.WARM)
        total = total + j
        by_t, by_u = by_t + j * load(lanes, q + of.AT + 1), by_u - j * load(lanes, q + of.AT)
    f, (t, u, _) = three(lanes, r + of.RUB), frame_of(r, lanes)
    along, across = dot(t, f), dot(u, f)
    along, across = as_set_out(r, along, across, total, lanes)
    by_n = load(lanes, r + of.SPUN) if asks >= TWISTING else spread(0.0)
    a, b = struck(r, lanes, a, b, along, across, total, by_t, by_u, by_n)
    if asks == ROLLING:
        x, y, z = three(lanes, r + of.ROLLED)
        a, b = rolled(g, index_a, index_b, bodies, a, b, x, y, z)
    scatter(bodies[VELOCITY], index_a, g, a)
    scatter(bodies[VELOCITY], index_b, g, b)


@inlined
def press_groups(
    crew, begins, swept, most, sweeps, ended, h, ends, levels, run_ends, soft, rigid,
    index_a, index_b, points, row, asks, rows, scratch, lanes, bodies, linear, angular, crushed, joined,
    stirred, stirs,
):  # fmt: skip
    """Solve every group that rests, in a stage of ``sweeps`` of which so many are ``swept``: ``most`` more of them.

    Where the last of a stage still stirs somebody (STIRRED), others follow until all are CALM, over the groups of
    those bodies that are not: ``stirred`` is the last sweep in which each was stirred. Whose manifold starts to
    press is stirred in the START_SWEEPS that follow, and who bears what is heavy in more (`bear`): beside who is
    ``joined`` (1) all are. In the row of ``stirs`` that even or odd sweeps have, each thread tells whether others
    are to follow. ``soft`` and ``rigid`` say how contacts of two moving bodies and of one yield (`aimed_at`); in
    sweeps that follow loads are those of a crash, and do not count but under who is heavy. Those with something
    that cannot move come last, so that what is under a pile has the last word. Where the substep ``begins`` with
    them, the impulses of the one before are applied first; where it has ``ended``, its impulses are added to those
    of the step. Velocities of ``rows`` are packed before and unpacked behind.

    A thread takes its part of each run of a level, waits for the others after that, and has two pages of ``scratch``.
    """
    _, part, parts = crew
    velocity, kept, scratch = bodies[VELOCITY], address(scratch[part, 1]), address(scratch[part, 0])
    loads, lanes, bodies, of_a, of_b = lanes, address(lanes), planes(bodies), address(index_a), address(index_b)
    begin, end = part_of(crew, len(rows))
    mine = rows[begin:end]
    write_velocities(mine, linear, angular, velocity)
    if swept == 0:
        begin, end = part_of(crew, stirred.shape[1])
        stirred[:, begin:end] = NEVER
    passed = 1
    wait_for_all(crew, passed)
    for level in range(levels if begins else 0):
        for run in range(RUNS * level, RUNS * (level + 1)):
            begin, end = part_of_run(crew, run, run_ends)
            for g in range(begin, end):
                if asks[g] != IDLE:
                    fetch_next(g, end, of_a, of_b, bodies)
                    press_warm(g, row[g], points[g], asks[g], of_a, of_b, lanes, bodies)
        passed += 1
        wait_for_all(crew, passed)
    for sweep in range(swept, swept + most):
        last, again, stirs_some = sweep >= sweeps - 1, sweep >= sweeps, False
        limit = CALM if again else STIRRED
        for level in range(levels):
            for run in range(RUNS * level, RUNS * (level + 1)):
                begin, end = part_of_run(crew, run, run_ends)
                for g in range(begin, end):
                    if asks[g] == IDLE:
                        continue
                    fetch_next(g, end, of_a, of_b, bodies)
                    yielding, bearing, counts = soft if g < ends[0] else rigid, spread(1.0), points[g] > 1
                    if again:
                        concerned = are_stirred(g, sweep - 1, index_a, index_b, stirred)
                        if not some(concerned):
                            continue
                        bearing = are_bearing(g, sweep, index_a, index_b, stirred)
                        counts = some(bearing)
                        put_aside(g, row[g], points[g], asks[g], of_a, of_b, lanes, bodies, kept)
                    if not counts:
                        yielding = of_any_load(yielding)
                    excess, starts, bears, heavy = press(
                        g, row[g], points[g], asks[g], 1.0 / h, yielding, bearing, limit, g < ends[0],
                        1 if again else ROLL_SWEEPS, of_a, of_b, lanes, bodies, scratch,
                    )  # fmt: skip
                    if len(joined):
                        heavy = larger(heavy, last_of(g, index_a, index_b, joined))
                    if again:
                        put_back(concerned, g, row[g], points[g], asks[g], ended, of_a, of_b, lanes, bodies, kept)
                        excess = choose(concerned, excess, spread(0.0))
                        heavy = choose(concerned, heavy, spread(0.0))
                        go_on = are_stirred(g, sweep, index_a, index_b, stirred)
                        stirs_some |= some(choose(concerned, go_on, spread(0.0)))
                    elif ended and last:
                        sum_impulses(row[g], points[g], lanes)
                    if last and not again and some(starts):
                        stir(g, sweep + START_SWEEPS - 1, which(starts), index_a, index_b, velocity, crushed, stirred)
                        stirs_some = True
                    bears = choose(larger(heavy, bearing) if again else heavy, bears, spread(0.0))
                    if last and some(bears):
                        stirs_some |= bear(
                            g, row[g], points[g], sweeps, 1.0 / h, which(bears), which(heavy), index_a, index_b, loads,
                            velocity, crushed, stirred,
                        )  # fmt: skip
                    if last and sweep < sweeps + MORE_SWEEPS - 1 and some(excess):
                        stir(g, sweep, which(excess), index_a, index_b, velocity, crushed, stirred)
                        stirs_some = True
            passed += 1
            if level == levels - 1:
                stirs[sweep % 2, part] = stirs_some
            wait_for_all(crew, passed)
        if last and not some_stir(stirs, sweep, parts):
            break
    read_velocities(mine, velocity, linear, angular)


@woven
def fetch_next(g, end, index_a, index_b, bodies):
    """Have the velocities fetched that the group after g is of, which lie anywhere, while g is being solved."""
    if g + 1 < end:
        fetch(bodies[VELOCITY], index_a, g + 1)
        fetch(bodies[VELOCITY], index_b, g + 1)


@woven
def sum_impulses(r, points, lanes):
    """Add the impulses of a group in the substep to those of the step."""
    for p in range(points):
        q = r + MANIFOLD_ROWS + POINT_ROWS * p
        store(lanes, q + of.SUM, load(lanes, q + of.SUM) + load(lanes, q + of.WARM))
    for k in range(3):
        store(lanes, r + of.RUBBED + k, load(lanes, r + of.RUBBED + k) + load(lanes, r + of.RUB + k))


@woven
def press(
    g, r, points, asks, per_second, yielding, bearing, limit, both_yield, roll_sweeps,
    index_a, index_b, lanes, bodies, scratch,
):  # fmt: skip
    """Solve a group once: the points of each manifold one after the other, then friction, spinning and rolling.

    All but rolling is found in the frames of manifolds, and what bodies move by is added up once; friction and rolling
    are solved by turns, at most so many times (``roll_sweeps``).
    Return more than 0 where that changes by more than the ``limit`` (m/s) how fast bodies part: their centres where
    ``both_yield``, else each of their points, of flat ones many times as fast. More than 0 where no point has pressed
    before: friction turns bodies, against which points cannot press before the next sweep. And more than 0 where points
    are loaded (`borne`), and where one body is so much heavier that others bear it (`outweighs`).
    """
    if asks == BALLS:
        excess, bears, heavy = press_balls(g, r, per_second, yielding, bearing, limit, index_a, index_b, lanes, bodies)
        return excess, spread(0.0), bears, heavy
    a, b = gather(bodies[VELOCITY], index_a, g), gather(bodies[VELOCITY], index_b, g)
    parting, slipping = parting_of(r, lanes, a, b), slip(r, lanes, a, b)
    # Loops over a known number of points are unrolled.
    if points == 1:
        solved = press_points(1, r, per_second, yielding, bearing, limit, parting, lanes, scratch)
    elif points == 2:
        solved = press_points(2, r, per_second, yielding, bearing, limit, parting, lanes, scratch)
    elif points == 3:
        solved = press_points(3, r, per_second, yielding, bearing, limit, parting, lanes, scratch)
    else:
        solved = press_points(4, r, per_second, yielding, bearing, limit, parting, lanes, scratch)
    total, twisting, push, by_t, by_u, excess, bears = solved
    if asks == ROLLING:
        a, b = pressed(r, lanes, a, b, push, by_t, by_u)
        a, b = roll(g, r, roll_sweeps, total, twisting, a, b, index_a, index_b, lanes, bodies)
    elif asks >= RUBBING:
        slipping = swerved(r, points, lanes, slipping, push, by_t, by_u)
        along, across, by_n, _ = rub(r, asks, slipping, total, twisting, lanes)
        a, b = struck(r, lanes, a, b, along, across, push, by_t, by_u, by_n)
    else:
        a, b = pressed(r, lanes, a, b, push, by_t, by_u)
    scatter(bodies[VELOCITY], index_a, g, a)
    scatter(bodies[VELOCITY], index_b, g, b)
    starts = spread(0.0)
    if points > 1:  # one point cannot hold up what turns over it
        second = load(lanes, r + MANIFOLD_ROWS + POINT_ROWS + of.DEPTH) - spread(0.5 * ABSENT)
        starts = choose(second, choose(total - push, spread(0.0), total), spread(0.0))
    return parted_by(push, a, b) - limit if both_yield else excess, starts, bears, outweighs(a, b)
