"""Contacts of balls alone are found at once, as all that measure and collect find them, and placed where they lie."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import nullcontext

import numba
import numpy as np
import pytest
from crews import gathered

from carom.ecs import Collider, ColliderPose, World
from carom.ecs.column import Floats, Integers
from carom.ecs.components.flight import Flight
from carom.ecs.relations.contact import Contact
from carom.systems.constants import REACH_KEPT
from carom.systems.detection import narrow, recycling
from carom.systems.detection.answered import Answered
from carom.systems.detection.bounds import reach_within
from carom.systems.detection.contacts import fill, store
from carom.systems.detection.narrow import Found, measure_pairs
from carom.systems.detection.recycling import Complete, Kept, find_balls, in_table, measure_what_moved
from carom.systems.kernels.crew import ALONE
from carom.systems.resting import Resting
from carom.systems.simulation import Simulation

COUNT = 40
SHARED = pytest.mark.skipif(bool(numba.config.DISABLE_JIT), reason="kernels are not shared without the JIT")


@pytest.fixture(params=[1, pytest.param(2, marks=SHARED), pytest.param(3, marks=SHARED)])
def crowd(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> Iterator[tuple[World, Integers, Floats]]:
    """Yield balls and points among boxes and a half space, a capsule far off, all pairs and how far each reaches."""
    generator = np.random.default_rng(3)
    simulation = Simulation(checked=False)
    simulation.add(collider={"plane": {}})
    places = generator.uniform(-0.8, 0.8, (COUNT, 3))
    turn = (0.5, 0.1, 0.5, 0.7)
    for number, place in enumerate(places):
        if number % 13 == 6:
            simulation.add(collider={"box": {"size": (0.7, 0.5, 0.9)}}, transform={"position": place, "rotation": turn})
            continue
        shape = {"point": {}} if number % 8 == 3 else {"sphere": {"radius": 0.1 + 0.004 * number}}
        simulation.add(collider=shape, body={"mass": 1.0}, transform={"position": place})
    capsule = {"capsule": {"radius": 0.1, "length": 1.0}}
    simulation.add(collider=capsule, body={}, transform={"position": (9.0, 9.0, 9.0)})
    world = simulation.world
    rows = world.row_numbers(Collider)
    balls = np.isin(world[Collider].shape, [world[Collider].shape[rows[1]], world[Collider].shape[rows[4]]])
    pairs = np.array([(a, b) for a in rows[:-1] for b in rows[:-1] if a < b and (balls[a] or balls[b])])
    with world.faces(None), gathered(request.param) if request.param > 1 else nullcontext(ALONE) as crew:
        reach_within(world, 0.0)
        for module in (narrow, recycling):
            monkeypatch.setattr(module, "crew_for", lambda world, count: crew)
        yield world, pairs, generator.uniform(0.0, 0.3, len(pairs))


def table(world: World) -> Found:
    """Return a copy of what the contact table has of what is found."""
    count = world[Contact].count
    return Found(*(column[:count].copy() for column in in_table(world[Contact])), np.arange(count))


def are_the_same(found: Found | None, wanted: Found) -> bool:
    """Tell whether all columns are, to the last bit, but for where contacts were before."""
    return found is not None and all(
        one.tobytes() == other.tobytes() for one, other in zip(found[:-1], wanted[:-1], strict=True)
    )


def shift(world: World, row: int) -> None:
    """Move a ball and its body by a little."""
    for places in (world[ColliderPose].position, world[Flight].detected_center):
        places[row] += 1e-9


def place_of(found: Found, k: int, pairs: Integers) -> int:
    """Return which pair a contact is of."""
    return int(np.argmax((pairs == (found.row_a[k], found.row_b[k])).all(axis=1)))


def test_they_are_found_as_they_are_measured(crowd: tuple[World, Integers, Floats]) -> None:
    """To the last bit, and in the same order; nothing is written into the table."""
    world, pairs, reaches = crowd
    wanted = measure_pairs(world, pairs, reaches)
    assert len(wanted.row_a) > 3 * COUNT
    before = world[Answered].kernels
    found = find_balls(world, pairs, reaches)
    assert world[Answered].kernels - before == len(pairs)
    assert are_the_same(found, wanted)
    assert found is not None
    assert type(found) is Found
    assert (found.old == -1).all()
    assert world[Contact].count == 0


def test_what_the_table_holds_is_placed_in_it(crowd: tuple[World, Integers, Floats]) -> None:
    """All of them, moved on by a little; one that is no more leaves the table as it is, and so does one that comes."""
    world, pairs, reaches = crowd
    store(world, measure_pairs(world, pairs, reaches), 0.0)
    count, held = world[Contact].count, table(world)
    shift(world, pairs[0, 1])
    wanted = measure_pairs(world, pairs, reaches)
    assert not are_the_same(held, wanted)
    for some in (wanted.row_a[0], wanted.row_b[0]), (wanted.row_a[-1], wanted.row_b[-1]):
        others = (pairs != some).any(axis=1)
        fewer = find_balls(world, pairs[others], reaches[others])
        assert are_the_same(fewer, measure_pairs(world, pairs[others], reaches[others]))
        assert not isinstance(fewer, Kept)
        assert are_the_same(table(world), held)
    found = find_balls(world, pairs, reaches)
    assert isinstance(found, Kept)
    assert found.old.tolist() == list(range(count))
    assert are_the_same(found, wanted)
    assert are_the_same(table(world), wanted)
    shift(world, pairs[0, 1])
    store(world, measure_pairs(world, pairs[others], reaches[others]), 0.0)
    held = table(world)
    more = find_balls(world, pairs, reaches)
    assert are_the_same(more, measure_pairs(world, pairs, reaches))
    assert not isinstance(more, Kept)
    assert are_the_same(table(world), held)


def test_what_the_table_holds_stays_until_it_is_farther(crowd: tuple[World, Integers, Floats]) -> None:
    """By a quarter of what both reach, else contacts of what lies would come and go; others do not come."""
    world, pairs, reaches = crowd
    wanted = measure_pairs(world, pairs, reaches)
    store(world, wanted, 0.0)
    less = reaches / 1.2
    assert len(measure_pairs(world, pairs, less).row_a) < len(wanted.row_a)
    assert are_the_same(find_balls(world, pairs, less), wanted)
    less = reaches / 1.5
    farther = measure_pairs(world, pairs, REACH_KEPT * less)
    assert len(measure_pairs(world, pairs, less).row_a) < len(farther.row_a) < len(wanted.row_a)
    assert are_the_same(find_balls(world, pairs, less), farther)
    gone = next(k for k, depth in enumerate(farther.depth) if -depth > less[place_of(farther, k, pairs)])
    others = np.arange(len(farther.row_a)) != gone
    store(world, farther.take(others), 0.0)
    assert are_the_same(find_balls(world, pairs, less), farther.take(others))


def test_it_stays_as_long_whoever_finds_it(
    crowd: tuple[World, Integers, Floats], monkeypatch: pytest.MonkeyPatch
) -> None:
    """What follows does not hang on whether somebody knows that all contacts are of balls, as after a snapshot."""
    world, pairs, reaches = crowd
    store(world, measure_pairs(world, pairs, reaches), 0.0)
    wanted = find_balls(world, pairs, reaches / 1.5)
    assert wanted is not None
    assert not isinstance(wanted, Kept)
    monkeypatch.setattr(recycling, "find_balls", lambda *arguments: None)
    assert are_the_same(measure_what_moved(world, pairs, reaches / 1.5), wanted)


def test_what_follows_from_where_they_are_is_there(crowd: tuple[World, Integers, Floats]) -> None:
    """As it is of what is found anew, to the last bit; not where a surface runs, or a ball rolls about no centre."""
    world, pairs, reaches = crowd
    contact, columns = world[Contact], ("offset_a", "offset_b", "share")
    store(world, measure_pairs(world, pairs, reaches), 0.0)
    shift(world, pairs[0, 1])
    found = find_balls(world, pairs, reaches)
    assert isinstance(found, Complete)
    placed = [getattr(contact, name)[: contact.count].copy() for name in columns]
    assert np.unique(placed[2]).tolist() == [0.0, 0.5, 1.0]
    assert fill(world, Kept(*found), contact.count, 0.0, known=True)
    for name, column in zip(columns, placed, strict=True):
        assert getattr(contact, name)[: contact.count].tobytes() == column.tobytes()
    world[Resting].belts = True
    found = find_balls(world, pairs, reaches)
    assert isinstance(found, Kept)
    assert not isinstance(found, Complete)
    world[ColliderPose].position[pairs[0, 1]] += 1e-9
    assert are_the_same(find_balls(world, pairs, reaches), measure_pairs(world, pairs, reaches))
    assert not isinstance(find_balls(world, pairs, reaches), Kept)


@pytest.mark.parametrize("fault", ["feature", "by_fcl", "a", "b"])
def test_what_the_table_holds_otherwise_is_not(fault: str, crowd: tuple[World, Integers, Floats]) -> None:
    """Points of another feature, of FCL, or of somebody else in that row are others."""
    world, pairs, reaches = crowd
    store(world, measure_pairs(world, pairs, reaches), 0.0)
    getattr(world[Contact], fault)[world[Contact].count // 2] += 1
    found = find_balls(world, pairs, reaches)
    assert are_the_same(found, measure_pairs(world, pairs, reaches))
    assert not isinstance(found, Kept)


def test_others_have_to_see_to_what_is_unsound_or_no_ball(crowd: tuple[World, Integers, Floats]) -> None:
    """A pose that is not finite, a normal that is not of length 1, a capsule: the table stays as it is."""
    world, pairs, reaches = crowd
    store(world, measure_pairs(world, pairs, reaches), 0.0)
    held, pose, before = table(world), world[ColliderPose], world[Answered].kernels
    capsule = np.array([(pairs[-1, 1], world.row_numbers(Collider)[-1])])
    assert find_balls(world, np.concatenate([pairs, capsule]), np.append(reaches, 0.0)) is None
    for column, row, value in ((pose.position, pairs[-1, 1], np.nan), (pose.rotation, 7, 1.1)):
        was = column[row].copy()
        column[row] *= value
        assert find_balls(world, pairs, reaches) is None
        column[row] = was
    assert are_the_same(table(world), held)
    assert world[Answered].kernels == before
