"""What the resting stage tells of itself is true, and telling it changes no bit."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from heaps import bin_of_balls, hashes, stack_of_boxes

from carom.ecs import RigidBody
from carom.ecs.components.flight import Flight
from carom.ecs.relations.contact import Contact
from carom.systems import resting
from carom.systems.constants import RELAX_SWEEPS
from carom.systems.kernels.packing import ANGULAR, INVERSE, VELOCITY
from carom.systems.resting import Resting, Stage
from carom.systems.simulation import Simulation
from carom.systems.solving import Solving, Sweep

GRAVITY = 10.0  # m/s2


def on_the_ground(speed: tuple[float, float, float] = (0.0, 0.0, 0.0), **words: Any) -> Simulation:
    """Return a world with one body that lies on the ground."""
    simulation = Simulation(dt=1 / 100, gravity=(0.0, -GRAVITY, 0.0), sleeping=False)
    simulation.add(collider={"plane": {}})
    simulation.add(name="body", body={}, transform={"position": (0.0, 0.5, 0.0)}, motion={"linear": speed}, **words)
    return simulation


def last(solving: Solving) -> Sweep:
    """Return the last sweep of a step."""
    return solving.sweeps[-1]


@pytest.mark.parametrize(
    "make", [lambda: stack_of_boxes(sleeping=False), lambda: bin_of_balls(40), lambda: bin_of_balls(20, threads=2)]
)
def test_looking_on_changes_no_bit(make: Any) -> None:
    """Also when it begins and ends in the middle of a run."""
    plain, watched = make(), make()
    assert hashes(plain, 20) == hashes(watched, 20)
    solving = Solving(watched)
    assert hashes(plain, 60) == hashes(watched, 60)
    assert solving.sweeps
    solving.close()
    assert hashes(plain, 5) == hashes(watched, 5)
    assert not watched.hearers


def test_every_sweep_is_told_in_order() -> None:
    """Of each substep one of solving and those of relaxing, each stage with how it was before."""
    simulation = on_the_ground(collider={"box": {"size": (1, 1, 1)}})
    solving = Solving(simulation)
    simulation.step(3)
    each = [("solve", 0), ("solve", 1), *(("relax", number) for number in range(RELAX_SWEEPS + 1))]
    assert [(sweep.stage, sweep.number) for sweep in solving.sweeps] == 4 * each
    assert [sweep.part for sweep in solving.sweeps] == sorted([1, 2, 3, 4] * len(each))
    assert [sweep.time for sweep in solving.sweeps[:: len(each)]] == pytest.approx([0.0225, 0.025, 0.0275, 0.03])


def test_the_residual_of_one_point_is_how_fast_it_closes() -> None:
    """It falls for one substep, g h fast; one sweep solves one point exactly, and next time the warm start does."""
    simulation = on_the_ground(collider={"sphere": {"radius": 0.5}})
    solving = Solving(simulation)
    simulation.step()
    cold, solved = solving.sweeps[:2]
    assert cold.residual == cold.residual_sum == pytest.approx(GRAVITY / 400, rel=1e-12)
    assert solved.residual < 1e-17
    assert (cold.open, solved.open) == (1, 0)
    simulation.step()
    assert solving.sweeps[0].residual < 1e-15
    assert solving.sweeps[0].open == 0


LEANS = {"rotation": (0.0, 0.0, np.sin(0.2), np.cos(0.2))}


@pytest.mark.parametrize("locked", [["rotation_y"], []])
@pytest.mark.parametrize(
    ("collider", "place"),
    [
        ({"box": {"size": (1.0, 1.0, 1.4)}}, {"position": (0.0, 0.5, 0.0)}),
        ({"capsule": {"radius": 0.3, "length": 0.8}}, {"position": (0.0, 0.3 + 0.4 * np.cos(0.4), 0.0), **LEANS}),
    ],
)
def test_what_sticks_neither_slips_nor_spins_after_one_sweep(collider: Any, place: Any, locked: list[str]) -> None:
    """Friction is found in the frame of the manifold, before bodies are moved: as if they had been.

    What cannot spin, or touches at one point, where nothing keeps it from that, does not slip; of the other the twist
    that ends its spin comes last, and moves what is off the normal.
    """
    simulation = Simulation(dt=1 / 100, gravity=(0.0, -GRAVITY, 0.0), sleeping=False)
    simulation.add(collider={"plane": {}}, material={"friction": 100.0})
    turned = {"inertia": (0.3, 0.5, 0.6), "principal_axes": (0.1, 0.5, 0.3, np.sqrt(0.65))}
    body = {"mass": 3.0, "center_of_mass": (0.2, -0.1, 0.3), "locked": locked, **turned}
    motion = {"linear": (0.01, -0.01, 0.02), "angular": (0.03, 0.0 if locked else 0.04, -0.05)}
    simulation.add(collider=collider, body=body, material={"friction": 100.0}, transform=place, motion=motion)
    solver, contact = simulation.world[Resting], simulation.world[Contact]
    (row,) = simulation.world.row_numbers(RigidBody)
    found: list[Any] = []

    def look(stage: Stage, number: int) -> None:
        """Note how the surface slips at the middle of the points, and spins."""
        if stage.name == "solve" and not found[1:]:
            assert number == len(found)
            middle = contact.point[: contact.count].mean(axis=0) - simulation.world[Flight].center[row]
            velocity, angular = solver.bodies[VELOCITY, row, :3], solver.bodies[VELOCITY, row, ANGULAR : ANGULAR + 3]
            slip = velocity + np.cross(angular, middle)
            twisted = np.cross(solver.bodies[INVERSE, row, [1, 3, 4]], middle)  # by a unit twist about the normal
            found.append((slip[[0, 2]], twisted[[0, 2]], float(angular[1])))

    solver.hearers.append(look)
    simulation.step()
    (before, _, _), (slip, twisted, spin) = found
    assert np.abs(before).min() > 1e-4
    assert np.abs(slip).max() < 1e-15 or not (locked or contact.count == 1)
    assert abs(spin) < 1e-15 or contact.count == 1
    assert abs(slip[0] * twisted[1] - slip[1] * twisted[0]) < 1e-15


@pytest.mark.parametrize("upper", [1.0, 3.0, 9.0])
def test_the_residual_falls_as_fast_as_theory_says(upper: float, monkeypatch: pytest.MonkeyPatch) -> None:
    """Of a ball on another, of m and M: a sweep of Gauss and Seidel's method leaves the part M / (m + M) of it."""
    simulation = on_the_ground(collider={"sphere": {"radius": 0.5}}, material={"density": 6.0 / np.pi})
    place = {"position": (0.0, 1.5, 0.0)}
    simulation.add(collider={"sphere": {"radius": 0.5}}, body={"mass": upper}, transform=place)
    monkeypatch.setattr(resting, "relax_sweeps", lambda substeps: 10)
    solving = Solving(simulation)
    simulation.step(2)
    _, relaxing, *_ = (k for k, sweep in enumerate(solving.sweeps) if sweep.number == 0)
    sweeps = solving.sweeps[relaxing : relaxing + 11]
    left = np.array([sweep.residual for sweep in sweeps])
    assert [sweep.number for sweep in sweeps] == list(range(11))
    assert left[1] > 1e-5
    assert left[2:] / left[1:-1] == pytest.approx(upper / (1.0 + upper), rel=1e-9)
    assert [sweep.residual_sum for sweep in sweeps[1:]] == pytest.approx(left[1:], rel=1e-9)


