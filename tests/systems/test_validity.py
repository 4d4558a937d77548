"""Validity: whoever measured it, no impossible point reaches the solver; it is counted, and named in checked mode."""

from __future__ import annotations

from contextlib import nullcontext
from functools import partial
from typing import Any

import numba
import numpy as np
import pytest
from crews import gathered
from faults import error

from carom.ecs import Collider
from carom.ecs.relations.contact import Contact
from carom.systems.detection import fcl_pairs, narrow
from carom.systems.detection.answered import Answered
from carom.systems.detection.bounds import reach_within
from carom.systems.detection.validity import ContactError
from carom.systems.kernels.crew import ALONE
from carom.systems.simulation import Simulation

WRONG: list[tuple[dict[str, Any], str]] = [
    ({"depth": np.nan}, "its numbers are not finite"),
    ({"depth": np.inf}, "its numbers are not finite"),
    ({"point": (np.inf, -np.inf, 0.0)}, "its numbers are not finite"),
    ({"normal": (0.0, 0.0, 0.0)}, "its normal has the length 0; accepted: 1 within 1e-06"),
    ({"normal": (0.0, 1.00001, 0.0)}, "its normal has the length 1.00001; accepted: 1 within 1e-06"),
    ({"depth": 1.1}, "its depth is 1.1 m; accepted: at most 0.010001 m, which the two sizes allow"),
    ({"depth": -0.4}, "its gap is 0.4 m; accepted: at most 0.00640726 m, which the step can close"),
]
SOUND: dict[str, Any] = {"normal": (0.0, 1.0, 0.0), "depth": 0.01, "point": (0.0, 0.0, 0.0)}
ENDS: list[dict[str, Any]] = [{}, {"depth": 0.010001}, {"depth": -0.0064}, {"normal": (0.0, 1.0 + 5e-7, 0.0)}]


def ball_on_plane(collision: str = "auto") -> Simulation:
    """Return a ball that is named, one cm deep in a half space that is not."""
    simulation = Simulation(collision=collision, checked=False)
    simulation.add(collider={"plane": {}})
    place = {"position": (0.0, 0.49, 0.0)}
    simulation.add(name="ball", collider={"sphere": {"radius": 0.5}}, body={"mass": 1.0}, transform=place)
    return simulation


def answer(monkeypatch: pytest.MonkeyPatch, **changed: Any) -> None:
    """Let kernels and FCL answer a point that lies on the ball, with something changed."""
    normal, depth, place = (SOUND | changed).values()

    def by_kernel(crew: Any, which: Any, *arrays: Any) -> int:
        start, count, feature, normals, depths, points = arrays[-6:]
        start[which[0]], count[which[0]], feature[0] = 0, 1, 0
        normals[0], depths[0], points[0] = normal, depth, place
        return 1

    monkeypatch.setattr(narrow, "FUNCTIONS", [by_kernel] * len(narrow.FUNCTIONS))
    monkeypatch.setattr(fcl_pairs, "refine_answers", partial(by_kernel, ALONE))


