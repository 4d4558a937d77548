"""Crowds that go one way meet whom they would meet, exactly, and cost as much as where they rest."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from onlookers import looked_on

from carom.ecs import ColliderPose, Motion, RigidBody, Transform
from carom.ecs.column import Floats
from carom.ecs.components.flight import Flight
from carom.ecs.relations.contact import Contact
from carom.systems.detection.answered import Answered
from carom.systems.detection.bounds import reach_within
from carom.systems.detection.broad import overlapping
from carom.systems.detection.leaving import detection_holds
from carom.systems.detection.why import why_no_contact
from carom.systems.simulation import Simulation
from carom.systems.stream import Stream

SIDE, SPEED, RADIUS = 8, 50.0, 0.1
HARD = {"restitution": 1.0, "friction": 0.0}
WALL = {"box": {"size": (1.0, 40.0, 40.0)}}
#: What stands where its surface is at x = 0, and sees the crowd come along x.
STANDS: dict[str, dict[str, Any]] = {
    "box": {"collider": WALL, "transform": {"position": (0.5, 0.0, 0.0)}},
    "half space": {"collider": {"plane": {"normal": (-1.0, 0.0, 0.0)}}},
    "kinematic": {"collider": WALL, "transform": {"position": (0.5, 0.0, 0.0)}, "body": {"type": "kinematic"}},
}


def crowd(front: float, back: float) -> Simulation:
    """Return balls that fly along x, from places so far (m) from where x is 0, and nothing else."""
    simulation, random = Simulation(gravity=(0.0, 0.0, 0.0)), np.random.default_rng(4)
    for j, k in np.ndindex(SIDE, SIDE):
        simulation.add(
            collider={"sphere": {"radius": RADIUS}}, body={"mass": 1.0}, material=HARD,
            transform={"position": (-RADIUS - random.uniform(front, back - 2.0 * RADIUS), 0.5 * j, 0.5 * k)},
            motion={"linear": (SPEED, 0.0, 0.0)},
        )  # fmt: skip
    return simulation


@pytest.mark.parametrize("seen", [False, True])
@pytest.mark.parametrize("stands", STANDS)
def test_each_of_a_crowd_bounces_when_it_comes(stands: str, seen: bool) -> None:
    """As one alone does, in the middle of a step and one before the other."""
    simulation = crowd(1.0, 5.0)
    looked_on(simulation, seen)
    simulation.add(material=HARD, **STANDS[stands])
    rows = np.arange(SIDE * SIDE)
    begun = simulation.world[Transform].position[rows].copy()
    simulation.step()
    assert simulation.world[Stream].passes == pytest.approx(SPEED / 60.0, rel=0.02)
    simulation.step(9)
    way = begun[:, 0] + RADIUS + SPEED * simulation.time
    expected = np.where(way > 0.0, -way, way) - RADIUS
    assert simulation.world[Transform].position[rows, 0] == pytest.approx(expected, abs=1e-9)
    assert (simulation.world[Transform].position[rows, 1:] == begun[:, 1:]).all()


@pytest.mark.parametrize("seen", [False, True])
@pytest.mark.parametrize("number", [2, SIDE * SIDE])
def test_those_who_are_struck_meet_all_that_they_come_to(number: int, seen: bool) -> None:
    """Each of some bounces between two posts, several times in a step, while the others go on or do so too."""
    gap = 0.5
    simulation = crowd(0.01, gap)
    looked_on(simulation, seen)
    rows = np.arange(SIDE * SIDE)
    begun = simulation.world[Transform].position[rows].copy()
    for row in rows[:number]:
        for x in (0.5, -gap - 0.5):
            place = x, *begun[row, 1:]
            simulation.add(
                collider={"box": {"size": (1.0, 0.3, 0.3)}}, material=HARD, transform={"position": place}
            )  # fmt: skip
    simulation.step(5)
    free, flown = gap - 2.0 * RADIUS, SPEED * simulation.time
    way = (begun[:number, 0] + gap - RADIUS + flown) % (2.0 * free)
    expected = np.minimum(way, 2.0 * free - way) - gap + RADIUS
    assert simulation.world[Transform].position[rows[:number], 0] == pytest.approx(expected, abs=1e-9)
    others = rows[number:]
    assert simulation.world[Transform].position[others, 0] == pytest.approx(begun[others, 0] + flown, abs=1e-9)


def rows_of_balls(lanes: int, others: int, seen: bool) -> Floats:
    """Return where balls are (m) that fly one behind the other at a post each, four in a lane, after three steps."""
    simulation, random = Simulation(gravity=(0.0, 0.0, 0.0)), np.random.default_rng(7)
    looked_on(simulation, seen)
    ball = {"collider": {"sphere": {"radius": RADIUS}}, "body": {"mass": 1.0}, "material": HARD}
    gaps = random.uniform(0.25, 0.6, (7, 4))
    for lane in range(lanes):
        for place in -RADIUS - np.cumsum(gaps[lane]):
            simulation.add(
                transform={"position": (place, 0.0, 0.7 * lane)}, motion={"linear": (SPEED, 0.0, 0.0)}, **ball
            )  # fmt: skip
    for lane in range(lanes):
        post = {"box": {"size": (1.0, 0.3, 0.3)}}
        simulation.add(collider=post, material=HARD, transform={"position": (0.5, 0.0, 0.7 * lane)})
    for k in range(others):
        simulation.add(
            transform={"position": (0.0, 1.0 + 0.3 * (k // 20), 0.3 * (k % 20))}, motion={"linear": (SPEED, 0.0, 0.0)},
            **ball,
        )  # fmt: skip
    simulation.step(3)
    return simulation.world[Transform].position[: 4 * lanes].copy()


@pytest.mark.parametrize("seen", [False, True])
@pytest.mark.parametrize("lanes", [1, 7])
def test_those_who_are_struck_meet_those_who_come_behind(lanes: int, seen: bool) -> None:
    """In the middle of a step, as where there is no stream from which they reached no farther than the others."""
    alone = rows_of_balls(lanes, 0, seen)
    assert rows_of_balls(lanes, 400, seen) == pytest.approx(alone, abs=1e-9)
    assert alone[:, 0].max() < -RADIUS + 1e-9


def dropped(rows: range, seen: bool) -> Floats:
    """Return where balls are (m) that fall onto a half space and bounce, after three seconds."""
    simulation, random = Simulation(dt=1.0 / 60.0), np.random.default_rng(5)
    looked_on(simulation, seen)
    simulation.add(collider={"plane": {}}, material=HARD)
    heights = random.uniform(40.0, 44.0, SIDE * SIDE)
    for k in rows:
        simulation.add(
            collider={"sphere": {"radius": RADIUS}}, body={"mass": 1.0}, material=HARD,
            transform={"position": (0.5 * (k % SIDE), heights[k], 0.5 * (k // SIDE))},
        )  # fmt: skip
    simulation.step(190)
    return simulation.world[Transform].position[1 : 1 + len(rows)].copy()


@pytest.mark.parametrize("seen", [False, True])
def test_a_crowd_falls_as_each_alone(seen: bool) -> None:
    """Though it comes to be a stream, and faster in every step."""
    few = range(0, SIDE * SIDE, 16)
    assert dropped(range(SIDE * SIDE), seen)[few] == pytest.approx(dropped(few, seen), abs=1e-9)


def test_a_crowd_wakes_who_sleeps_where_it_comes() -> None:
    """And bounces when it comes there."""
    simulation = Simulation(sleeping=True)
    world, block = simulation.world, {"box": {"size": (6.0, 6.0, 6.0)}}
    wall = simulation.add(collider=block, material=HARD, body={"mass": 1e9}, transform={"position": (3.0, 1.75, 1.75)})
    simulation.add(collider=block, transform={"position": (3.0, -4.25, 1.75)})
    simulation.step(60)
    assert world[Motion].asleep[world.row(wall)]
    for k in range(SIDE * SIDE):
        simulation.add(
            collider={"sphere": {"radius": RADIUS}}, body={"mass": 1.0}, material=HARD,
            transform={"position": (-2.5, 0.5 * (k % SIDE), 0.5 * (k // SIDE))}, motion={"linear": (SPEED, 0.0, 0.0)},
        )  # fmt: skip
    simulation.step(2)
    assert world[Motion].asleep[world.row(wall)]
    assert world[Stream].passes > 0.5
    simulation.step(2)
    assert not world[Motion].asleep[world.row(wall)]
    balls = world.row_numbers(RigidBody)
    bounced = 2.5 - 2.0 * RADIUS - SPEED * 4.0 / 60.0
    assert world[Transform].position[balls[balls != world.row(wall)], 0] == pytest.approx(bounced, abs=1e-6)


@pytest.mark.parametrize("seen", [False, True])
@pytest.mark.parametrize("along", [(0.0, 0.0, 0.0), (200.0, 0.0, 0.0), (0.0, 60.0, 40.0)])
def test_a_pile_in_a_train_costs_what_it_does_at_rest(along: tuple[float, float, float], seen: bool) -> None:
    """At 200 m/s it had 26 times as many contacts, and was detected in each substep."""
    simulation = Simulation(sleeping=False)
    looked_on(simulation, seen)
    rides: dict[str, Any] = {"body": {"type": "kinematic"}, "motion": {"linear": along}}
    simulation.add(collider={"box": {"size": (5.0, 1.0, 5.0)}}, transform={"position": (0.0, -0.5, 0.0)}, **rides)
    for k in range(100):
        place = 0.55 * (k % 5) - 1.1, 0.3 + 0.52 * (k // 25), 0.55 * (k // 5 % 5) - 1.1
        simulation.add(
            collider={"box": {"size": (0.5, 0.5, 0.5)}}, body={}, transform={"position": place},
            motion={"linear": along},
        )  # fmt: skip
    simulation.step(120)
    world = simulation.world
    before = world[Answered].detections
    simulation.step(30)
    assert world[Answered].detections - before == 30
    assert world[Contact].count == 400
    rows = world.row_numbers(RigidBody)
    assert np.abs(world[Motion].linear[rows] - along).max() < 1e-3


def test_half_spaces_are_known_once_the_crowd_is_fast_enough_for_them() -> None:
    """Though nobody has left the bounds by which pairs were found."""
    simulation = Simulation()
    simulation.add(collider={"plane": {}})
    simulation.add(collider={"sphere": {"radius": RADIUS}}, body={}, transform={"position": (0.0, 5.0, 0.0)})
    simulation.step()
    world = simulation.world
    with world.faces(None):
        assert len(overlapping(world)) == 0
        world[Stream].passes = 6.0
        assert overlapping(world).tolist() == [[0, 1]]


def test_who_is_struck_is_bounded_as_where_the_stream_came_from() -> None:
    """As the bounds of the others are, who go on."""
    simulation = crowd(1.0, 5.0)
    world, span = simulation.world, 0.004
    simulation.step()
    with world.faces(None):
        reach_within(world, 1.0 / 60.0)
        flight, stream = world[Flight], world[Stream]
        assert stream.motion[0] == pytest.approx([SPEED, 0.0, 0.0])
        flown = span * stream.motion[0]
        flight.center[: SIDE * SIDE] += flown
        world[Transform].position[: SIDE * SIDE] += flown
        stream.motion[1] += stream.motion[0] * span
        world[Motion].linear[7] = 0.0
        assert detection_holds(world, span)
        pose = world[ColliderPose]
        assert 0.5 * (pose.lower[7] + pose.upper[7]) == pytest.approx(flight.center[7] - flown, abs=1e-12)
        assert flight.detected_center[7] == pytest.approx(flight.center[7] - flown, abs=1e-12)


def test_asking_why_two_do_not_touch_leaves_the_stream_as_it_is() -> None:
    """How far it went is not told twice."""
    simulation = crowd(1.0, 5.0)
    simulation.step()
    stream = simulation.world[Stream]
    before = stream.motion.tolist(), stream.gone.tolist(), stream.passes
    assert stream.motion.any(axis=1).all()
    why_no_contact(simulation, *simulation.world.entities(np.arange(2)).tolist())
    assert (stream.motion.tolist(), stream.gone.tolist(), stream.passes) == before
