"""Floating and sinking, through the systems of world files."""

from __future__ import annotations

import math

import numpy as np
import pytest

from carom.ecs import Motion
from carom.ecs.spatial import quaternion
from carom.systems.energy import total_energy
from carom.systems.free_body import loads
from carom.systems.simulation import Simulation
from carom.worlds import load_text

STILL = "buoyancy: {damping: 0, drag_coefficient: 0}"
CUBE = "box: {size: [1, 1, 1]}"
UPRIGHT = "[rotation_x, rotation_y, rotation_z]"


def water(bodies: str, *laws: str, settings: str = "", sleeping: str = "false") -> Simulation:
    """Return a world of bodies, a line each, in water, with steps and substeps of 1/240 s."""
    listed = "\n".join(f"  - {{{line}}}" for line in bodies.strip().splitlines())
    forces = "\n".join(f"  - {law}" for law in laws or (STILL,))
    head = f"carom: 1\nname: water\nstep: {{dt: 1/240, substeps: 1, sleeping: {sleeping}}}\n{settings}"
    return load_text(f"{head}\nentities:\n{listed}\nforces:\n{forces}\n", "water.yaml").simulation


def crossings(times: np.ndarray, values: np.ndarray) -> np.ndarray:
    """Return when values go through 0, by straight lines."""
    at = np.nonzero((values[:-1] < 0.0) != (values[1:] < 0.0))[0]
    return times[at] + values[at] / (values[at] - values[at + 1]) * (times[1] - times[0])


@pytest.mark.parametrize("axis", [1, 2])
def test_a_cube_heaves_as_the_formula_says(axis: int) -> None:
    """1 m, 600 kg/m3: T = 2 pi sqrt(m / (rho g A)) = 1.55389 s about a draft of 0.6 m; energy is kept, 1e-5.

    The surface is across gravity, whichever way that is, and nothing pushes it along the surface.
    """
    gravity = [0.0, 0.0, 0.0]
    gravity[axis] = -9.81
    simulation = water(
        f"name: cube, collider: {{{CUBE}}}, body: {{mass: 600, locked: {UPRIGHT}}}", settings=f"gravity: {gravity}"
    )
    energy, places = total_energy(simulation.world), []
    for _ in range(1200):
        simulation.step()
        places.append(simulation["cube"].transform.position)
    places = np.array(places)
    half_periods = np.diff(crossings(np.arange(1200) / 240.0, places[:, axis] + 0.1))
    assert half_periods == pytest.approx(1.55389 / 2.0, rel=1e-4)
    assert 2.0 * math.pi * math.sqrt(600.0 / (1000.0 * 9.81)) == pytest.approx(1.55389, abs=5e-6)
    assert total_energy(simulation.world) == pytest.approx(energy, rel=1e-5)
    assert not np.delete(places, axis, axis=1).any()


def test_a_cube_comes_to_rest_at_its_draft_and_sleeps_there() -> None:
    """0.6 m within 1 mm with the drag that water has by default; a push wakes it, and so does a tide."""
    body = f"body: {{mass: 600, locked: {UPRIGHT}}}, transform: {{position: [0, -0.085, 0]}}"
    low, high = "{buoyancy: {}, during: [0, 9]}", "{buoyancy: {level: 0.5, damping: 6}, during: [9, end]}"
    simulation = water(f"name: cube, collider: {{{CUBE}}}, {body}", low, high, sleeping="true")
    simulation.step(240 * 8)
    assert simulation["cube"].motion.asleep
    assert 0.5 - simulation["cube"].transform.position[1] == pytest.approx(0.6, abs=1e-3)
    simulation["cube"].external_force.force = (0.0, -500.0, 0.0)
    simulation.step()
    assert not simulation["cube"].motion.asleep
    simulation.step(240 * 6)
    assert simulation["cube"].motion.asleep
    assert 0.5 - simulation["cube"].transform.position[1] + 0.5 == pytest.approx(0.6, abs=1e-3)


@pytest.mark.parametrize(("width", "rights"), [(1.3, True), (1.15, False)])
def test_a_beam_stands_by_its_metacentre(width: float, rights: bool) -> None:
    """Half as dense as water, GM = b^2 / (6 h) - h / 4: upright above b / h = 1.2247, else it turns to another side."""
    body = f"collider: {{box: {{size: [{width}, 1, 6]}}}}, body: {{}}, material: {{density: 500}}"
    pose = "transform: {rotation: {axis: [0, 0, 1], angle: 3 deg}}"
    simulation = water(f"name: beam, {body}, {pose}", "buoyancy: {damping: 0.2}")
    tilts = []
    for _ in range(240 * 4):
        simulation.step()
        tilts.append(tilt(simulation, "beam"))
    assert bool(max(np.abs(tilts)) < math.radians(3.0)) is rights
    if not rights:
        assert max(np.abs(tilts)) > math.radians(20.0)


def tilt(simulation: Simulation, name: str) -> float:
    """Return how far its y axis leans to -x, rad."""
    x, y, _ = quaternion.rotate(simulation[name].transform.rotation, np.array([0.0, 1.0, 0.0]))
    return math.atan2(-x, y)