@pytest.mark.parametrize("collision", ["auto", "fcl"])
@pytest.mark.parametrize(("changed", "fault"), WRONG)
def test_an_impossible_point_is_dropped_and_counted(
    changed: dict[str, Any], fault: str, collision: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The solver sees nothing of it; in checked mode the error names the pair, what is wrong and what is accepted."""
    simulation = ball_on_plane(collision)
    answer(monkeypatch, **changed)
    simulation.step()
    assert simulation.world.count(Contact) == 0
    assert simulation.world[Answered].refused == 1
    simulation = ball_on_plane(collision)
    simulation.checked = True
    message = (
        f"a contact of plane '[0]' and sphere 'ball' cannot be: {fault}; "
        "please report it with the world file, unchecked runs leave it out"
    )
    with error(ContactError, message):
        simulation.step()


@pytest.mark.parametrize("changed", ENDS)
def test_a_possible_point_is_kept(changed: dict[str, Any], monkeypatch: pytest.MonkeyPatch) -> None:
    """Up to the very ends of what is accepted."""
    simulation = ball_on_plane()
    answer(monkeypatch, **changed)
    simulation.checked = True
    simulation.step()
    assert simulation.world.count(Contact) == 1
    assert simulation.world[Answered].refused == 0


def test_no_depth_that_two_shapes_can_have_is_refused() -> None:
    """Balls anywhere in boxes, boxes in each other, and all of them far below a half space."""
    generator = np.random.default_rng(4)
    simulation = Simulation(gravity=(0.0, 0.0, 0.0), checked=True)
    simulation.add(collider={"plane": {"offset": 50.0}})
    for shape in (
        {"sphere": {"radius": 0.5}},
        {"box": {"size": (4.0, 4.0, 4.0)}},
        {"capsule": {"radius": 0.2, "length": 2.0}},
    ):
        for place in generator.uniform(-1.5, 1.5, (8, 3)):
            simulation.add(collider=shape, body={"mass": 1.0}, transform={"position": place})
    simulation.step()
    assert simulation.world.count(Contact) > 100
    assert simulation.world[Answered].refused == 0


@pytest.mark.skipif(bool(numba.config.DISABLE_JIT), reason="kernels are not shared without the JIT")
@pytest.mark.parametrize("parts", [1, 2, 3])
def test_threads_leave_out_the_same_without_gaps(parts: int, monkeypatch: pytest.MonkeyPatch) -> None:
    """Of boxes in a half space all points are found but those that somebody spoils, whoever collects them."""
    simulation = Simulation(gravity=(0.0, 0.0, 0.0), checked=False)
    simulation.add(collider={"plane": {}})
    for x in range(40):
        simulation.add(
            collider={"box": {"size": (1.0, 1.0, 1.0)}}, body={}, transform={"position": (2.0 * x, 0.4, 0.0)}
        )
    world = simulation.world
    rows = world.row_numbers(Collider)
    pairs = np.stack([np.full(40, rows[0]), rows[1:]], axis=1)

    def spoilt(row: Any, feature: Any) -> Any:
        return (7 * row + feature) % 3 == 0

    def spoiling(measure: Any, crew: Any, which: Any, *arrays: Any) -> None:
        measure(crew, which, *arrays)
        start, count, feature, _, depths, _ = arrays[-6:]
        for p in which:
            those = slice(start[p], start[p] + count[p])
            depths[those][spoilt(pairs[p, 1], feature[those])] = np.nan

    with world.faces(None), gathered(parts) if parts > 1 else nullcontext(ALONE) as crew:
        reach_within(world, 0.0)
        monkeypatch.setattr(narrow, "crew_for", lambda world, count: crew)
        whole = narrow.measure_pairs(world, pairs, np.ones(40))
        assert len(whole.row_b) == 160
        monkeypatch.setattr(narrow, "FUNCTIONS", [partial(spoiling, measure) for measure in narrow.FUNCTIONS])
        found = narrow.measure_pairs(world, pairs, np.ones(40))
    sound = ~spoilt(whole.row_b, whole.feature)
    assert 40 < sound.sum() < 120
    assert world[Answered].refused == 160 - sound.sum()
    for column, wanted in zip(found, whole.take(sound), strict=True):
        assert np.array_equal(column, wanted)


def test_the_first_of_several_faults_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    """Of two points of one pair that cannot be, each for a reason of its own; unchecked, both are counted."""

    def by_kernel(crew: Any, which: Any, *arrays: Any) -> None:
        start, count, feature, normals, depths, points = arrays[-6:]
        start[which[0]], count[which[0]], feature[:2], normals[:2], points[:2] = 0, 2, (0, 1), (0.0, 1.0, 0.0), 0.0
        depths[:2] = 1.1, np.nan

    monkeypatch.setattr(narrow, "FUNCTIONS", [by_kernel] * len(narrow.FUNCTIONS))
    simulation = ball_on_plane()
    simulation.step()
    assert simulation.world[Answered].refused == 2
    message = (
        f"a contact of plane '[0]' and sphere 'ball' cannot be: {WRONG[5][1]}; "
        "please report it with the world file, unchecked runs leave it out"
    )
    simulation = ball_on_plane()
    simulation.checked = True
    with error(ContactError, message):
        simulation.step()
