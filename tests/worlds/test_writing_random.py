"""Random worlds, built in Python, are written to files that load to the same state and go on alike."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from carom.ecs import first_difference, state_hash
from carom.ecs.spatial import quaternion
from carom.systems.simulation import Simulation
from carom.worlds import load_text, world_text

SETTINGS: tuple[dict[str, Any], ...] = (
    {},
    {"dt": 1 / 90, "substeps": 3, "integrator": "semi_implicit", "seed": 5},
    {"dt": 0.013, "sleeping": False, "gravity": (0.1, -3, 0.7)},
)
STEPS = 6


class Maker:
    """Builds a world of everything that has words, here and there without names."""

    def __init__(self, seed: int) -> None:
        self.draws = np.random.default_rng(seed)
        self.simulation = Simulation(**SETTINGS[seed % len(SETTINGS)])
        self.bodies: list[int] = []

    def vector(self, size: float = 1.0) -> tuple[float, ...]:
        """Return three numbers within +- ``size``."""
        return tuple(self.draws.uniform(-size, size, 3).tolist())

    def turn(self) -> Any:
        """Return a rotation."""
        return quaternion.normalise(self.draws.normal(size=4))

    def maybe(self, chance: float = 0.5) -> bool:
        """Tell heads or tails."""
        return bool(self.draws.random() < chance)

    def size(self) -> float:
        """Return a length."""
        return float(self.draws.uniform(0.1, 0.4))

    def collider(self) -> dict[str, Any]:
        """Return words of a collider of any shape that a body may have."""
        size = self.size
        shapes: list[dict[str, Any]] = [
            {"sphere": {"radius": size()}},
            {"box": {"size": (size(), size(), size())}},
            {"capsule": {"radius": size(), "length": size()}},
            {"cylinder": {"radius": size(), "length": size()}},
            {"cone": {"radius": size(), "length": size()}},
            {"ellipsoid": {"radii": (size(), size(), size())}},
            {"convex": {"points": self.draws.normal(size=(9, 3)) * 0.2}},
        ]
        words = shapes[self.draws.integers(len(shapes))]
        words |= {"position": self.vector(0.1)} if self.maybe(0.3) else {}
        words |= {"rotation": self.turn()} if self.maybe(0.3) else {}
        return words | ({"layer": "soft"} if self.maybe(0.3) else {})

    def material(self) -> Any:
        """Return the name of a material or its words."""
        if self.maybe():
            return "stone"
        color = tuple(self.draws.random(3).tolist())
        return {"density": float(self.draws.uniform(100, 3000)), "color": color, "friction": self.size()}

    def body(self) -> dict[str, Any]:
        """Return words of a body."""
        words: dict[str, Any] = {"mass": self.size()} if self.maybe(0.3) else {}
        words |= {"inertia": (self.size(), self.size(), self.size())} if self.maybe(0.2) else {}
        words |= {"center_of_mass": self.vector(0.05)} if self.maybe(0.2) else {}
        words |= {"locked": ["rotation_x"]} if self.maybe(0.2) else {}
        return words | ({"linear_damping": 0.3, "sleeps": False} if self.maybe(0.2) else {})

    def add_bodies(self) -> None:
        """Add bodies, some of which carry further colliders."""
        for number in range(8):
            pose = {"position": (*self.vector(3)[:1], 2.0 + number, *self.vector(3)[:1]), "rotation": self.turn()}
            named = f"body[{number}]" if self.maybe() else None
            words: dict[str, Any] = {"transform": pose, "collider": self.collider(), "material": self.material()}
            words |= {"visual": {"color": (0.25, 0.5, 0.75, 0.5)}} if self.maybe(0.3) else {}
            words |= {"motion": {"linear": self.vector()}, "tags": ["quick", "loud"]} if self.maybe(0.3) else {}
            body = self.simulation.add(name=named, body=self.body(), **words)
            self.bodies.append(int(body))
            if self.maybe(0.3):
                parent = {"entity": body, "position": self.vector(0.3), "rotation": self.turn()}
                self.simulation.add(collider=self.collider(), material=self.material(), parent=parent)

    def add_joints(self) -> None:
        """Add joints of most kinds, and springs."""
        kinds: list[dict[str, Any]] = [
            {"hinge": {"at": (0, 2, 0), "axis": self.vector(), "motor": {"speed": 1.0, "most": 3.0}}},
            {"slider": {"anchor_a": self.vector(), "axis_b": self.vector(), "limits": (-0.5, 0.5), "friction": 0.1}},
            {"ball": {"at": self.vector(), "break_force": 1e6}},
            {"generic": {"at": self.vector(), "x": {"motor": {"target": 0.1, "stiffness": 30.0}}, "y": "free"}},
            {"rope": {"anchor_a": (0, 0.1, 0), "length": 20.0}},
            {"spring": {"stiffness": 20.0, "damping": 0.5}},
            {"distance": {"collide": True}},
        ]
        for number in self.draws.choice(len(kinds), 4, replace=False).tolist():
            one, other = self.draws.choice(self.bodies, 2, replace=False).tolist()
            (key,) = kinds[number]
            self.simulation.add(joint={key: kinds[number][key] | {"a": one, "b": other}})
        spring = {"a": self.bodies[0], "b": self.bodies[1], "rest_length": 1.0, "stiffness": 5.0}
        self.simulation.add(name="spring", spring=spring)

    def world(self) -> Simulation:
        """Return the whole world."""
        simulation = self.simulation
        simulation.material("stone", density=2500, friction={"value": 0.8, "combine": "max"}, color=(0.2, 0.4, 0.6))
        simulation.layers({"soft": ["default"]})
        simulation.add(name="floor", collider={"plane": {"normal": (*self.vector(0.1)[:1], 1.0, 0.02)}})
        self.add_bodies()
        self.add_joints()
        frames = [{"at": 0.0, "position": self.vector(5)}, {"at": 0.5, "rotation": self.turn()}]
        lift = {"keyframes": {"frames": frames, "repeat": "ping_pong"}, "body": {"type": "kinematic"}}
        simulation.add(name="lift", collider=self.collider(), **lift)
        region = {"sphere": {"radius": 4.0, "position": self.vector()}}
        simulation.force("wind", self.bodies[2:5], velocity=self.vector(), gust=0.2)
        simulation.force("linear_drag", region=region, during=(0.0, 0.03), coefficient=0.1)
        return simulation


@pytest.mark.parametrize("seed", range(4))
def test_a_random_world_comes_back_and_goes_on_alike(seed: int) -> None:
    """At its start and in mid-run, after some have gone and others have come."""
    simulation = Maker(seed).world()
    for gone in ("spring", "lift"):
        again = load_text(world_text(simulation), "written.yaml").simulation
        assert first_difference(again.world, simulation.world) is None
        simulation.step(STEPS)
        again.step(STEPS)
        assert state_hash(again.world) == state_hash(simulation.world)
        simulation.world.despawn(simulation.world.find(gone))
        simulation.add(collider={"sphere": {"radius": 0.1}}, body={}, transform={"position": (0, 9, 0)})