def test_a_beam_rolls_as_its_metacentre_says() -> None:
    """T = 2 pi sqrt(I / (m g GM)) for small angles (no added mass), within 0.2 %; energy is kept."""
    width, mass = 2.0, 500.0 * 2.0 * 6.0
    body = f"collider: {{box: {{size: [{width}, 1, 6]}}}}, body: {{}}, material: {{density: 500}}"
    simulation = water(f"name: beam, {body}, transform: {{rotation: {{axis: [0, 0, 1], angle: 1 deg}}}}")
    metacentric = width**2 / 6.0 - 0.25
    period = 2.0 * math.pi * math.sqrt(mass * (1.0 + width**2) / 12.0 / (mass * 9.81 * metacentric))
    energy, tilts = total_energy(simulation.world), []
    for _ in range(1200):
        simulation.step()
        tilts.append(tilt(simulation, "beam"))
    assert 2.0 * np.diff(crossings(np.arange(1200) / 240.0, np.array(tilts))) == pytest.approx(period, rel=2e-3)
    assert max(np.abs(tilts)) == pytest.approx(math.radians(1.0), rel=1e-3)
    assert total_energy(simulation.world) - energy == pytest.approx(0.0, abs=1e-4 * mass * 9.81 * 1.5e-4)


def test_half_as_dense_floats_half_submerged_and_as_dense_stays() -> None:
    """A ball, let go above, comes to rest with its centre at the surface; a neutral cone stays where it is."""
    simulation = water(
        """
        name: ball, collider: {sphere: {radius: 0.5}}, body: {}, material: {density: 500}, transform: {position: [0, 0.4, 0]}
        name: cone, collider: {cone: {radius: 0.5, length: 1}}, body: {}, transform: {position: [9, -2, 0], rotation: {axis: [1, 2, 0], angle: 1 rad}}
        """,  # noqa: E501
        "buoyancy: {damping: 4}",
    )
    start = +simulation["cone"].transform.position
    simulation.step(240 * 7)
    assert simulation["ball"].transform.position == pytest.approx([0.0, 0.0, 0.0], abs=1e-3)
    assert simulation["cone"].transform.position == pytest.approx(start, abs=1e-9)
    assert not simulation.world[Motion].linear[:, [0, 2]].any()


def test_all_colliders_of_a_body_float_together() -> None:
    """Two floats under a deck weigh and bear as what they are, wherever they are carried; it lies even at its draft."""
    simulation = water(
        """
        name: deck, collider: {box: {size: [4, 0.2, 2]}}, body: {}, material: {density: 500}, transform: {position: [0, 0.5, 0]}
        name: left, parent: {entity: deck, position: [-1.5, -0.5, 0]}, collider: {box: {size: [0.8, 0.8, 2]}}, material: {density: 300}
        name: right, parent: {entity: deck, position: [1.5, -0.5, 0]}, collider: {box: {size: [0.8, 0.8, 2]}}, material: {density: 300}
        """,  # noqa: E501
        "buoyancy: {damping: 8}",
    )
    mass = 500.0 * 1.6 + 2.0 * 300.0 * 1.28
    assert simulation["deck"].rigid_body.mass == pytest.approx(mass)
    simulation.step(240 * 4)
    draft = mass / (1000.0 * 2.0 * 1.6)
    assert simulation["deck"].transform.position == pytest.approx([0.0, 0.9 - draft, 0.0], abs=1e-3)
    found = loads(simulation)
    points = [at for at, name in zip(found.point, found.name, strict=True) if name == "buoyancy"]
    assert points == [pytest.approx([0.0, -draft / 2.0, 0.0], abs=1e-3)]


@pytest.mark.parametrize("damping", [0.0, 0.7, 1e9])
def test_drag_draws_to_the_current(damping: float) -> None:
    """Under water u falls off as dv/dt = -d u - k u^2 / m, k = rho Cd V^(2/3) / 2, spin likewise; never turned back."""
    body = f"collider: {{{CUBE}}}, body: {{}}, transform: {{position: [0, -9, 0]}}"
    motion = "motion: {linear: [3, 0, 0], angular: [0, 2, 0]}"
    law = f"buoyancy: {{damping: {damping}, drag_coefficient: 0.8, current: [1, 0, 0]}}"
    simulation = water(f"name: cube, {body}, {motion}", law)
    simulation.step(240)

    def after(start: float, coefficient: float) -> float:
        """Solve Bernoulli's equation for 1 s."""
        if damping == 0.0:
            return start / (1.0 + coefficient * start)
        left = math.exp(-damping)
        return start * left / (1.0 + coefficient * start * (1.0 - left) / damping)

    assert simulation["cube"].motion.linear == pytest.approx([1.0 + after(2.0, 0.4), 0.0, 0.0], rel=1e-5, abs=1e-9)
    assert simulation["cube"].motion.angular == pytest.approx([0.0, after(2.0, 2.4), 0.0], rel=1e-4, abs=1e-9)


def test_without_gravity_a_medium_has_no_surface() -> None:
    """It bears nobody and drags everybody."""
    motion = "transform: {position: [0, 9, 0]}, motion: {linear: [1, 0, 0]}"
    settings = "gravity: [0, 0, 0]"
    law = "buoyancy: {damping: 1, drag_coefficient: 0}"
    simulation = water(f"name: cube, collider: {{{CUBE}}}, body: {{}}, {motion}", law, settings=settings)
    assert total_energy(simulation.world) == pytest.approx(500.0)
    simulation.step(240)
    assert simulation["cube"].motion.linear == pytest.approx([math.exp(-1.0), 0.0, 0.0], rel=1e-12)


def test_the_ledger_tells_what_water_took() -> None:
    """Its entries are the change of energy to rounding, and buoyancy alone took it."""
    simulation = water(
        f"name: cube, collider: {{{CUBE}}}, body: {{mass: 600}}, motion: {{angular: [1, 2, 3]}}", "buoyancy: {}"
    )
    ledger, before = simulation.keep_ledger(), total_energy(simulation.world)
    simulation.step(480)
    change = total_energy(simulation.world) - before
    assert change < -100.0
    assert sum(ledger.since.values()) == pytest.approx(change, abs=1e-9 * abs(before))
    assert ledger.since["buoyancy"] == pytest.approx(change, rel=1e-3)
