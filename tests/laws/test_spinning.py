"""What turns about its own axis stays where it is: pencils that roll and tops that spin are not looked after."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from carom.ecs import Entity, Motion
from carom.ecs.spatial.quaternion import rotate
from carom.systems.detection.answered import Answered
from carom.systems.simulation import Simulation

G, UPRIGHT = 9.81, np.array([0.0, 1.0, 0.0])
RADIUS, LENGTH = 0.005, 0.18
PENCILS: dict[str, dict[str, Any]] = {
    "cylinder": {"cylinder": {"radius": RADIUS, "length": LENGTH}},
    "capsule": {"capsule": {"radius": RADIUS, "length": LENGTH}},
}
GROUNDS: dict[str, dict[str, Any]] = {
    "plane": {"collider": {"plane": {}}},
    "box": {"collider": {"box": {"size": (80.0, 1.0, 80.0)}}, "transform": {"position": (0.0, -0.5, 0.0)}},
    "height field": {"collider": {"height_field": {"heights": np.zeros((41, 41)).tolist(), "spacing": 2.0}}},
}


@pytest.mark.parametrize("speed", [0.3, 1.0])
@pytest.mark.parametrize("ground", GROUNDS)
@pytest.mark.parametrize("shape", PENCILS)
def test_a_pencil_rolls_straight_on_and_is_detected_once_a_step(shape: str, ground: str, speed: float) -> None:
    """At 200 rad/s its ends were taken to come 18 m/s near: it was detected 244 times in each step, 150 ms long."""
    simulation = Simulation(checked=False)
    simulation.add(**GROUNDS[ground])
    pencil = roll(simulation, shape, speed, lean=0.0)
    simulation.step(120)
    motion, position = simulation[pencil].motion, simulation[pencil].transform.position
    assert simulation.world[Answered].detections == 120
    assert motion.linear == pytest.approx((speed, 0.0, 0.0), abs=2e-6)
    assert position[2] == pytest.approx(0.0, abs=1e-6)


@pytest.mark.parametrize("shape", PENCILS)
@pytest.mark.parametrize(("speed", "grows"), [(0.1, 1.02), (0.3, 1.2), (1.0, 4.0)])
def test_one_that_leans_does_not_lean_more_and_more(shape: str, speed: float, grows: float) -> None:
    """It leans by a millionth, and goes aside as a cone does: its points go on with its axis, not as it turns about it.

    Else it leant 2.5 times as much in each step at 200 rad/s, and less and less at 60.
    """
    simulation = Simulation(checked=False)
    simulation.add(**GROUNDS["plane"])
    pencil = roll(simulation, shape, speed, lean=1e-6)
    simulation.step(60)
    leans = float(rotate(simulation[pencil].transform.rotation, UPRIGHT)[1])
    assert 1e-6 <= leans <= grows * 1e-6


def roll(simulation: Simulation, shape: str, speed: float, lean: float) -> Entity:
    """Add a pencil along z on the ground at y = 0 that rolls along x and leans (rad); who does is a bit inside that."""
    along_z = (np.sin(np.pi / 4 - lean / 2), 0.0, 0.0, np.cos(np.pi / 4 - lean / 2))
    depth = 1e-6 if lean else 0.0
    pencil = simulation.add(
        collider=PENCILS[shape], body={"mass": 0.01}, material={"friction": 0.5},
        transform={"position": (0.0, RADIUS - depth, 0.0), "rotation": along_z},
    )  # fmt: skip
    with simulation.world.edit(Motion) as motion:
        row = simulation.world.row(pencil)
        motion.linear[row] = speed, 0.0, 0.0
        motion.angular[row] = -speed / RADIUS * np.array([0.0, np.sin(lean), np.cos(lean)])
    return pencil


SPIN, TILT, HIGH, AROUND, ACROSS = 60.0, 0.3, 0.4, 0.08, 0.05
#: What tops stand on, and how far (m) around its end it reaches.
TIPS: dict[str, tuple[dict[str, Any], float]] = {
    "ball": ({"sphere": {"radius": 0.02}}, 0.02),
    "capsule": ({"capsule": {"radius": 0.02, "length": 0.1}}, 0.02),
    "hull": ({"convex": {"points": [(0, 0, 0), *((x, 0.2, z) for x in (-0.05, 0.05) for z in (-0.05, 0.05))]}}, 0.0),
}


@pytest.mark.parametrize("tip", TIPS)
@pytest.mark.parametrize("substeps", [4, 8])
def test_a_top_goes_round_as_theory_has_it(tip: str, substeps: int) -> None:
    """On ice its centre stays, and it goes round at P with m g l = P (C w - A P cos(tilt)), within 1e-3.

    Goldstein, Classical Mechanics, 3rd ed., section 5.7. A is the moment across, C that about the axis at which it
    spins at w. It is detected a few times a step: as if its tip moved at 24 m/s, it was up to 160 times.
    """
    simulation = Simulation(checked=False, substeps=substeps)
    simulation.add(collider={"plane": {}}, material={"friction": 0.0})
    (shape, low), middle = TIPS[tip], HIGH - 0.05 if tip == "capsule" else HIGH
    top = simulation.add(
        body={"mass": 1.0, "inertia": (ACROSS, AROUND, ACROSS), "center_of_mass": (0.0, 0.0, 0.0)},
        transform={
            "position": (0.0, HIGH * np.cos(TILT) + low, 0.0),
            "rotation": (0.0, 0.0, -np.sin(TILT / 2), np.cos(TILT / 2)),
        },
    )  # fmt: skip
    simulation.add(
        collider=shape, material={"friction": 0.0}, parent={"entity": top, "position": (0.0, -middle, 0.0)}
    )  # fmt: skip
    most = AROUND * SPIN
    around = (most - np.sqrt(most**2 - 4.0 * ACROSS * np.cos(TILT) * G * HIGH)) / (2.0 * ACROSS * np.cos(TILT))
    row, lean = simulation.world.row(top), np.array([np.sin(TILT), np.cos(TILT), 0.0])
    with simulation.world.edit(Motion) as motion:
        motion.angular[row] = SPIN * lean + around * (UPRIGHT - np.cos(TILT) * lean)
    simulation.step(10)
    before = direction(simulation, top)
    simulation.step(240)
    axis, gone = rotate(simulation[top].transform.rotation, UPRIGHT), direction(simulation, top) - before
    assert np.arccos(axis[1]) == pytest.approx(TILT, abs=2e-3)
    assert gone % (2.0 * np.pi) == pytest.approx(4.0 * around, rel=1e-3)
    assert simulation[top].motion.angular @ axis == pytest.approx(SPIN, rel=1e-4)  # by inertia of a substep ago
    assert simulation.world[Answered].detections <= 250 * (16 if tip == "hull" else 2)  # whose corners do go fast


def direction(simulation: Simulation, top: Entity) -> float:
    """Return which way a top leans, rad about the vertical."""
    x, _, z = rotate(simulation[top].transform.rotation, UPRIGHT)
    return float(np.arctan2(-z, x))
