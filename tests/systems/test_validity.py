"""Validity: whoever measured it, no impossible point reaches the solver; it is counted, and named in checked mode."""

from __future__ import annotations

from functools import partial
from typing import Any

import numpy as np
import pytest
from faults import error

from carom.ecs.relations.contact import Contact
from carom.systems.detection import fcl_pairs, narrow
from carom.systems.detection.answered import Answered
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
