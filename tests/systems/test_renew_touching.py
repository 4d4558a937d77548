"""Who touches whom, carried from step to step, is what a few lines of Python say of it."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from carom.systems.constants import TOUCH
from carom.systems.kernels.touching import renew_touching, write_touching
from carom.systems.simulation import Simulation

BODIES = 7
NOW = 5.0  # s
Pair = tuple[int, int]


class Step(NamedTuple):
    """Who touched before, since when; how contacts press, how deep; who was struck, when; who sleeps; who is gone.

    Who is struck is so once more, these times (s) later.
    """

    before: dict[Pair, float]
    contacts: dict[Pair, list[tuple[float, float]]]
    struck: dict[Pair, float]
    sleepers: set[int]
    dead: set[int]
    again: list[float]


@st.composite
def steps(draw: st.DrawFn) -> Step:
    """Draw a step of a few bodies."""
    pairs = st.tuples(st.integers(0, BODIES - 1), st.integers(0, BODIES - 1)).filter(lambda pair: pair[0] < pair[1])
    point = st.tuples(st.sampled_from([0.0, 1.0]), st.sampled_from([-2.0 * TOUCH, -0.5 * TOUCH, 0.0]))
    dead = draw(st.sets(st.integers(0, BODIES - 1), max_size=2))
    living = pairs.filter(lambda pair: dead.isdisjoint(pair))
    return Step(
        draw(st.dictionaries(pairs, st.floats(0.0, 4.0), max_size=15)),
        draw(st.dictionaries(pairs, st.lists(point, min_size=1, max_size=3), max_size=15)),
        draw(st.dictionaries(living, st.floats(4.0, 5.0), max_size=4)),
        draw(st.sets(st.integers(0, BODIES - 1), max_size=3)),
        dead,
        draw(st.lists(st.floats(0.0, 0.5), max_size=2)),
    )


def expected(step: Step) -> tuple[list[tuple[Pair, float, bool]], list[Pair]]:
    """Return who touches now, since when and whether that begins, and who does no longer, each in order."""
    now = {}
    for pair in {*step.contacts, *step.struck}:
        if not step.dead.isdisjoint(pair):
            continue
        points = step.contacts.get(pair, [])
        known = pair in step.before
        presses = pair in step.struck or any(impulse > 0.0 for impulse, _ in points)
        if presses or any(depth >= (-TOUCH if known else 0.0) for _, depth in points):
            now[pair] = (step.before[pair] if known else step.struck.get(pair, NOW), not known)
    for pair, since in step.before.items():
        if pair not in now and step.dead.isdisjoint(pair) and not step.sleepers.isdisjoint(pair):
            now[pair] = since, False
    return [(pair, *now[pair]) for pair in sorted(now)], sorted(pair for pair in step.before if pair not in now)


@given(steps())
@settings(max_examples=300)
def test_who_touches_is_who_presses_lies_close_was_struck_or_sleeps(step: Step) -> None:
    """Pairs are sorted by rows, gone ones among them; each that is known keeps its time."""
    simulation = Simulation()
    handles = [int(simulation.add(collider={"sphere": {"radius": 0.5}})) for _ in range(BODIES)]
    world = simulation.world
    world.despawn(*(handles[body] for body in step.dead))
    asleep = np.array([body in step.sleepers for body in range(BODIES)])

    def entities(pairs: list[Pair]) -> list[np.ndarray]:
        return [np.array([handles[pair[side]] for pair in pairs], np.int64) for side in range(2)]

    def rows(pairs: list[Pair]) -> list[np.ndarray]:
        return [np.array([pair[side] for pair in pairs], np.int64) for side in range(2)]

    before = sorted(step.before)
    impacts = [(pair, time + later) for later in (*step.again, 0.0) for pair, time in step.struck.items()]
    impacts.sort(key=lambda impact: impact[1])  # as a step goes through them; who is gone was struck, too
    impacts += [((min(pair), max(pair)), NOW) for pair in step.before if not step.dead.isdisjoint(pair)]
    points = [(pair, *point) for pair in sorted(step.contacts) for point in step.contacts[pair]]
    of_points = [pair for pair, _, _ in points]
    impulse, depth = (np.array([point[k] for point in points]) for k in (1, 2))
    room = len(before) + len(points) + len(impacts)
    a, b, since = np.empty(room, np.int64), np.empty(room, np.int64), np.empty(room)
    begins, ends = np.empty(room, np.bool_), np.empty(len(before), np.bool_)
    living = np.array(handles)  # behind whose end may be anything, such as who was there before
    living[: len(world.handles())] = world.handles()
    living = living[: len(world.handles())]
    found, new = renew_touching(
        len(points), *entities(of_points), *rows(of_points), impulse, depth,
        len(impacts), *entities([pair for pair, _ in impacts]), np.array([time for _, time in impacts]),
        np.empty(len(impacts), np.int64), np.empty(len(impacts), np.int64), np.empty(len(impacts)), NOW,
        len(before), *entities(before), np.array([step.before[pair] for pair in before]),
        living, world.slots.row_shift, np.arange(BODIES), asleep, a, b, since, begins, ends,
    )  # fmt: skip
    number = {handle: body for body, handle in enumerate(handles)}
    told = [((number[int(a[n])], number[int(b[n])]), float(since[n]), bool(begins[n])) for n in range(found)]
    assert (told, [before[o] for o in np.nonzero(ends)[0]]) == expected(step)
    assert new == sum(begins[:found])


def test_who_begins_and_ends_to_touch_is_told_in_order_of_time_then_handles() -> None:
    """Rows are in another order than handles where entities have come in the place of others."""
    generator = np.random.default_rng(2)
    was_a, was_b, a, b = (generator.permutation(40) + first for first in (0, 40, 80, 120))
    ends, begins = generator.random(40) < 0.5, generator.random(40) < 0.5
    since = generator.integers(3, size=40).astype(np.float64)
    now_a, now_b, now_since = was_a.copy(), was_b.copy(), np.full(40, np.nan)
    end, begin = ([np.full(40, -1.0), *np.full((2, 40), -1, np.int64)] for _ in range(2))
    write_touching(40, ends, 7.0, *end, 40, a, b, since, begins, *begin, now_a, now_b, now_since)
    for told, wanted in (
        (end, sorted((7.0, was_a[n], was_b[n]) for n in np.nonzero(ends)[0])),
        (begin, sorted((since[n], a[n], b[n]) for n in np.nonzero(begins)[0])),
    ):
        assert list(zip(*(column[: len(wanted)] for column in told), strict=True)) == wanted
        assert all((column[len(wanted) :] == -1).all() for column in told)
    for now, wanted in ((now_a, a), (now_b, b), (now_since, since)):
        assert np.array_equal(now, wanted)
