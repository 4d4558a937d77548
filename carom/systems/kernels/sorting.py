"""Which manifolds rest in a substep, and which are left to impacts."""

from __future__ import annotations

# mypy: disable-error-code="no-untyped-def,no-untyped-call"
from carom.systems.constants import APPROACH, REST_SPEED_FACTOR, ROOT_GAP, SLOP, STALE_TURN, TOUCH
from carom.systems.kernels import groups as of
from carom.systems.kernels.ball_contacts import measure_ball, measure_balls_on_still
from carom.systems.kernels.ball_seams import is_borne_beside
from carom.systems.kernels.balls import BOX
from carom.systems.kernels.balls_in_lanes import are_balls, measure_balls_in_lanes
from carom.systems.kernels.balls_on_still import are_on_still
from carom.systems.kernels.bodies import is_on_joint
from carom.systems.kernels.coming_up import coming_up_in_lanes
from carom.systems.kernels.crew import part_of, shared, wait_for_all
from carom.systems.kernels.filling import find_tangents, place_point, place_points, places_of
from carom.systems.kernels.going_along import set_out
from carom.systems.kernels.groups import MANIFOLD_ROWS, POINT_ROWS
from carom.systems.kernels.kernel import woven
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
    root,
    smaller,
    some,
    spread,
    store,
    which,
)
from carom.systems.kernels.levers import parting_at, parting_of
from carom.systems.kernels.manifolds import prepare
from carom.systems.kernels.packing import INVERSE_MASS, MASS_AND_FELT, VELOCITY, felt_of
from carom.systems.kernels.resting_balls import are_even, follow_normals, weigh_balls
from carom.systems.kernels.rubbing import BALLS, IDLE, RESTING, ROLLING, RUBBING, TWISTING
from carom.systems.kernels.settling import tell_depth

# What `TOGETHER` is of manifolds that rested in the substep before, and on a joint; of those that struck in it, in how
# many substeps in a row; of what is no ball one may be left out between two, and it is less than 0 in that.
RESTED, JOINED = 0.5, 1e9


