"""The bench of contacts gives every engine the same scene and measures what became of it by closed forms."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from carom.ecs.spatial import quaternion
from carom.tools.bench import contact_scenes, contacts, race
from carom.tools.bench.contact_scenes import Scene, at_rest, bin_walls
from carom.tools.bench.contacts import ROWS, Row, compare, quality
from carom.tools.bench.engines import Carom, rotation_vector
from carom.tools.bench.measure import Timing
from carom.tools.bench.overlap import box_overlap, lost, mean_overlap
from carom.tools.bench.race import settled, stepped


@pytest.mark.parametrize(
    ("name", "count"),
    [
        ("sphere_pile_1000", 1000), ("sphere_pile_10000", 10_000), ("box_pile_1000", 1000), ("box_pile_4000", 4000),
        ("pyramid_40", 820), ("terrain_500", 500), ("free_flight_10000", 10_000),
    ],
)  # fmt: skip
def test_scenes_begin_apart_and_within_bounds(name: str, count: int) -> None:
    """As many bodies as told, none of them lost, and none in another; made again they are the same."""
    scene, again = ROWS[name].scene(), ROWS[name].scene()
    assert scene.count == count
    assert lost(scene, scene.position) == 0
    if scene.land is None:
        assert mean_overlap(scene, scene.position, scene.rotation) == 0.0
    for column in ("half", "position", "rotation", "linear", "angular"):
        assert np.array_equal(getattr(scene, column), getattr(again, column))
        assert getattr(scene, column).dtype == np.float64


def test_the_overlap_of_balls_is_that_of_all_pairs_that_overlap() -> None:
    """Two by 2 mm, one with the floor by 4 mm and with a wall by 3 mm: 3 mm; what is apart does not count."""
    scene = at_rest(
        1, np.array([[0.0, 0.0, 0.5], [0.998, 0.0, 3.0], [0.0, 4.503, 0.496], [0.0, 0.0, 3.0]]), 0.5, ball=True
    )
    scene.walls = bin_walls(10.0, 5.0)
    assert mean_overlap(scene, scene.position, scene.rotation) == pytest.approx(0.003, abs=1e-12)


def test_boxes_overlap_by_the_best_of_their_axes() -> None:
    """Face on face, edge on face, and edges crossed, each in closed form; apart is negative."""
    cube = np.full(3, 0.5)
    level, tilted = np.eye(3), quaternion.matrix(quaternion.from_axis_angle((1.0, 0.0, 0.0), math.pi / 4.0))
    crossed = quaternion.matrix(quaternion.from_axis_angle((0.0, 1.0, 0.0), math.pi / 4.0))
    edge = math.sqrt(0.5)
    cases = [
        (level, level, 0.99),
        (level, level, 1.02),
        (level, tilted, 0.5 + edge - 0.03),
        (tilted, crossed, 2.0 * edge - 0.01),
    ]
    position = np.array([[(0.0, 0.0, 0.0), (0.0, 0.0, away)] for _, _, away in cases])
    turn = np.array([(one, other) for one, other, _ in cases])
    depth = box_overlap(position, turn, np.broadcast_to(cube, (4, 2, 3)))
    assert depth == pytest.approx([0.01, -0.02, 0.03, 0.01], abs=1e-12)


def test_what_goes_through_a_wall_or_the_land_is_lost() -> None:
    """A quarter of a metre beyond, half a metre below, or nowhere."""
    scene = at_rest(1, np.zeros((4, 3)), 0.1)
    scene.walls = bin_walls(10.0, 5.0)
    assert lost(scene, np.array([[0, 0, -0.2], [0, 0, -0.3], [5.3, 0, 1.0], [np.nan, 0, 0]])) == 3
    hills = contact_scenes.terrain(500)
    assert lost(hills, np.array([[0.0, 0.0, -0.4], [0.0, 0.0, -0.6]])) == 1


def test_every_quaternion_has_its_axis_times_angle() -> None:
    """The shorter way round, and nothing for none."""
    axis = np.array([0.6, 0.0, 0.8])
    for sign in (1.0, -1.0):
        turn = sign * quaternion.from_axis_angle(axis, 2.0)
        assert rotation_vector(turn) == pytest.approx(2.0 * axis, abs=1e-15)
    assert rotation_vector(np.array([0.0, 0.0, 0.0, -1.0])).tolist() == [0.0, 0.0, 0.0]


def test_carom_is_given_the_scene() -> None:
    """Balls and boxes where, how and as fast as told; they fall along z by the parabola, and weigh by their volume."""
    scene = contact_scenes.free_flight(10)
    scene.ball[::2], scene.half[::2] = True, 0.2
    engine = Carom(scene, 1)
    position, rotation = engine.poses()
    assert np.array_equal(position, scene.position)
    assert rotation == pytest.approx(scene.rotation, abs=1e-15)
    for _ in range(30):
        engine.step()
    after, _ = engine.poses()
    drop = np.array([0.0, 0.0, -0.5 * 9.81 * 0.25])
    assert after == pytest.approx(scene.position + 0.5 * scene.linear + drop, abs=1e-12)


def test_engines_take_turns() -> None:
    """Ten steps each, so that what else the machine does meets all."""
    order: list[str] = []

    class Told:
        def __init__(self, name: str) -> None:
            self.name = name

        def step(self) -> None:
            order.append(self.name)

        def poses(self) -> Any:
            raise NotImplementedError

        def velocities(self) -> Any:
            raise NotImplementedError

    timings = stepped([Told("a"), Told("b")], 24)
    assert "".join(order) == "a" * 10 + "b" * 10 + "a" * 10 + "b" * 10 + "a" * 4 + "b" * 4
    assert [len(each) for each in timings] == [24, 24]


@pytest.mark.parametrize(("threads", "factor"), [(1, 2.0), (2, 1.0)])
def test_the_last_third_counts_and_the_whole_is_told(
    monkeypatch: pytest.MonkeyPatch, threads: int, factor: float
) -> None:
    """The median of the one, and the mean of all but the first step: of the processor, or on the wall."""
    timings = [Timing(float(k), 2.0 * k, 1) for k in (100, 7, 7, 7, 1, 4, 3, 5, 2)]
    assert settled(timings) == Timing(3.0, 6.0, 3)
    monkeypatch.setattr(race, "ENGINES", {"carom": Carom})
    monkeypatch.setattr(race, "stepped", lambda engines, steps: [timings])
    one, mean = race.race("one", at_rest(1, np.zeros((1, 3)), 0.5), (), 1.0, threads)
    assert (one.wall, one.cpu) == (3e3, 6e3)
    assert mean.wall == mean.cpu == factor * 4.5e3


def test_a_scene_is_told_with_its_bounds(monkeypatch: pytest.MonkeyPatch) -> None:
    """Times of both, their ratio with its bound, and the same quality of both; a peer's is not bounded."""

    def scene() -> Scene:
        made = at_rest(6, np.array([[0.0, 0.0, 0.498], [0.0, 0.0, 1.5]]), 0.5)
        made.walls = bin_walls(10.0, 5.0)
        return made

    monkeypatch.setattr(race, "ENGINES", {"carom": Carom, "json": Carom})  # a module that is always there
    monkeypatch.setattr(contacts, "PEERS", ("json",))
    monkeypatch.setitem(ROWS, "two", Row(scene, 4.0, overlap=0.003, drift=0.1))
    figures = list(compare("two"))
    assert [(figure.name, figure.unit, figure.bound) for figure in figures] == [
        ("two, carom", "ms a step", math.inf),
        ("two, json", "ms a step", math.inf),
        ("two, carom by json", "x", 4.0),
        ("two, carom, mean from the start", "ms a step", math.inf),
        ("two, json, mean from the start", "ms a step", math.inf),
        ("two, carom, mean overlap", "mm", 3.0),
        ("two, carom, farthest from its start", "m", 0.1),
        ("two, carom, lost", "bodies", 0.0),
        ("two, json, mean overlap", "mm", math.inf),
        ("two, json, farthest from its start", "m", math.inf),
        ("two, json, lost", "bodies", math.inf),
    ]
    assert figures[5].wall == figures[8].wall
    assert all(figure.holds for figure in figures[5:])


def test_a_lost_body_fails_the_bench() -> None:
    """The bound is none."""
    made = at_rest(1, np.array([[0.0, 0.0, -3.0]]), 0.5)
    made.walls = bin_walls(10.0, 5.0)
    (figure,) = quality("one", Row(lambda: made, 1.0), made, Carom(made, 1), bounded=True)
    assert not figure.holds
    assert str(figure).split() == ["FAILS", "one,", "lost", "1", "bodies", "at", "most", "0", "bodies"]