BOX = {"collider": {"box": {"size": (1, 1, 1)}}}


@pytest.mark.parametrize(
    ("world", "limits"),
    [
        (on_the_ground(**BOX), {}),
        (on_the_ground((1.0, 0.0, 0.0), **BOX), {"sliding": 1}),
        (on_the_ground((1.0, 0.0, 0.0), material={"friction": 0.0}, **BOX), {}),
        (on_the_ground((3.0, 0.0, 0.0), collider={"sphere": {"radius": 0.5}}), {"sliding": 1}),
    ],
)
def test_limits_are_told_when_they_are_at_work(world: Simulation, limits: dict[str, int]) -> None:
    """Friction of what slides, none of what lies or has none."""
    solving = Solving(world)
    world.step(3)
    found = {
        name: value for name in ("pushed", "sliding", "spinning", "rolling") if (value := getattr(last(solving), name))
    }
    assert found == limits


def test_a_box_that_turns_on_its_spot_twists_with_all_that_its_points_may() -> None:
    """Of a ball that touches at a point nothing is to twist: it turns for ever."""
    for collider, limits in ((BOX["collider"], (1, 1)), ({"sphere": {"radius": 0.5}}, (0, 0))):
        simulation = on_the_ground(collider=collider)
        simulation["body"].motion.angular = (0.0, 3.0, 0.0)
        solving = Solving(simulation)
        simulation.step(3)
        assert (last(solving).sliding, last(solving).spinning) == limits


