"""Bodies that tumble, their axes wandering as no torque but their shape has it, bounce off floors and never through."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from carom.ecs import Motion, RigidBody, Transform, state_hash
from carom.ecs.column import Floats
from carom.ecs.spatial import quaternion
from carom.systems.simulation import Simulation

FLOORS: dict[str, tuple[dict[str, Any], dict[str, Any]]] = {
    "plane": ({"plane": {}}, {}),
    "box": ({"box": {"size": (20.0, 1.0, 20.0)}}, {"position": (0.0, -0.5, 0.0)}),
    "mesh": ({"height_field": {"heights": np.zeros((9, 9)).tolist(), "spacing": 1.0}}, {}),
}
CORNERS = np.array([(x, y, z) for x in (-1.0, 1.0) for y in (-1.0, 1.0) for z in (-1.0, 1.0)])
AROUND = np.linspace(0.0, 2.0 * np.pi, 64, endpoint=False)
SMOOTH = {"friction": 0.0, "restitution": 1.0}


def tumbler(shape: str, random: np.random.Generator) -> tuple[dict[str, Any], Floats, float]:
    """Return a collider, points that it is around, and its radius around them."""
    a, b, c = random.uniform(0.5, 1.5, 3)
    if shape == "capsule":
        end = 0.4 * b
        return {"capsule": {"radius": 0.05 * a, "length": 2.0 * end}}, np.array([(0, -end, 0), (0, end, 0)]), 0.05 * a
    if shape == "cylinder":
        radius, half = 0.2 * a, 0.03 * b
        rim = [(radius * np.cos(t), y, radius * np.sin(t)) for t in AROUND for y in (-half, half)]
        return {"cylinder": {"radius": radius, "length": 2.0 * half}}, np.array(rim), 0.0
    if shape == "hull":
        points = random.normal(size=(12, 3)) * (0.3 * a, 0.08 * b, 0.2 * c)
        points -= points.mean(axis=0)
        return {"convex": {"points": points.tolist()}}, points, 0.0
    half_edges = np.array({"rod": (0.5, 0.05, 0.05), "plate": (0.3, 0.03, 0.3)}[shape]) * (a, b, c)
    return {"box": {"size": 2.0 * half_edges}}, CORNERS * half_edges, 0.0


def thrown(shape: str, floor: str, seed: int, *, checked: bool) -> tuple[Simulation, int, Floats, float]:
    """Return a world in which a body tumbles down, anyhow; its entity, the points it is around, and its radius.

    Where it is not ``checked``, substeps are taken at once.
    """
    random, simulation = np.random.default_rng(seed), Simulation(sleeping=False, checked=checked)
    collider, place = FLOORS[floor]
    simulation.add(collider=collider, transform=place, material=SMOOTH)
    solid, points, radius = tumbler(shape, random)
    turn, axis = quaternion.normalise(random.normal(size=4)), random.normal(size=3)
    spin = axis * random.uniform(2.0, 25.0) / np.linalg.norm(axis)
    body = simulation.add(
        collider=solid, body={}, material=SMOOTH,
        transform={"position": (2.5, random.uniform(0.8, 1.3), -1.5), "rotation": turn},
        motion={"linear": (0.0, -random.uniform(0.0, 6.0), 0.0), "angular": spin},
    )  # fmt: skip
    return simulation, body, points, radius


def lowest_and_energy(simulation: Simulation, body: int, points: Floats, radius: float) -> tuple[float, float]:
    """Return how high (m) the lowest point of the body is, and its energy (J)."""
    world, row = simulation.world, simulation.world.row(body)
    transform, motion, mass = world[Transform], world[Motion], world[RigidBody]
    position, rotation = transform.position[row], transform.rotation[row]
    lowest = (position + quaternion.rotate(rotation, points))[:, 1].min() - radius
    axes = quaternion.multiply(rotation, mass.principal_axes[row])
    spin = quaternion.rotate(quaternion.conjugate(axes), motion.angular[row])
    center = position + quaternion.rotate(rotation, mass.center_of_mass[row])
    speed, moving = motion.linear[row], 1.0 / mass.inverse_mass[row]
    energy = 0.5 * moving * (speed @ speed) + 0.5 * (mass.inertia[row] * spin * spin).sum() + moving * 9.81 * center[1]
    return float(lowest), float(energy)


@pytest.mark.parametrize(
    ("shape", "floor", "seeds"),
    [
        ("rod", "plane", (44, 80, 75)), ("rod", "box", (77, 37, 2)), ("rod", "mesh", (77, 37, 2)),
        ("plate", "plane", (36, 53, 34)), ("plate", "box", (17, 62)), ("plate", "mesh", (17, 62)),
        ("capsule", "plane", (80, 87)), ("capsule", "box", (87, 47)), ("capsule", "mesh", (87, 47)),
        ("hull", "plane", (36, 37, 22)), ("hull", "box", (98, 32)), ("hull", "mesh", (98, 32)),
        ("cylinder", "plane", (88, 76, 65)), ("cylinder", "box", (22, 4)), ("cylinder", "mesh", (22,)),
    ],
)  # fmt: skip
def test_who_tumbles_bounces_off_a_floor(shape: str, floor: str, seeds: tuple[int, ...]) -> None:
    """No point comes through it, and without friction energy stays, at up to 200 rad/s; whoever looks on.

    An axis wanders by up to 50 rad/s in a step, which in each substep is followed to second order: a thousandth of the
    energy of one rod. Before its way was looked at anew in each substep, ends swung in by up to 12 cm, and one hull had
    half as much energy again.
    """
    for seed in seeds:
        simulation, body, points, radius = thrown(shape, floor, seed, checked=False)
        seen = thrown(shape, floor, seed, checked=True)[0]
        energy = lowest_and_energy(simulation, body, points, radius)[1]
        for _ in range(60):
            simulation.step(), seen.step()
            lowest, now = lowest_and_energy(simulation, body, points, radius)
            assert lowest > -1e-6, seed
            assert now == pytest.approx(energy, rel=1e-3), seed
        assert state_hash(simulation.world) == state_hash(seen.world)