@shared(
    "numbers", "fresh", "stale", "looks", "asks", "lanes", "normal", "depth", "point", "offset_a", "offset_b",
    "resting", "touching", "leans",
)  # fmt: skip
def sort_groups(
    crew, groups, h, bends, resting_stage, joined, ends, index_a, index_b, first, size, points, row,
    fresh, stale, looks, asks, lanes, bodies, center, rotation,
    kind, ball, other, sign, radius, extent, other_position, other_rotation, body_a, body_b,
    normal, depth, point, offset_a, offset_b, resting, strikes, beside, on_joint, touching, leans, numbers,
):  # fmt: skip
    """Say which manifolds rest at the start of the substep and prepare them.

    A group is prepared when it is ``fresh`` from detection, when others of it rest, and where balls have moved on or
    bodies turned (STALE_TURN); it ``looks`` at its manifolds one by one where they have to be measured so. Of two balls
    the contact table learns later (`write_touches`). What rested before is read from it where it is ``stale``: someone
    else has written it since; and where bodies may be ``joined``.
    Mark the bodies of those that rest as touching, and in ``leans``: those of balls on exact arcs in the second row, of
    others in the first. Count in ``numbers``, for each thread, how many rest.
    """
    rows, packed, of_a, of_b = address(lanes), planes(bodies), address(index_a), address(index_b)
    begin, end = part_of(crew, groups)
    number = 0
    for g in range(begin, end):
        r = row[g]
        changed = fresh[g]
        if changed:
            looks[g] = g >= ends[0] or (some(load(rows, r + of.BALL)) and not are_balls(r, lanes))
        measured = g < ends[0] and are_balls(r, lanes)
        on_still = False
        moved_on = measured
        if measured:
            measure_balls_in_lanes(g, r, are_even(r, lanes), of_a, of_b, rows, packed)
        elif looks[g] and are_on_still(places_of(g, 0, first, size), load(rows, r + of.SHARE), kind, other):
            measure_balls_on_still(
                g, r, first, size, beside, center, rotation, kind, ball, other, sign, radius, extent,
                other_position, other_rotation, normal, depth, point, offset_a, offset_b, lanes,
            )  # fmt: skip
            moved_on = on_still = True
        elif looks[g]:
            for lane in range(WIDTH):
                c = first[g, lane]
                if c < 0:
                    continue
                moves = kind[c] >= 0
                tell_depth(g, lane, first, size, row, kind, lanes, depth)
                if moves:
                    measure_ball(
                        c, center, rotation, kind, ball, other, sign, radius, extent, other_position, other_rotation,
                        normal, depth, point, offset_a, offset_b,
                    )  # fmt: skip
                    if kind[c] == BOX:
                        lanes[r + of.BESIDE, lane] = is_borne_beside(
                            c, beside, center, rotation, ball, other, sign, radius, extent,
                            other_position, other_rotation, normal, depth,
                        )  # fmt: skip
                    place_point(c, r, lane, normal, depth, offset_a, offset_b, lanes)
                    moved_on = True
        if are_even(r, lanes):
            follow_normals(r, rows)
        elif measured or on_still:
            find_tangents(r, rows)
            if on_still:
                place_points(g, r, points[g], first, size, offset_a, offset_b, depth, lanes)
        if measured:
            parting, yields, turning = parting_of_balls(g, r, of_a, of_b, rows, packed)
        else:
            a, b = gather(packed[VELOCITY], of_a, g), gather(packed[VELOCITY], of_b, g)
            moved_on |= set_out(g, r, points[g], h, bends, a, b, of_a, of_b, rows, packed)
            parting, yields = parting_of(r, rows, a, b), a[INVERSE_MASS] + b[INVERSE_MASS]
            turning = coming_up_in_lanes(r, rows, a, b)
        if moved_on:
            let_touch(r, rows)
        before = load(rows, r + of.RESTS)
        if stale[g] or joined:
            recall(g, r, fresh[g], index_a, index_b, first, on_joint, resting, strikes, lanes)
        else:
            last = load(rows, r + of.TOGETHER) if not fresh[g] else spread(0.0)
            missed = choose(load(rows, r + of.BALL), spread(0.0), choose(last - RESTED, -last, spread(0.0)))
            store(rows, r + of.TOGETHER, choose(before, spread(RESTED), missed))
        rests, lies = find_resting(g, r, points[g], measured, h, parting, yields, turning, of_a, of_b, rows, packed)
        rests = rests * resting_stage
        store(rows, r + of.RESTS, rests)
        others = some(rests - before) or some(before - rests)
        changed |= others
        held = which(rests)
        lying = held & which(lies)
        if held:
            as_balls = which(load(rows, r + of.BALL))
            for lane in range(WIDTH):
                number += held >> lane & 1
                if lying >> lane & 1:
                    as_ball = as_balls >> lane & 1
                    leans[as_ball, index_a[g, lane]] = leans[as_ball, index_b[g, lane]] = True
        if others or stale[g] or joined or (fresh[g] and points[g] > 1):
            for lane in range(WIDTH):
                c = first[g, lane]
                for k in range(c, c + size[g, lane]):
                    resting[k] = (held >> lane & 1) == 1
        if changed:
            asks[g] = BALLS if some(rests) and are_even(r, lanes) else asked(r, points[g], rests, rows)
            forget(r, points[g], rests, are_even(r, lanes), rows)
        fresh[g] = stale[g] = False
        if asks[g] == BALLS:
            if changed:
                weigh_balls(g, r, rests, of_a, of_b, rows, packed)
        elif asks[g] != IDLE and (changed or moved_on or some(load(rows, r + of.SWUNG) - STALE_TURN)):
            prepare(g, r, points[g], asks[g], rests, of_a, of_b, rows, packed)
    numbers[crew[1]] = number
    wait_for_all(crew, 1)
    begin, end = part_of(crew, len(touching))
    for i in range(begin, end):
        touching[i] |= leans[0, i] | leans[1, i]


@woven
def let_touch(r, lanes):
    """Let balls of a group touch that do to rounding: which side of that they lie on after an impact is chance."""
    depth, zero = load(lanes, r + MANIFOLD_ROWS + of.DEPTH), spread(0.0)
    exact = choose(larger(depth, -depth) - ROOT_GAP, depth, zero)
    store(lanes, r + MANIFOLD_ROWS + of.DEPTH, choose(load(lanes, r + of.BALL), exact, depth))


@woven
def recall(g, r, fresh, index_a, index_b, first, on_joint, resting, strikes, lanes):
    """Write which manifolds of a group rested or struck in the substep before, and which are on a joint."""
    for lane in range(WIDTH):
        c, before, last = first[g, lane], 0.0, lanes[r + of.TOGETHER, lane] if not fresh else 0.0
        if c >= 0:
            a, b, before = index_a[g, lane], index_b[g, lane], RESTED if resting[c] else 0.0
            if not resting[c] and RESTED < last < JOINED and lanes[r + of.BALL, lane] == 0.0:
                before = -last
            if strikes[c] and not fresh:
                before = 1.0 + abs(last) // 1.0 % JOINED
            if is_on_joint(a, on_joint) or is_on_joint(b, on_joint):
                before = JOINED
        lanes[r + of.TOGETHER, lane] = before