def test_rolling_and_spinning_have_limits_too() -> None:
    """Of a ball that rolls, and of one that turns on its spot, until it stands."""
    ball = {"collider": {"sphere": {"radius": 0.5}}}
    rolls = on_the_ground((0.1, 0.0, 0.0), material={"rolling_friction": 0.01}, **ball)
    rolls["body"].motion.angular = (0.0, 0.0, -0.2)
    turns = on_the_ground(material={"spinning_friction": 0.05}, **ball)
    turns["body"].motion.angular = (0.0, 2.0, 0.0)
    for simulation, limit in ((rolls, "rolling"), (turns, "spinning")):
        solving = Solving(simulation)
        simulation.step(3)
        assert getattr(last(solving), limit) == 1
        simulation.step(200)
        assert np.linalg.norm(simulation["body"].motion.angular) < 1e-9
        assert getattr(last(solving), limit) == 0


def test_overlap_that_leaves_at_the_highest_speed_is_told() -> None:
    """A ball in the ground: its overlap times the rate is more than 3 m/s where it is deeper than 15 cm."""
    simulation = on_the_ground(collider={"sphere": {"radius": 0.5}})
    solving, told = Solving(simulation), []
    simulation["body"].transform.position = (0.0, 0.0, 0.0)
    for _ in range(20):
        deep = 0.5 - simulation["body"].transform.position[1] > 3.0 / (0.05 * 400)
        simulation.step()
        assert solving.sweeps[0].pushed == int(deep)
        told.append(deep)
    assert {True, False} == set(told)


def test_levels_hold_what_rests() -> None:
    """Those of a row of boxes on the ground are one, since none shares a body with another; a tower has several."""
    row = Simulation(sleeping=False)
    row.add(collider={"plane": {}})
    row.add_many([(2.0 * k, 0.5, 0.0) for k in range(20)], collider={"box": {"size": (1, 1, 1)}}, body={})
    solving = Solving(row)
    row.step(2)
    assert [level[2:] for level in solving.levels if level.part == 1] == [(0, 3, 20, 80)]
    tower = stack_of_boxes(sleeping=False)
    tower.step(200)
    solving = Solving(tower)
    tower.step()
    (*upper, _) = levels = [level for level in solving.levels if level.part == 4]
    assert len(upper) >= 2
    assert sum(level.manifolds for level in levels) == 4
    assert sum(level.points for level in levels) == tower.world[Contact].count


def test_only_who_has_contacts_or_joints_is_packed() -> None:
    """Who lies and who hangs, not who flies; and who lands from then on."""
    simulation = on_the_ground(collider={"box": {"size": (1.0, 1.0, 1.0)}})
    ball: dict[str, Any] = {"body": {}, "collider": {"sphere": {"radius": 0.1}}}
    hung = simulation.add(transform={"position": (5.0, 5.0, 0.0)}, **ball)
    simulation.add(joint={"ball": {"b": int(hung), "at": (5.0, 6.0, 0.0)}})
    lands = simulation.add(transform={"position": (9.0, 0.3, 0.0)}, **ball)
    simulation.add(transform={"position": (13.0, 9.0, 0.0)}, **ball)
    world = simulation.world

    def packed() -> list[int]:
        return world[resting.Resting].rows(world).tolist()

    simulation.step()
    assert packed() == [world.row(world.find("body")), world.row(hung)]
    simulation.step(30)
    assert packed() == [world.row(world.find("body")), world.row(hung), world.row(lands)]
