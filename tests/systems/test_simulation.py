"""The simulation as a whole: its response, its clock, and what happens when a number is none."""

from __future__ import annotations

import math
import re
from itertools import cycle

import numpy as np
import pytest

from carom.ecs import NonFiniteError, Transform, state_hash
from carom.ecs.relations.impact import Impact
from carom.systems.progress import Progress
from carom.systems.simulation import Simulation

BALL = {"sphere": {"radius": 0.1}}


def thrown(**settings: object) -> Simulation:
    """Return a ball thrown over a plane, with nothing that loses energy."""
    simulation = Simulation(**settings)
    simulation.add(collider={"plane": {}}, material={"restitution": 1.0, "friction": 0.0})
    simulation.add(
        name="ball", collider=BALL, body={}, transform={"position": (0.0, 1.0, 0.0)}, motion={"linear": (2.0, 3.0, 0.0)}
    )
    return simulation


def test_reflect_leaves_no_resting_contact() -> None:
    """With ``response: reflect`` the resting stage never acts, though the ball bounces; with ``full`` it does."""
    ended = {}
    for response in ("reflect", "full"):
        simulation = Simulation(response=response)
        simulation.add(collider={"plane": {}}, material={"restitution": 0.5})
        simulation.add(collider=BALL, body={}, transform={"position": (0.0, 0.3, 0.0)}, material={"restitution": 0.5})
        rested, impacts = False, 0
        for _ in range(180):
            simulation.step()
            rested |= simulation.world[Progress].resting > 0
            impacts += simulation.world.count(Impact)
        ended[response] = (rested, impacts > 3)
    assert ended == {"reflect": (False, True), "full": (True, True)}


@pytest.mark.parametrize("rate", [30, 60, 144])
def test_the_frame_rate_changes_no_bit(rate: int) -> None:
    """Frames of 30, 60 or 144 per second, each up to 40 % early or late, lead to the arc of plain steps."""
    plain, shown = thrown(dt=1 / 120), thrown(dt=1 / 120)
    hashes = {0: state_hash(plain.world)}
    while plain.frame < 250:
        plain.step()
        hashes[plain.frame] = state_hash(plain.world)
    jitter = np.random.default_rng(rate).uniform(0.6, 1.4, 1000)
    passed = 0.0
    for late in cycle(jitter.tolist()):
        if passed > 2.0:
            break
        passed += late / rate
        part = shown.advance(late / rate)
        assert 0.0 <= part < 1.0
        assert (shown.frame + part) / 120 == pytest.approx(passed, abs=1e-9)
        assert state_hash(shown.world) == hashes[shown.frame]
    assert shown.frame >= 239


def test_a_slow_machine_falls_behind() -> None:
    """A frame of a second asks for 120 steps but gets 8; what is over is forgotten but for its part of a step."""
    simulation = thrown(dt=1 / 120)
    assert simulation.advance(1.0 + 0.25 / 120) == pytest.approx(0.25, abs=1e-9)
    assert simulation.frame == 8
    assert simulation.advance(0.5 / 120) == pytest.approx(0.75, abs=1e-9)
    assert simulation.frame == 8


@pytest.mark.parametrize(
    ("watched", "column", "by"),
    [
        (False, "Motion.linear", "found at the end of the step"),
        (True, "Force.force", "written by system 'broken'"),
    ],
)
def test_a_nan_names_where_it_came_from(watched: bool, column: str, by: str) -> None:
    """A force of NaN in frame 4 is told with frame, column and entity; a watched simulation also names the system."""
    simulation = thrown()
    simulation.watched = watched
    simulation.force_function(
        lambda world, rows: np.full((len(rows), 3), math.nan if world.frame == 4 else 0.0), name="broken"
    )
    simulation.step(3)
    message = f"frame 4: {column} of entity 'ball' is [nan, nan, nan], {by}"
    with pytest.raises(NonFiniteError, match=f"^{re.escape(message)}$"):
        simulation.step()


@pytest.mark.parametrize("collision", ["auto", "fcl"])
def test_a_stack_of_three_boxes_stays_put(collision: str) -> None:
    """For 5 s no box moves by more than 1 mm or turns by more than 0.1 degrees."""
    simulation = Simulation(collision=collision)
    simulation.add(collider={"plane": {}})
    for k in range(3):
        simulation.add(
            collider={"box": {"size": (1.0, 1.0, 1.0)}}, body={}, transform={"position": (0.1 * k, 0.5 + k, 0.0)}
        )
    begun = simulation.world[Transform].position[:4].copy()
    for _ in range(300):
        simulation.step()
        transform = simulation.world[Transform]
        assert np.abs(transform.position[:4] - begun).max() < 1e-3
        assert np.abs(transform.rotation[:4, :3]).max() < math.radians(0.1) / 2.0
