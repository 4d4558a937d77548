"""Worlds in which much touches at any time."""

from __future__ import annotations

from typing import Any

import numpy as np

from carom.ecs import state_hash
from carom.systems.simulation import Simulation


def add_walls(simulation: Simulation, way: float, height: float) -> None:
    """Add four walls about the vertical axis, whose middles are so far from it."""
    for x, z in ((1, 0), (-1, 0), (0, 1), (0, -1)):
        wall = {"box": {"size": (0.2 if x else 2.4, height, 0.2 if z else 2.4)}}
        simulation.add(collider=wall, transform={"position": (way * x, 0.5 * height, way * z)})


def bin_of_balls(count: int, **settings: Any) -> Simulation:
    """Return balls thrown into a bin where they rattle: thousands of impacts in a step."""
    simulation = Simulation(dt=1 / 120, **settings)
    simulation.add(collider={"plane": {}}, name="floor")
    add_walls(simulation, 0.77, 4.0)
    for k in range(count):
        place = (-0.42 + 0.33 * (k % 3) + 0.01 * (k % 7), 0.2 + 0.34 * (k // 9), -0.4 + 0.32 * (k // 3 % 3))
        simulation.add(
            collider={"sphere": {"radius": 0.15}},
            body={"mass": 1.0},
            material={"restitution": 0.6 if k % 2 else 0.2},
            transform={"position": (place[0], place[1], place[2] + 0.005 * (k % 5))},
            motion={"linear": (0.3 * (k % 5 - 2), -3.0, 0.2 * (k % 3 - 1))},
            name=f"ball{k}",
        )
    return simulation


def stack_of_boxes(**settings: Any) -> Simulation:
    """Return boxes that fall onto each other and come to rest."""
    simulation = Simulation(dt=1 / 60, **settings)
    simulation.add(collider={"plane": {}}, name="floor")
    for k in range(4):
        place = {"position": (0.1 * k, 0.55 + 1.1 * k, 0.05 * k)}
        simulation.add(collider={"box": {"size": (1.0, 1.0, 1.0)}}, body={}, transform=place, name=f"box{k}")
    return simulation


def hashes(simulation: Simulation, frames: int) -> list[str]:
    """Return the state hash after each of the next frames."""
    found = []
    for _ in range(frames):
        simulation.step()
        found.append(state_hash(simulation.world))
    return found


def jointed_heap(**settings: Any) -> Simulation:
    """Return a mobile of boxes on joints of all kinds, with limits, drives and friction, that meets the floor."""
    simulation = Simulation(dt=1 / 120, **settings)
    simulation.add(collider={"plane": {}}, name="floor", material={"restitution": 0.3})
    axis, across = {"axis": (0.0, 0.0, 1.0)}, {"axis": (1.0, 0.0, 0.0), "second_axis": (0.0, 0.0, 1.0)}
    kinds: list[dict[str, Any]] = [
        {"hinge": {"friction": 0.05} | axis},
        {"ball": {"swing": 0.6, "twist": (-0.3, 0.4), "axis": (1.0, 0.0, 0.0)}},
        {"hinge": {"limits": (-0.4, 0.3), "restitution": 0.5} | axis},
        {"universal": across},
        {"slider": {"limits": (-0.05, 0.1), "motor": {"target": 0.05, "stiffness": 200.0, "damping": 2.0}} | axis},
        {"fixed": {"break_force": 60.0}},
        {"generic": {"x": {"motor": {"target": 0.0, "stiffness": 500.0, "damping": 5.0}}, "rotation_z": "free"}},
        {"hinge": {"motor": {"speed": 3.0, "most": 0.5}} | axis},
    ]
    for k, joint in enumerate(kinds):
        place, box = {"position": (0.2 + 0.35 * k, 1.2, 0.0)}, {"box": {"size": (0.3, 0.1, 0.1)}}
        simulation.add(name=f"link{k}", collider=box, body={}, transform=place)
        ((key, words),) = joint.items()
        ends = {"b": f"link{k}", "at": (0.025 + 0.35 * k, 1.2, 0.0)} | ({"a": f"link{k - 1}"} if k else {})
        simulation.add(name=f"joint{k}", joint={key: words | ends})
    for key, words in (("rope", {"length": 0.6}), ("spring", {"stiffness": 50.0, "damping": 0.5, "length": 0.3})):
        place, ball = {"position": (2.9 if key == "rope" else 1.3, 1.0, 0.2)}, {"sphere": {"radius": 0.1}}
        simulation.add(name=key, collider=ball, body={}, transform=place)
        ends = {"a": "link7" if key == "rope" else "link3", "b": key}
        anchors = {"anchor_a": (0.0, 0.0, 0.0), "anchor_b": (0.0, 0.0, 0.0)}
        simulation.add(name=f"{key} joint", joint={key: words | ends | anchors})
    return simulation


def stirred_heap(**settings: Any) -> Simulation:
    """Return boxes, balls and capsules that fall into shallow water, where a paddle stirs them."""
    simulation = Simulation(**settings)
    simulation.add(collider={"plane": {}}, material={"friction": 0.5})
    simulation.add(
        collider={"box": {"size": (4.0, 0.3, 0.3)}},
        body={"type": "kinematic"},
        transform={"position": (0.0, 0.3, 0.0)},
        motion={"angular": (0.0, 2.0, 0.0)},
    )
    simulation.force("buoyancy", density=500.0, level=0.5)
    kinds: tuple[dict[str, Any], ...] = (
        {"box": {"size": (0.5, 0.4, 0.3)}},
        {"sphere": {"radius": 0.25}},
        {"capsule": {"radius": 0.15, "length": 0.4}},
    )
    for k in range(27):
        place = (0.6 * (k % 3 - 1) + 0.01 * k, 0.8 + 0.6 * (k // 9), 0.6 * (k // 3 % 3 - 1))
        turn = np.array([0.1 * (k % 4), 0.05 * k, 0.2 * (k % 3), 1.0])
        simulation.add(
            collider=kinds[k % 3],
            body={},
            material={"restitution": 0.2 * (k % 4), "rolling_friction": 0.01},
            transform={"position": place, "rotation": turn / np.sqrt((turn * turn).sum())},
        )
    return simulation