@woven
def asked(r, points, rests, lanes):
    """Return what the manifolds of a group ask for of the resting stage."""
    if not some(rests):
        return IDLE
    if some(load(lanes, r + of.ROLLING)):
        return ROLLING
    if some(load(lanes, r + of.SPINNING)):
        return TWISTING
    if some(load(lanes, r + of.FRICTION)):
        return TWISTING if points > 1 else RUBBING
    return RESTING


@woven
def forget(r, points, rests, even, lanes):
    """Forget the impulses of manifolds that do not rest; those that are ``even`` only press and rub."""
    for p in range(points):
        q = r + MANIFOLD_ROWS + POINT_ROWS * p
        store(lanes, q + of.WARM, load(lanes, q + of.WARM) * rests)
    for k in range(3):
        store(lanes, r + of.RUB + k, load(lanes, r + of.RUB + k) * rests)
    if not even:
        store(lanes, r + of.SPUN, load(lanes, r + of.SPUN) * rests)
        for k in range(3):
            store(lanes, r + of.ROLLED + k, load(lanes, r + of.ROLLED + k) * rests)


@woven
def parting_of_balls(g, r, index_a, index_b, lanes, bodies):
    """Return how fast balls of a group part, as `parting_of` does, how they yield, and that none of them turns."""
    v, w = gather_four(bodies[VELOCITY], index_a, g, 0), gather_four(bodies[VELOCITY], index_b, g, 0)
    zero = spread(0.0)
    return (dot(three(lanes, r + of.NORMAL), minus(w, v)), zero, zero), v[INVERSE_MASS] + w[INVERSE_MASS], zero


@woven
def find_resting(g, r, points, balls, h, parting, yields, turning, index_a, index_b, lanes, bodies):
    """Return 1 for each manifold that rests, else 0, and for each that lies: of which its bodies feel that they touch.

    One rests when one of its points touches or would by the end of the substep (of balls, and of what bounces, only
    once it touches), unless one would strike: close faster than the rest speed. What was pressed together before goes
    on resting. A ball, what bounces, and whatever has struck in two substeps does so if it neither parts nor closes
    faster than the rest speed: what others press it by would else have it strike anew, in each substep or in every
    second, and never be pushed out of those. But it does not lie.
    """
    n, zero = three(lanes, r + of.NORMAL), spread(0.0)
    felt_a, felt_b = felt_of(bodies[MASS_AND_FELT], index_a, g), felt_of(bodies[MASS_AND_FELT], index_b, g)
    together, one = load(lanes, r + of.TOGETHER), spread(1.0)
    joined = together - 0.5 * JOINED
    restitution = load(lanes, r + of.RESTITUTION)
    waits = choose(joined, zero, larger(load(lanes, r + of.BALL), restitution))
    pressing = larger(zero, larger(dot(n, felt_a), -dot(n, felt_b))) + turning
    held = zero
    for p in range(points):
        held = larger(held, load(lanes, r + MANIFOLD_ROWS + POINT_ROWS * p + of.WARM))
    engaged = choose(choose(joined, zero, together - 1.5), one, choose(waits, held, zero))
    bearing = held * (yields / h)
    # Without restitution there is no bounce to lose by resting, so that all that forces do counts; and bounces that
    # land again in the next substep, or that what one bears of the other would end within two, are none.
    all_forces = root(larger(dot(felt_a, felt_a), dot(felt_b, felt_b))) + turning
    slow = choose(engaged, larger(all_forces, bearing), choose(restitution, pressing, all_forces))
    limit = slow * (REST_SPEED_FACTOR * h) + APPROACH
    near, striking = spread(-1.0), spread(-1.0)
    # What forces kept together before, is on a joint or inside one another, and does not bounce, rests however fast it
    # closes.
    known = larger(choose(all_forces, together, zero), joined)
    may_strike = some(choose(load(lanes, r + of.SHARE), choose(known, restitution, one), zero))
    for p in range(points):
        q = r + MANIFOLD_ROWS + POINT_ROWS * p
        closing = -(parting_at(q, lanes, parting) if points > 1 else parting[0])
        gap = -load(lanes, q + of.DEPTH)
        after = gap - closing * h - pressing * (0.5 * h * h)
        touching = choose(waits, smaller(TOUCH - gap, -after), choose(gap - SLOP, zero, spread(SLOP)) - after)
        if may_strike:
            bounces = choose(larger(known, -SLOP - gap), restitution, one)
            striking = choose(touching, choose(bounces, larger(striking, closing - limit), striking), striking)
        near = larger(near, touching)
    lies = choose(-near, zero, choose(choose(waits, zero, held), one, choose(striking, zero, one)))
    rests = choose(limit - larger(parting[0], -parting[0]), choose(engaged, one, lies), lies)
    return (rests if balls else choose(load(lanes, r + of.BESIDE), zero, rests)), lies
