"""Who lies on the inside of a drum that turns rests there, pressed by its turning, whatever its restitution is."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from carom.ecs import Transform
from carom.ecs.relations.contact import Contact
from carom.ecs.relations.impact import Impact
from carom.ecs.spatial import quaternion
from carom.systems.detection.answered import Answered
from carom.systems.simulation import Simulation

RADIUS, HALF, DT = 1.5, 0.125, 1.0 / 60.0
BOX: dict[str, Any] = {"box": {"size": (0.25, 0.25, 0.25)}}
DRUM: dict[str, Any] = {"cylinder": {"radius": HALF, "length": 0.25}}
CAPSULE: dict[str, Any] = {"capsule": {"radius": 0.08, "length": 0.3}}
BALL: dict[str, Any] = {"sphere": {"radius": HALF}}


def add_drum(simulation: Simulation, spin: float, walls: int, **material: float) -> None:
    """Add flat walls about the origin, which turn about z (rad/s); the first is at +x."""
    body = {"type": "kinematic", "center_of_mass": (0.0, 0.0, 0.0)}
    drum = simulation.add(body=body, motion={"angular": (0.0, 0.0, spin)})
    for angle in 2.0 * np.pi * np.arange(walls) / walls:
        place = ((RADIUS + 0.1) * np.cos(angle), (RADIUS + 0.1) * np.sin(angle), 0.0)
        wall = {"entity": drum, "position": place, "rotation": quaternion.from_axis_angle((0.0, 0.0, 1.0), angle)}
        across = 2.0 * RADIUS * np.tan(np.pi / max(walls, 6)) + 0.2
        simulation.add(collider={"box": {"size": (0.2, across, 3.0)}}, parent=wall, material=material)


def carried(collider: dict[str, Any], spin: float, restitution: float) -> tuple[Simulation, int]:
    """Return a body that goes along with the wall that it lies on; there is no gravity."""
    simulation = Simulation(dt=DT, gravity=(0.0, 0.0, 0.0), sleeping=False, checked=False)
    material = {"friction": 0.6, "restitution": restitution}
    add_drum(simulation, spin, 1, **material)
    body = simulation.add(
        collider=collider, body={"mass": 1.0}, material=material, transform={"position": (RADIUS - HALF, 0.0, 0.0)},
        motion={"linear": (0.0, spin * (RADIUS - HALF), 0.0), "angular": (0.0, 0.0, spin)},
    )  # fmt: skip
    return simulation, body


@pytest.mark.parametrize("collider", [BOX, DRUM], ids=["box", "drum"])
@pytest.mark.parametrize("spin", [1.0, 4.0, 12.0])
def test_who_lies_on_the_wall_rests_whatever_its_restitution(collider: dict[str, Any], spin: float) -> None:
    """It stays where it is on the wall, strikes nobody, and is borne by m w^2 r of its centre.

    As it begins it slips by up to (w h)^3 / 5 of r, before friction has found its impulse; then it creeps no further.
    It overlaps by less than 3 (w h)^4 of r: what a sweep leaves of (w h)^2 / 8 of what bears it, as that is turned.
    """
    ways, reach = [], RADIUS - HALF
    for restitution in (0.0, 0.3, 0.8):
        simulation, body = carried(collider, spin, restitution)
        contact, way, aside = simulation.world[Contact], [], []
        for _ in range(60):
            simulation.step()
            assert simulation.world.count(Impact) == 0
            place = simulation[body].transform.position
            way.append(np.array(place))
            x, y, turned = place[0], place[1], spin * simulation.frame * DT
            assert np.hypot(x, y) == pytest.approx(reach, abs=3.0 * reach * (spin * DT / 4.0) ** 4 + 1e-6)
            aside.append(y * np.cos(turned) - x * np.sin(turned))
            assert aside[-1] == pytest.approx(0.0, abs=0.2 * reach * (spin * DT / 4.0) ** 3 + 1e-6)
            borne = contact.impulse[: contact.count].sum() / DT
            if simulation.frame > 10:
                assert borne == pytest.approx(spin * spin * reach, rel=1e-3)
        assert aside[-1] == pytest.approx(aside[20], abs=3e-6)
        ways.append(way)
    np.testing.assert_array_equal(ways[0], ways[1])
    np.testing.assert_array_equal(ways[0], ways[2])


@pytest.mark.parametrize("collider", [DRUM, BALL], ids=["drum", "ball"])
@pytest.mark.parametrize(
    ("spin", "along", "speed", "gap", "bounces"),
    [(4.0, 1.0, 0.5, 2e-4, 1), (4.0, 1.0, 0.08, 2e-4, 0), (4.0, 0.0, 0.08, 1e-5, 1), (0.0, 1.0, 0.08, 2e-4, 1)],
)
def test_who_would_land_again_within_two_substeps_does_not_bounce(
    collider: dict[str, Any], spin: float, along: float, speed: float, gap: float, bounces: int
) -> None:
    """That is slower than 2 w^2 r h, 0.2 m/s here, but only of who goes along: others are not pressed on the wall."""
    simulation = Simulation(dt=DT, gravity=(0.0, 0.0, 0.0), sleeping=False, checked=False)
    material = {"friction": 0.0, "restitution": 0.5}
    add_drum(simulation, spin, 1, **material)
    at, along_z = RADIUS - HALF - gap, quaternion.from_axis_angle((1.0, 0.0, 0.0), 0.5 * np.pi)
    simulation.add(
        collider=collider, body={"mass": 1.0}, material=material,
        transform={"position": (at, 0.0, 0.0), "rotation": along_z},
        motion={"linear": (speed, along * spin * at, 0.0)},
    )  # fmt: skip
    impact = simulation.world[Impact]
    simulation.step()
    assert impact.speed[0] == pytest.approx(speed, abs=0.06)
    assert impact.impulse[0] == pytest.approx((1.0 + 0.5 * bounces) * impact.speed[0], rel=1e-9)


@pytest.mark.parametrize(("collider", "steps"), [(BOX, 180), (CAPSULE, 120)], ids=["box", "capsule"])
def test_nobody_is_pressed_out_of_a_drum(collider: dict[str, Any], steps: int) -> None:
    """Thirty bodies that bounce, pressed on eight walls by up to twenty times their weight."""
    material = {"friction": 0.6, "restitution": 0.3}
    simulation, random = Simulation(dt=DT, sleeping=False, checked=False), np.random.default_rng(0)
    add_drum(simulation, 12.0, 8, **material)
    for z in (-1.55, 1.55):
        simulation.add(collider={"box": {"size": (3.6, 3.6, 0.1)}}, transform={"position": (0.0, 0.0, z)})
    bodies = []
    for k in range(30):
        place = ((k % 3 - 1) * 0.62, (k // 3 % 3 - 1) * 0.62, (k // 9 - 1.5) * 0.7)
        turn = quaternion.normalise(random.normal(size=4))
        transform = {"position": place, "rotation": turn}
        bodies.append(simulation.add(collider=collider, body={"mass": 1.0}, material=material, transform=transform))
    simulation.step(steps)
    places = simulation.world[Transform].position[[simulation.world.row(body) for body in bodies]]
    assert np.hypot(places[:, 0], places[:, 1]).max() < RADIUS / np.cos(np.pi / 8.0)
    assert np.abs(places[:, 2]).max() < 1.5
    assert simulation.world[Answered].looks_cut == 0
