"""Contacts found take the places of those before and keep what they held, however many move and where to."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from carom.ecs import Collider
from carom.ecs.relations.contact import Contact
from carom.ecs.table import Table
from carom.systems.detection.narrow import Found
from carom.systems.kernels.crew import ALONE, threads_of
from carom.systems.kernels.renewal import renew_contacts
from carom.systems.simulation import Simulation
from carom.systems.threads import Threads

ROWS = 6
HELD = (
    "resting", "warm_normal", "warm_friction", "warm_rolling", "impulse", "friction_impulse", "strikes", "plastic",
)  # fmt: skip
#: What is carried for those that are recycled; of others it is said elsewhere.
CARRIED = (
    "seat_a", "seat_b", "lean_a", "lean_b", "seat_depth", "seat_reach", "form",
    "body_a", "body_b", "offset_a", "offset_b", "share",
    "friction", "restitution", "rolling", "spinning", "surface", "kind",
)  # fmt: skip
SIMULATION = Simulation()
SIMULATION.add_many(np.zeros((ROWS, 3)), collider={"sphere": {"radius": 0.5}})
FAR = 10.0  # m between the places that points are drawn from; what is in one place is the same point
Point = tuple[int, int]  # feature, place
Pairs = dict[tuple[int, int], list[Point]]


class Renewal(NamedTuple):
    """The points of pairs before and now, and the pairs that are recycled."""

    before: Pairs
    now: Pairs
    recycled: set[tuple[int, int]]


@st.composite
def renewals(draw: st.DrawFn) -> Renewal:
    """Draw pairs that stay, come, go and change their points."""
    pairs = st.tuples(st.integers(0, ROWS - 1), st.integers(0, ROWS - 1)).filter(lambda pair: pair[0] < pair[1])
    points = st.lists(
        st.tuples(st.integers(0, 6), st.integers(0, 3)),
        min_size=1,
        max_size=4,
        unique_by=(lambda p: p[0], lambda p: p[1]),
    ).map(sorted)
    before, now = draw(st.dictionaries(pairs, points, max_size=12)), draw(st.dictionaries(pairs, points, max_size=12))
    recycled = draw(st.sets(st.sampled_from(sorted(before)), max_size=8)) if before else set()
    return Renewal(before, now | {pair: before[pair] for pair in recycled}, recycled)


def listed(pairs: Pairs) -> list[tuple[tuple[int, int], Point]]:
    """Return the points of all pairs as they stand in a table."""
    return [(pair, point) for pair in sorted(pairs) for point in pairs[pair]]


def expected(renewal: Renewal) -> list[int]:
    """Return which of the contacts before each of those now was, -1 for none."""
    old, match = listed(renewal.before), []
    for pair in sorted(renewal.now):
        known = {point: k for k, (of, point) in enumerate(old) if of == pair}
        by_feature = {feature: k for (feature, _), k in known.items()}
        left = {place: k for (feature, place), k in known.items() if feature not in dict(renewal.now[pair])}
        match += [by_feature.get(feature, left.get(place, -1)) for feature, place in renewal.now[pair]]
    return match


@pytest.mark.parametrize("threads", [1, 2])
@given(renewals())
@settings(max_examples=200)
def test_contacts_keep_what_they_held(threads: int, renewal: Renewal) -> None:
    """Each number that a contact holds goes where that goes; of new ones all are 0; nobody's place hangs on threads."""
    old, now, match = listed(renewal.before), listed(renewal.now), np.array(expected(renewal), np.int64)
    room, count = len(old) + len(now), len(now)
    handles, collider = SIMULATION.world.handles(), SIMULATION.world[Collider]
    contact: Any = Table(Contact, room + 1).live
    for k, ((x, y), (feature, place)) in enumerate(old):
        contact.a[k], contact.b[k], contact.feature[k], contact.point[k, 0] = (
            handles[x],
            handles[y],
            feature,
            FAR * place,
        )
    before = {}
    for name in (*HELD, *CARRIED):
        column = getattr(contact, name)
        column[:] = (1 + np.arange(column.size)).reshape(column.shape) % (2 if column.dtype == np.bool_ else room + 999)
        before[name] = column.copy()
    found = Found.room(count)
    for k, ((x, y), (feature, place)) in enumerate(now):
        found.row_a[k], found.row_b[k], found.feature[k], found.point[k] = x, y, feature, (FAR * place, 0.0, 0.0)
        found.normal[k], found.depth[k], found.by_fcl[k] = (k, 0.0, 1.0), k, k % 2
        found.old[k] = match[k] if (x, y) in renewal.recycled else -1
    stays, told = found.old >= 0, ("row_a", "row_b", "feature", "normal", "depth", "point", "by_fcl")
    for name in told:  # the table holds what is found of those recycled
        getattr(contact, name)[match[stays]] = getattr(found, name)[stays]
    matched, pool = np.empty(count, np.int64), Threads()
    with pool:
        crew = pool.call(threads) if threads > 1 else ALONE
        changed = np.zeros(threads_of(crew), np.bool_)
        renew_contacts(
            crew, matched, np.zeros(len(old), np.bool_), changed, len(old), handles, SIMULATION.world.slots.row_shift,
            collider.bound_half, collider.bound_radius, *found, contact.a, contact.b, contact.feature,
            contact.row_a, contact.row_b, contact.by_fcl, contact.normal, contact.depth, contact.point,
            *(getattr(contact, name) for name in (*HELD, *CARRIED)),
        )  # fmt: skip
    assert matched.tolist() == match.tolist()
    assert changed.any() == (match.tolist() != list(range(count)))
    for name in HELD:
        column = getattr(contact, name)[:count]
        assert (column[match >= 0] == before[name][match[match >= 0]]).all()
        assert not column[match < 0].any()
    for name in CARRIED:
        assert (getattr(contact, name)[:count][stays] == before[name][match[stays]]).all()
    assert contact.a[:count].tolist() == handles[found.row_a].tolist()
    assert contact.b[:count].tolist() == handles[found.row_b].tolist()
    for name in told:
        assert (getattr(contact, name)[:count] == getattr(found, name)).all()
