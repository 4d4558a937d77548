"""Impacts and friction of bodies with locked axes obey the laws with what is free."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from locked import ROTATIONS, SHAPES, askew

from carom.ecs.spatial import quaternion
from carom.systems.energy import momentum, total_energy
from carom.systems.freedom import AXES
from carom.systems.simulation import Simulation

G = 9.81


@pytest.mark.parametrize("friction", [0.0, 0.1])
@pytest.mark.parametrize("striker", [{"sphere": {"radius": 0.1}}, {"capsule": {"radius": 0.1, "length": 0.4}}])
def test_a_box_on_a_rail_is_struck_obliquely(striker: dict[str, Any], friction: float) -> None:
    """J = (1 + e) v_n / (1/m + n_x^2 / M): the rail takes the rest; momentum along it is kept to rounding."""
    angle, mass, heavy, e = math.radians(30.0), 0.5, 3.0, 0.7
    normal = np.array([math.cos(angle), math.sin(angle), 0.0])
    simulation = Simulation(dt=1 / 240, gravity=(0.0, 0.0, 0.0))
    surface = {"friction": friction, "restitution": e}
    rail = simulation.add(
        collider={"box": {"size": (0.5, 2.0, 2.0)}},
        body={"mass": heavy, "locked": ["y", "z", *ROTATIONS]},
        material=surface,
        transform={"rotation": (0.0, 0.0, math.sin(0.5 * angle), math.cos(0.5 * angle))},
    )
    turned = quaternion.from_axis_angle((1.0, 0.0, 0.0), 0.5 * math.pi)
    start = np.array([-3.0, -0.4, 0.0])
    ball = simulation.add(
        collider=striker,
        body={"mass": mass, "locked": ROTATIONS},
        material=surface,
        transform={"position": 0.55 * normal, "rotation": turned},
        motion={"linear": start},
    )
    before = momentum(simulation.world)
    simulation.step(30)
    slip = start - (start @ normal) * normal
    along = slip / np.linalg.norm(slip)
    # The rubbing impulse is at the edge of the cone: J = j (n - mu t).
    way = normal - friction * along
    yields = normal @ way / mass + normal[0] * way[0] / heavy
    impulse = -(1.0 + e) * (start @ normal) / yields
    assert simulation[ball].motion.linear == pytest.approx(start + impulse * way / mass, abs=1e-11)
    assert simulation[rail].motion.linear.tolist() == pytest.approx([-impulse * way[0] / heavy, 0.0, 0.0], abs=1e-11)
    assert momentum(simulation.world)[0] == pytest.approx(before[0], abs=1e-12)


@pytest.mark.parametrize("friction", [0.05, 10.0])
@pytest.mark.parametrize("locks", [ROTATIONS, ["z", *ROTATIONS], ["z", "rotation_x", "rotation_y"]])
@pytest.mark.parametrize("shape", ["sphere", "capsule"])
def test_an_impact_on_a_rough_wall(shape: str, locks: list[str], friction: float) -> None:
    """Friction takes min(mu J, m_t v_t), m_t the mass that slides: m, or 2/7 m of a ball that may turn (z only)."""
    speed, e = np.array([0.6, -2.0, 0.0]), 0.5
    simulation = Simulation(dt=1 / 240, gravity=(0.0, 0.0, 0.0))
    surface = {"friction": friction, "restitution": e}
    simulation.add(collider={"plane": {}}, material=surface)
    form: dict[str, Any] = {"sphere": {"radius": 0.1}}
    if shape == "capsule":
        form = {"capsule": {"radius": 0.1, "length": 0.3}}
    ball = simulation.add(
        collider=form,
        body={"mass": 1.0, "inertia": (0.004, 0.004, 0.004), "locked": locks},
        material=surface,
        transform={
            "position": (0.0, 0.12, 0.0),
            "rotation": quaternion.from_axis_angle((1.0, 0.0, 0.0), 0.5 * math.pi),
        },
        motion={"linear": speed},
    )
    simulation.step(10)
    turns = "rotation_z" not in locks
    slides = 1.0 / (1.0 + 0.01 / 0.004) if turns else 1.0
    impulse = min(friction * (1.0 + e) * 2.0, slides * 0.6)
    body = simulation[ball]
    assert body.motion.linear == pytest.approx([0.6 - impulse, e * 2.0, 0.0], abs=1e-11)
    assert body.motion.angular == pytest.approx([0.0, 0.0, -impulse * 0.1 / 0.004 if turns else 0.0], abs=1e-11)


def test_a_ball_that_cannot_turn_slides_and_never_rolls() -> None:
    """It slows by mu g to its stop, v^2 / (2 mu g) away; the way is right to the substep in which it stops."""
    simulation = Simulation(dt=1 / 240)
    simulation.add(collider={"plane": {"offset": -0.1}}, material={"friction": 0.2})
    ball = simulation.add(
        collider={"sphere": {"radius": 0.1}},
        body={"locked": ROTATIONS},
        material={"friction": 0.2},
        motion={"linear": (2.0, 0.0, 0.0)},
    )
    simulation.step(120)
    assert simulation[ball].motion.linear == pytest.approx([2.0 - 0.2 * G * 0.5, 0.0, 0.0], abs=1e-9)
    simulation.step(240)
    assert simulation[ball].motion.linear == pytest.approx([0.0, 0.0, 0.0], abs=1e-12)
    assert simulation[ball].transform.position[0] == pytest.approx(2.0**2 / (2.0 * 0.2 * G), rel=1e-4)


def test_a_bead_on_a_level_rail_lies_on_a_slope_without_sinking_or_sliding() -> None:
    """The rail carries its weight: nothing moves it along x, and the slope presses it by nothing."""
    simulation = Simulation()
    slope = simulation.add(collider={"plane": {"normal": (0.6, 0.8, 0.0), "offset": -0.1}})
    bead = simulation.add(collider={"sphere": {"radius": 0.1}}, body={"locked": ["y", "z"]})
    simulation.step(60)
    assert simulation[bead].motion.linear == pytest.approx([0.0, 0.0, 0.0], abs=1e-12)
    assert slope != bead


@pytest.mark.parametrize("restitution", [1.0, 0.6])
def test_impacts_of_bodies_with_locks_give_no_energy(restitution: float) -> None:
    """Whatever is locked, rough bodies in a closed room lose energy, but for the error of turning."""
    simulation = room(restitution)
    energy = first = total_energy(simulation.world)
    for _ in range(720):
        simulation.step()
        now = total_energy(simulation.world)
        assert now <= energy + 1e-6 * first
        energy = now
    assert energy < (0.95 if restitution == 1.0 else 0.4) * first


def room(restitution: float, share: float = 0.3) -> Simulation:
    """Return bodies with locks of their own that fly about in a closed room."""
    generator = np.random.default_rng(6)
    simulation = Simulation(dt=1 / 120, gravity=(0.0, 0.0, 0.0))
    rough = {"friction": 0.4, "restitution": restitution}
    for axis in range(3):
        for side in (-1.0, 1.0):
            normal = tuple(side * np.eye(3)[axis])
            simulation.add(collider={"plane": {"normal": normal, "offset": -1.5}}, material=rough)
    for number, place in enumerate(np.indices((3, 3, 3)).reshape(3, -1).T):
        locked = [axis for axis in AXES if generator.uniform() < share]
        free = np.array([axis not in locked for axis in AXES], np.float64)
        simulation.add(
            collider=SHAPES[number % len(SHAPES)],
            body={"locked": locked},
            material=rough,
            transform={"position": place - 1.0, "rotation": askew(generator)},
            motion={
                "linear": 2.0 * generator.normal(size=3) * free[:3],
                "angular": generator.normal(size=3) * free[3:],
            },
        )
    return simulation


def test_a_kinematic_wall_passes_through_what_is_locked_in_its_way() -> None:
    """No impulse could part them; none is given, and nothing is hurled along the free axis."""
    simulation = Simulation(dt=1 / 240, gravity=(0.0, 0.0, 0.0))
    bead = simulation.add(collider={"sphere": {"radius": 0.1}}, body={"locked": ["x", "z"]})
    box = {"box": {"size": (0.2, 0.2, 0.2)}}
    block = simulation.add(collider=box, body={"locked": ["x", *ROTATIONS]}, transform={"position": (0.0, 0.0, 1.0)})
    tilt = {"rotation": (0.0, 0.0, 1e-5, 1.0), "position": (-0.5, 0.0, 0.5)}
    wall = {"box": {"size": (0.2, 4.0, 4.0)}}
    simulation.add(collider=wall, body={"type": "kinematic"}, motion={"linear": (2.0, 0.0, 0.0)}, transform=tilt)
    simulation.step(120)
    for entity in (bead, block):
        assert simulation[entity].motion.linear == pytest.approx([0.0, 0.0, 0.0], abs=1e-2)
        assert simulation[entity].transform.position[0] == 0.0


def test_sliding_across_a_rail_stops_what_slides_along_it_and_no_more() -> None:
    """A ball on a rail strikes a belt that runs across it: friction never turns its way along the rail round."""
    simulation = Simulation(dt=1 / 240, gravity=(0.0, 0.0, 0.0))
    surface = {"friction": 1.0, "restitution": 1.0}
    belt = {"box": {"size": (4.0, 0.2, 40.0)}}
    simulation.add(
        collider=belt,
        body={"type": "kinematic"},
        motion={"linear": (0.0, 0.0, 0.5)},
        material=surface,
        transform={"position": (0.0, -0.1, 0.0)},
    )
    start = np.array([1.0, -5.0, 0.0])
    ball = simulation.add(
        collider={"sphere": {"radius": 0.1}},
        body={"mass": 1.0, "locked": ["z", *ROTATIONS]},
        material=surface,
        transform={"position": (0.0, 0.11, 0.0)},
        motion={"linear": start},
    )
    simulation.step(10)
    assert simulation[ball].motion.linear == pytest.approx([0.0, 5.0, 0.0], abs=1e-12)
