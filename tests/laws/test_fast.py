"""Who is fast passes through nobody, and strikes nobody whom it only passes."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from onlookers import looked_on

from carom.ecs.spatial import quaternion
from carom.systems.continuous import Fast
from carom.systems.detection.answered import Answered
from carom.systems.shapes.geometry import Geometry
from carom.systems.shapes.mesh import Mesh
from carom.systems.simulation import Simulation

PHASES = range(20)
SMOOTH = {"restitution": 0.0, "friction": 0.0}
BALL, CUBE = {"sphere": {"radius": 0.005}}, {"box": {"size": (0.01, 0.01, 0.01)}}
PILL = {"capsule": {"radius": 0.005, "length": 0.01}}
WALL = {"box": {"size": (0.02, 2.0, 2.0)}}


def sheet() -> dict[str, Any]:
    """Return the collider of a wall as a mesh of twelve triangles."""
    corners = np.array([(x, y, z) for x in (-0.01, 0.01) for y in (-1.0, 1.0) for z in (-1.0, 1.0)])
    quads = np.array([(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)])
    return {"shape": Mesh(Geometry(corners, np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]])))}


def shot(
    phase: int, collider: dict[str, Any], wall: dict[str, Any], spin: tuple[float, float, float], *,
    late: bool = False, seen: bool = False,
) -> Simulation:  # fmt: skip
    """Return a world after six steps in which a bullet of 10 g flies at a wall of 2 cm at 300 m/s.

    Where it is ``late`` the wall comes into the world after the bullet. Where it is ``seen`` each
    system is run by itself.
    """
    simulation = looked_on(Simulation(gravity=(0.0, 0.0, 0.0)), seen)
    if not late:
        simulation.add(name="wall", material=SMOOTH, **wall)
    place = {"position": (-3.0 - phase / 20.0 * 5.0, 0.03, 0.02)}
    flies = {"linear": (300.0, 0.0, 0.0), "angular": spin}
    simulation.add(
        name="bullet", collider=collider, body={"mass": 0.01}, material=SMOOTH, transform=place, motion=flies
    )
    if late:
        simulation.add(name="wall", material=SMOOTH, **wall)
    simulation.step(6)
    return simulation


@pytest.mark.parametrize("phase", PHASES)
def test_a_bullet_stops_at_a_thin_wall(phase: int) -> None:
    """A ball of 1 cm, e = 0, stands at the wall wherever in a step it comes there."""
    bullet = shot(phase, BALL, {"collider": WALL}, (0.0, 0.0, 0.0))["bullet"]
    assert bullet.transform.position[0] == pytest.approx(-0.015, abs=1e-9)
    assert bullet.motion.linear[0] == pytest.approx(0.0, abs=1e-9)


def test_nobody_is_looked_after_who_is_fast_no_more() -> None:
    """A cube that flies at a wall is, until it has been stopped by hand."""
    simulation = shot(0, CUBE, {"collider": WALL}, (0.0, 0.0, 0.0))
    simulation["bullet"].transform.position, simulation["bullet"].motion.linear = (-3.0, 0.0, 0.0), (300.0, 0.0, 0.0)
    simulation.step()
    assert len(simulation.world[Fast].all.pairs) == 1
    simulation["bullet"].motion.linear = (0.0, 0.0, 0.0)
    simulation.step()
    assert len(simulation.world[Fast].all.pairs) == 0


@pytest.mark.parametrize("wall", [{"plane": {"normal": (-1.0, 0.0, 0.0)}}, WALL])
def test_nobody_looks_after_balls_whose_impacts_are_exact(wall: dict[str, Any]) -> None:
    """One that flies at a wall or a half space strikes it at the time on its arc; a cube there is looked after."""
    for collider, number in ((BALL, 0), (CUBE, 1)):
        simulation = shot(0, collider, {"collider": wall}, (0.0, 0.0, 0.0))
        bullet = simulation["bullet"]
        bullet.transform.position, bullet.motion.linear = (-3.0, 0.0, 0.0), (300.0, 0.0, 0.0)
        simulation.step()
        assert len(simulation.world[Fast].all.pairs) == number


@pytest.mark.parametrize("phase", PHASES)
@pytest.mark.parametrize("collider", [CUBE, PILL])
def test_what_tumbles_does_not_pass_either(collider: dict[str, Any], phase: int) -> None:
    """However it is turned when it comes there, and although it turns about the corner that strikes first."""
    bullet = shot(phase, collider, {"collider": WALL}, (3.0, 40.0, 25.0))["bullet"]
    assert bullet.transform.position[0] < 0.0
    assert np.linalg.norm(bullet.motion.linear) < 300.0


@pytest.mark.parametrize("wall", ["box", "mesh"])
@pytest.mark.parametrize("phase", PHASES)
def test_a_ball_of_10_cm_does_not_cross_a_wall_of_2_cm(wall: str, phase: int) -> None:
    """At 10 m/s it comes 17 cm a step: wherever it starts, it goes back as fast as it came, e = 1."""
    hard, simulation = {"restitution": 1.0, "friction": 0.0}, Simulation(gravity=(0.0, 0.0, 0.0))
    simulation.add(collider=WALL if wall == "box" else sheet(), material=hard)
    ball = simulation.add(
        collider={"sphere": {"radius": 0.1}}, body={"mass": 1.0}, material=hard,
        transform={"position": (-1.0 - phase / 120.0, 0.03, 0.02)}, motion={"linear": (10.0, 0.0, 0.0)},
    )  # fmt: skip
    simulation.step(30)
    flown = 10.0 * simulation.time - (0.89 + phase / 120.0)
    assert simulation[ball].transform.position[0] == pytest.approx(-0.11 - flown, abs=1e-9)
    assert simulation[ball].motion.linear == pytest.approx([-10.0, 0.0, 0.0], abs=1e-9)


def test_balls_that_only_turn_and_points_need_nobody_to_look() -> None:
    """A ball that spins at 300 rad/s on a mesh is as it is at rest; a point is taken for a ball of 1 mm."""
    for collider in ({"sphere": {"radius": 0.1}}, {"point": {}}):
        simulation = Simulation(gravity=(0.0, 0.0, 0.0))
        simulation.add(collider=sheet(), material=SMOOTH)
        simulation.add(
            collider=collider, body={"mass": 1.0, "inertia": (1.0, 1.0, 1.0)}, material=SMOOTH,
            transform={"position": (-0.11 if "sphere" in collider else -0.0101, 0.03, 0.02)},
            motion={"linear": (0.0, 0.01, 0.0), "angular": (200.0, 200.0, 100.0)},
        )  # fmt: skip
        simulation.step(10)
        assert simulation.world[Answered].detections == 10


def test_who_is_given_up_is_counted(monkeypatch: pytest.MonkeyPatch) -> None:
    """With no looks at all tumbling cubes pass through a mesh; of each the count says that it may have."""
    monkeypatch.setattr("carom.systems.response.MOST_LOOKS", 0)
    shots = [shot(phase, CUBE, {"collider": sheet()}, (3.0, 40.0, 25.0), seen=True) for phase in PHASES]
    through = [simulation for simulation in shots if simulation["bullet"].transform.position[0] > 0.0]
    assert through
    assert all(simulation.world[Answered].looks_cut for simulation in through)


@pytest.mark.parametrize("phase", range(0, 20, 5))
def test_nor_through_a_mesh(phase: int) -> None:
    """Triangles have no inside: who is through is through.

    Whoever came first into the world, to 1 mm of the 3 m that it flies back: points are found as seen from either.
    """
    first, last = (
        shot(phase, CUBE, {"collider": sheet()}, (3.0, 40.0, 25.0), late=late)["bullet"] for late in (False, True)
    )
    assert first.transform.position[0] < 0.0
    assert last.transform.position == pytest.approx(first.transform.position, abs=1e-3)


@pytest.mark.parametrize("collider", [BALL, CUBE, PILL])
@pytest.mark.parametrize("phase", [0, 7, 13])
def test_a_free_wall_takes_the_momentum(collider: dict[str, Any], phase: int) -> None:
    """10 g at 300 m/s, e = 0, drive 10 kg to 0.01 x 300 / 10.01 m/s, within 1e-3 of it: it is struck off centre."""
    simulation = shot(phase, collider, {"collider": WALL, "body": {"mass": 10.0}}, (0.0, 0.0, 0.0))
    assert simulation["wall"].motion.linear[0] == pytest.approx(3.0 / 10.01, rel=1e-3)
    momentum = 10.0 * simulation["wall"].motion.linear[0] + 0.01 * simulation["bullet"].motion.linear[0]
    assert momentum == pytest.approx(3.0, rel=1e-12)


@pytest.mark.parametrize("phase", PHASES)
@pytest.mark.parametrize("shape", ["box", "capsule"])
def test_a_turning_rod_does_not_pass_a_post(shape: str, phase: int) -> None:
    """2 m long, at 100 rad/s: its end goes 1.7 m in a step; e = 0, so it stands at the post."""
    simulation = Simulation(gravity=(0.0, 0.0, 0.0))
    simulation.add(
        collider={"box": {"size": (0.1, 2.0, 0.1)}}, transform={"position": (0.8, 0.0, 0.0)}, material=SMOOTH
    )
    turn = quaternion.from_axis_angle(np.array([0.0, 1.0, 0.0]), np.array(0.7 + phase * math.pi / 10.0))
    rod: dict[str, Any] = {"box": {"size": (2.0, 0.05, 0.05)}}
    if shape == "capsule":
        rod = {"capsule": {"radius": 0.025, "length": 1.95}}
        turn = quaternion.multiply(turn, quaternion.from_axis_angle(np.array([0.0, 0.0, 1.0]), np.array(0.5 * math.pi)))
    body = {"mass": 1.0, "locked": ["x", "y", "z"]}
    simulation.add(
        name="rod", collider=rod, body=body, material=SMOOTH, transform={"rotation": turn},
        motion={"angular": (0.0, 100.0, 0.0)},
    )  # fmt: skip
    simulation.step(8)
    assert simulation["rod"].motion.angular == pytest.approx([0.0, 0.0, 0.0], abs=1e-6)


@pytest.mark.parametrize("collider", [BALL, CUBE])
def test_two_bullets_swap_their_velocities(collider: dict[str, Any]) -> None:
    """Head-on at 300 m/s, e = 1, wherever in a step they meet."""
    for phase in range(5):
        simulation = Simulation(gravity=(0.0, 0.0, 0.0))
        for name, side in (("left", -1.0), ("right", 1.0)):
            simulation.add(
                name=name, collider=collider, body={"mass": 0.01}, material={"restitution": 1.0, "friction": 0.0},
                transform={"position": (side * (3.0 + 0.7 * phase), 0.0, 0.0)},
                motion={"linear": (-side * 300.0, 0.0, 0.0)},
            )  # fmt: skip
        simulation.step(3)
        assert simulation["left"].motion.linear == pytest.approx([-300.0, 0.0, 0.0], abs=1e-6)
        assert simulation["right"].motion.linear == pytest.approx([300.0, 0.0, 0.0], abs=1e-6)


def test_who_falls_and_turns_beside_a_wall_is_found_once_a_step() -> None:
    """A cube that glides along it 1 cm away, at 12 m/s and 10 rad/s: its contacts stay on the face, and it goes on."""
    simulation = Simulation(gravity=(0.0, 0.0, 0.0))
    simulation.add(collider={"box": {"size": (1.0, 8.0, 8.0)}}, material=SMOOTH)
    place, falls = {"position": (0.76, 2.0, 0.0)}, {"linear": (0.0, -12.0, 0.0), "angular": (10.0, 0.0, 0.0)}
    cube = simulation.add(collider={"box": {"size": (0.5, 0.5, 0.5)}}, body={}, transform=place, motion=falls)
    simulation.step(10)
    assert simulation.world[Fast].all.asked.tolist() == [True]
    assert simulation.world[Answered].detections == 10
    assert simulation[cube].motion.linear == pytest.approx(falls["linear"], abs=1e-12)
    assert simulation[cube].transform.position == pytest.approx((0.76, 0.0, 0.0), abs=1e-12)


@pytest.mark.parametrize("spin", [(0.0, 0.0, 0.0), (0.0, 0.0, 20.0)])
def test_who_only_passes_strikes_nobody(spin: tuple[float, float, float]) -> None:
    """A cube that flies 3 cm over an edge of another goes straight on, although from afar it seemed to strike it."""
    simulation = Simulation(gravity=(0.0, 0.0, 0.0))
    simulation.add(collider={"box": {"size": (1.0, 1.0, 1.0)}}, material=SMOOTH)
    place, flies = {"position": (-3.3, 0.6, 0.0)}, {"linear": (300.0, 0.0, 0.0), "angular": spin}
    simulation.add(name="passer", collider={"box": {"size": (0.1, 0.1, 0.1)}}, body={}, transform=place, motion=flies)
    simulation.step(3)
    assert simulation["passer"].motion.linear == pytest.approx([300.0, 0.0, 0.0], abs=1e-12)
    assert simulation["passer"].motion.angular == pytest.approx(spin, abs=1e-12)


def test_between_moving_bodies_it_is_a_choice() -> None:
    """Two tumbling cubes at 300 m/s each miss each other on the way, but not if one is ``continuous``."""
    after = []
    for continuous in (False, True):
        parted = 0
        for phase in range(8):
            simulation = Simulation(gravity=(0.0, 0.0, 0.0))
            for side in (-1.0, 1.0):
                simulation.add(
                    name=f"{side:g}", collider=CUBE, body={"mass": 0.01, "continuous": continuous}, material=SMOOTH,
                    transform={"position": (side * (3.0 + 0.31 * phase), 0.001 * side, 0.0)},
                    motion={"linear": (-side * 300.0, 0.0, 0.0), "angular": (30.0, 200.0 * side, 100.0)},
                )  # fmt: skip
            simulation.step(4)
            parted += simulation["-1"].transform.position[0] < simulation["1"].transform.position[0]
        after.append(parted)
    assert after[1] == 8
    assert after[0] < 8
