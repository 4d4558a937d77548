"""What is round, and no ball, rolls on as it rolls: its contacts stay beneath it, though found anew now and then."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from carom.ecs import Motion, Transform
from carom.systems.shapes.geometry import hull_of
from carom.systems.shapes.mesh import Mesh
from carom.systems.simulation import Simulation

RADIUS, G, HALF = 0.35, 9.81, np.sqrt(0.5)
SHAPES: dict[str, dict[str, Any]] = {
    "capsule": {"capsule": {"radius": RADIUS, "length": 0.4}},
    "cylinder": {"cylinder": {"radius": RADIUS, "length": 0.2}},
    "ellipsoid": {"ellipsoid": {"radii": (RADIUS, 0.5, RADIUS)}},
}
#: Squared radius of gyration about the axis by that of the shape.
GYRATION = {"cylinder": 0.5, "ellipsoid": 0.4}
CORNERS = [(x, y, z) for x in (-40.0, 40.0) for y in (-1.0, 0.0) for z in (-40.0, 40.0)]
GROUNDS: dict[str, dict[str, Any]] = {
    "plane": {"collider": {"plane": {}}},
    "mesh": {"collider": {"shape": Mesh(hull_of(np.array(CORNERS)))}},
    "box": {"collider": {"box": {"size": (80.0, 1.0, 80.0)}}, "transform": {"position": (0.0, -0.5, 0.0)}},
}


@pytest.mark.parametrize("first", ["ground first", "ground last"])
@pytest.mark.parametrize("speed", [1e-4, 0.01, 0.5])
@pytest.mark.parametrize("ground", ["plane", "mesh"])
@pytest.mark.parametrize("shape", SHAPES)
def test_what_is_round_rolls_on_as_fast_as_it_rolls(shape: str, ground: str, speed: float, first: str) -> None:
    """To 1e-11 of its speed (m/s) for ten seconds: by points that went along it drove itself on up to 0.04 m/s."""
    rolling = rolls_on(shape, ground, speed, ground_first=first == "ground first")
    assert rolling == pytest.approx(speed, rel=1e-11)


@pytest.mark.parametrize(("shape", "off"), [("capsule", 1e-11), ("cylinder", 5e-6), ("ellipsoid", 5e-4)])
@pytest.mark.parametrize("speed", [1e-3, 0.1])
def test_on_a_box_it_does_as_nearly_as_points_are_found_there(shape: str, off: float, speed: float) -> None:
    """Those of cylinders and ellipsoids are searched for, step by step."""
    assert rolls_on(shape, "box", speed, ground_first=True) == pytest.approx(speed, rel=off)


@pytest.mark.parametrize("slope", [1e-5, 1e-3, 0.1])
@pytest.mark.parametrize("shape", GYRATION)
def test_it_rolls_down_the_slightest_slope_as_theory_has_it(shape: str, slope: float) -> None:
    """From rest at g sin(a) / (1 + k^2 / r^2), to 1e-8 of that after two seconds."""
    simulation = Simulation(sleeping=False, checked=False)
    simulation.add(
        collider={"plane": {}}, transform={"rotation": (0.0, 0.0, np.sin(-0.5 * slope), np.cos(0.5 * slope))}
    )
    place = {"position": (RADIUS * np.sin(slope), RADIUS * np.cos(slope), 0.0), "rotation": (HALF, 0.0, 0.0, HALF)}
    body = simulation.add(collider=SHAPES[shape], body={"mass": 1.0}, transform=place, material={"friction": 0.5})
    simulation.step(120)
    down = simulation[body].motion.linear @ (np.cos(slope), -np.sin(slope), 0.0)
    assert down == pytest.approx(2.0 * G * np.sin(slope) / (1.0 + GYRATION[shape]), rel=1e-8)


@pytest.mark.parametrize("load", [0.0, 200.0, 1000.0])
def test_a_car_that_stands_stands_still(load: float) -> None:
    """On four cylinders that turn freely, under a load (kg) off its middle: it drove off by itself, 0.3 m in 10 s."""
    simulation = Simulation(sleeping=False, checked=False)
    simulation.add(collider={"plane": {}}, material={"friction": 0.5})
    car = {"box": {"size": (4.0, 0.4, 1.8)}}
    body = simulation.add(collider=car, body={"mass": 200.0}, transform={"position": (0.0, 1.0, 0.0)})
    for x in (-1.4, 1.4):
        for z in (-0.9, 0.9):
            place = {"position": (x, RADIUS, z), "rotation": (HALF, 0.0, 0.0, HALF)}
            wheel = simulation.add(collider=SHAPES["cylinder"], body={"mass": 20.0}, transform=place)
            simulation.add(joint={"hinge": {"a": body, "b": wheel, "at": (x, RADIUS, z), "axis": (0.0, 0.0, 1.0)}})
    if load:
        crate, place = {"box": {"size": (1.0, 1.0, 1.0)}}, {"position": (0.3, 1.7, 0.1)}
        simulation.add(collider=crate, body={"mass": load}, transform=place)
    simulation.step(600)
    row = simulation.world.row(body)
    assert np.abs(simulation.world[Motion].linear).max() < 1e-5
    assert np.abs(simulation.world[Transform].position[row, [0, 2]]).max() < 1e-3


@pytest.mark.parametrize("amplitude", [1e-3, 0.01, 0.1])
@pytest.mark.parametrize("shape", ["capsule", "cylinder", "sphere"])
def test_a_plank_rocks_on_a_log_as_theory_has_it_and_no_more_and_more(shape: str, amplitude: float) -> None:
    """Rolling on it without slip, at w^2 = g (R - t / 2) / (k^2 + t^2 / 4), with steady swings.

    To 1e-4 in its period where swings are small, and 2e-3 in how far it swings after 20 s. It touched where its step
    began: swings grew by 4 % a second.
    """
    radius, thick, long = 0.5, 0.1, 2.0
    logs = {kind: {kind: {"radius": radius, "length": 1.0}} for kind in ("capsule", "cylinder")}
    log = {"sphere": {"radius": radius}} if shape == "sphere" else logs[shape]
    simulation = Simulation(sleeping=False, checked=False)
    simulation.add(collider=log, transform={"rotation": (HALF, 0.0, 0.0, HALF)}, material={"friction": 2.0})
    along = np.array([np.cos(amplitude), np.sin(amplitude), 0.0])
    up = np.array([-np.sin(amplitude), np.cos(amplitude), 0.0])
    place = {
        "position": tuple((radius + 0.5 * thick) * up + radius * amplitude * along),
        "rotation": (0.0, 0.0, np.sin(0.5 * amplitude), np.cos(0.5 * amplitude)),
    }
    plank = {"box": {"size": (long, thick, 0.6)}}
    body = simulation.add(collider=plank, body={"mass": 1.0}, transform=place, material={"friction": 2.0})
    tilts = []
    for _ in range(1200):
        simulation.step()
        rotation = simulation[body].transform.rotation
        tilts.append(2.0 * np.arctan2(rotation[2], rotation[3]))
    tilt = np.array(tilts)
    before = np.flatnonzero((tilt[:-1] > 0.0) != (tilt[1:] > 0.0))
    crossings = (before + tilt[before] / (tilt[before] - tilt[before + 1])) / 60.0
    frequency = G * (radius - 0.5 * thick) / ((long**2 + thick**2) / 12.0 + 0.25 * thick**2)
    wide = amplitude**2  # longer by about this part
    assert 2.0 * np.diff(crossings).mean() == pytest.approx(2.0 * np.pi / np.sqrt(frequency), rel=1e-4 + wide)
    assert np.abs(tilt[-120:]).max() == pytest.approx(amplitude, rel=2e-3)


def rolls_on(shape: str, ground: str, speed: float, *, ground_first: bool) -> float:
    """Return how fast (m/s) what has been set rolling without slip rolls after ten seconds."""
    simulation = Simulation(sleeping=False, checked=False)
    if ground_first:
        simulation.add(**GROUNDS[ground])
    body = simulation.add(
        collider=SHAPES[shape], body={"mass": 1.0}, material={"friction": 0.5},
        transform={"position": (0.0, RADIUS, 0.0), "rotation": (HALF, 0.0, 0.0, HALF)},
        motion={"linear": (speed, 0.0, 0.0), "angular": (0.0, 0.0, -speed / RADIUS)},
    )  # fmt: skip
    if not ground_first:
        simulation.add(**GROUNDS[ground])
    simulation.step(600)
    return float(simulation[body].motion.linear[0])
