"""Ghosts: what glides over ground made of many pieces does not feel where they meet."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from carom.ecs.spatial import quaternion
from carom.systems.shapes.geometry import Geometry
from carom.systems.shapes.mesh import Mesh
from carom.systems.simulation import Simulation

SPEED, SECONDS = 5.0, 4.0
SMOOTH = {"friction": 0.0}
CELLS, WIDTH = 40, 40.0  # 3,200 triangles

LYING = quaternion.from_axis_angle((0.0, 0.0, 1.0), math.pi / 2.0)
ACROSS = quaternion.from_axis_angle((1.0, 0.0, 0.0), math.pi / 2.0)
CAPSULE = {"capsule": {"radius": 0.3, "length": 0.8}}
BODIES = {
    "cube": ({"box": {"size": (1.0, 1.0, 1.0)}}, 0.5, quaternion.IDENTITY),
    "sphere": ({"sphere": {"radius": 0.5}}, 0.5, quaternion.IDENTITY),
    "capsule along": (CAPSULE, 0.3, LYING),
    "capsule across": (CAPSULE, 0.3, ACROSS),
}


def flat_mesh(simulation: Simulation) -> None:
    """Lay two triangles a cell."""
    steps = np.linspace(-WIDTH / 2.0, WIDTH / 2.0, CELLS + 1)
    x, z = np.meshgrid(steps, steps, indexing="ij")
    corner = (np.arange(CELLS)[:, None] * (CELLS + 1) + np.arange(CELLS)).ravel()
    across = corner + CELLS + 2
    faces = np.concatenate([np.stack([corner, corner + 1, across], 1), np.stack([corner, across, across - 1], 1)])
    geometry = Geometry(np.stack([x, 0.0 * x, z], axis=-1).reshape(-1, 3), faces)
    simulation.add(collider={"shape": Mesh(geometry)}, material=SMOOTH)


def flat_height_field(simulation: Simulation) -> None:
    """Lay as many cells of heights."""
    heights = np.zeros((CELLS + 1, CELLS + 1))
    simulation.add(collider={"height_field": {"heights": heights, "spacing": WIDTH / CELLS}}, material=SMOOTH)


def row_of_boxes(simulation: Simulation) -> None:
    """Lay boxes of 1 m side by side along the way."""
    for k in range(-12, 12):
        place = {"position": (k + 0.5, -0.5, 0.0)}
        simulation.add(collider={"box": {"size": (1.0, 1.0, 6.0)}}, transform=place, material=SMOOTH)


def tiles(simulation: Simulation) -> None:
    """Lay cubes of 1 m, whose corners the way passes, too."""
    places = [(k + 0.5, -0.5, j + 0.5) for k in range(-12, 12) for j in range(-3, 3)]
    simulation.add_many(places, collider={"box": {"size": (1.0, 1.0, 1.0)}}, material=SMOOTH)


@pytest.mark.parametrize("yaw", [0.0, 30.0])
@pytest.mark.parametrize("body", BODIES)
@pytest.mark.parametrize("ground", [flat_mesh, flat_height_field, row_of_boxes, tiles])
def test_seams_are_not_felt(ground: Callable[[Simulation], None], body: str, yaw: float) -> None:
    """Without friction at 5 m/s for 4 s: no more than 1e-8 m/s is lost, and nothing rises or sinks by 10 um.

    A capsule whose weight goes over from one box to the next sinks by 5 um: sweeps solve the two one after the other.
    """
    shape, height, lying = BODIES[body]
    simulation = Simulation(checked=False)
    ground(simulation)
    turn = quaternion.multiply(quaternion.from_axis_angle((0.0, 1.0, 0.0), math.radians(yaw)), lying)
    slider = simulation.add(
        collider=shape,
        body={"mass": 1.0},
        material=SMOOTH,
        transform={"position": (-10.0, height, 0.13), "rotation": turn},
        motion={"linear": (SPEED, 0.0, 0.0)},
    )
    seen = []
    for _ in range(round(60 * SECONDS)):
        simulation.step()
        seen.append([*simulation[slider].motion.linear, simulation[slider].transform.position[1] - height])
    along, _, aside, rise = np.abs(np.array(seen) - [SPEED, 0.0, 0.0, 0.0]).max(axis=0)
    assert along <= 1e-8
    assert aside <= 1e-8
    assert rise <= 1e-5
    assert simulation[slider].transform.position[0] == pytest.approx(10.0, abs=1e-7)


def slides_into(*parts: dict[str, Any], turn: Any = quaternion.IDENTITY, steps: int = 60) -> Any:
    """Return the state of a cube after some steps, which starts 1.5 m before x = 0 on parts of the ground at 5 m/s."""
    simulation = Simulation(checked=False)
    for part in parts:
        simulation.add(material=SMOOTH, **part)
    slider = simulation.add(
        collider={"box": {"size": (1.0, 1.0, 1.0)}},
        body={"mass": 1.0},
        material=SMOOTH,
        transform={"position": (-1.5, 0.5, 0.0), "rotation": turn},
        motion={"linear": (SPEED, 0.0, 0.0)},
    )
    simulation.step(steps)
    return simulation[slider]


def box(x: float, top: float, length: float = 10.0, high: float = 1.0) -> dict[str, Any]:
    """Return a static box from x on, which rises to ``top``."""
    place = {"position": (x + 0.5 * length, top - 0.5 * high, 0.0)}
    return {"collider": {"box": {"size": (length, high, 6.0)}}, "transform": place}


def test_a_kerb_trips_and_a_chink_does_not() -> None:
    """A cube is struck at its foot by what rises by 5 mm, and begins to turn over it; 0.3 mm are taken in passing."""
    ground = box(-10.0, 0.0)
    for kerb in (0.005, 0.1):
        tripped = slides_into(ground, box(0.0, kerb), steps=13)  # it is there after 12
        assert tripped.motion.linear[0] < 0.6 * SPEED
        assert tripped.motion.angular[2] < -2.0
    for kerb in (0.0003, 0.0, -0.0003):
        passed = slides_into(ground, box(0.0, kerb))
        assert passed.motion.linear == pytest.approx([SPEED, 0.0, 0.0], abs=1e-7)
        assert passed.transform.position == pytest.approx([3.5, 0.5 + kerb, 0.0], abs=1e-6)


def test_a_wall_on_flush_ground_stops_what_touches_it_at_its_foot() -> None:
    """A wall stands on the next box, or is it: neither the ground before it nor that below hides it."""
    for wall in ([box(0.0, 2.0, high=3.0)], [box(0.0, 0.0), box(0.0, 2.0, high=2.0)]):
        stopped = slides_into(box(-10.0, 0.0), *wall)
        assert stopped.transform.position[0] == pytest.approx(-0.5, abs=1e-4)
        assert abs(stopped.motion.linear[0]) < 1e-9
    foot = quaternion.from_axis_angle((0.0, 0.0, 1.0), 0.1)  # leans back: its foot comes first
    leaning = slides_into(box(-10.0, 0.0), box(0.0, 0.0), box(0.0, 2.0, high=2.0), turn=foot)
    assert leaning.transform.position[0] < -0.45


def test_what_falls_on_a_seam_stays_above_it() -> None:
    """Edge down, just where two boxes meet and beside: of the two one always holds it."""
    edge = quaternion.from_axis_angle((0.0, 0.0, 1.0), math.pi / 4.0)
    for beside in (0.0, 1e-9, 1e-5, 0.01):
        simulation = Simulation(checked=False)
        for part in (box(-10.0, 0.0), box(0.0, 0.0)):
            simulation.add(**part)
        place = {"position": (beside, 1.0, 0.0), "rotation": edge}
        fallen = simulation.add(collider={"box": {"size": (1.0, 1.0, 1.0)}}, body={}, transform=place)
        lowest = 1.0
        for _ in range(240):
            simulation.step()
            lowest = min(lowest, float(simulation[fallen].transform.position[1]))
        assert lowest > 0.5 - 1e-3


def test_seams_of_a_moving_body_are_not_felt_either() -> None:
    """A raft of three boxes that drifts under a cube: relative speed is all that counts."""
    simulation = Simulation(gravity=(0.0, 0.0, 0.0), checked=False)
    slab = {"box": {"size": (2.0, 1.0, 4.0)}}
    raft = simulation.add(
        collider=slab, body={"mass": 100.0}, material=SMOOTH, transform={"position": (1.0, -0.5, 0.0)},
        motion={"linear": (-2.0, 0.0, 0.0)}, name="raft",
    )  # fmt: skip
    for x in (2.0, 4.0):
        simulation.add(
            collider=slab, material=SMOOTH, transform={"position": (1.0 + x, -0.5, 0.0)},
            parent={"entity": raft, "position": (x, 0.0, 0.0)},
        )  # fmt: skip
    cube = simulation.add(
        collider={"box": {"size": (1.0, 1.0, 1.0)}}, body={"mass": 1.0}, material=SMOOTH,
        transform={"position": (0.6, 0.5, 0.0)}, motion={"linear": (3.0, -1e-4, 0.0)},
    )  # fmt: skip
    simulation.step(48)
    assert simulation[cube].transform.position[0] == pytest.approx(3.0, abs=1e-6)
    assert simulation[cube].motion.linear[0] == pytest.approx(3.0, abs=1e-6)
