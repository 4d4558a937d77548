"""Kinematics: poses from joints and back, for arms that step would hold in just these poses."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from carom.ecs import DeclarationError
from carom.ecs.components.joint import FREE, LIMITED, LINE, LOCKED, SWING_TWIST, Joint
from carom.ecs.spatial import quaternion
from carom.systems.kinematics import Kinematics
from carom.systems.simulation import Simulation

HALF = math.sqrt(0.5)
ABOUT = {"x": (0.0, 0.0, 0.0, 1.0), "y": (0.0, 0.0, HALF, HALF), "z": (0.0, -HALF, 0.0, HALF)}  # x to that axis
BEND = (-2.5, 2.5)


def arm(axes: str, limits: tuple[float, float] | None = None) -> Simulation:
    """Return links of 1 m along x on hinges about these axes, the first at the world's origin, the last one 'hand'."""
    simulation, before = Simulation(gravity=(0.0, 0.0, 0.0)), -1
    for number, axis in enumerate(axes):
        name = "hand" if number == len(axes) - 1 else f"link{number}"
        link = simulation.add(
            name=name, body={"mass": 1.0, "inertia": (0.1, 0.1, 0.1)}, transform={"position": (number + 0.5, 0.0, 0.0)}
        )
        hinge(simulation, before, int(link), (0.0 if before < 0 else 0.5, 0.0, 0.0), axis, limits, f"joint{number}")
        before = int(link)
    return simulation


def hinge(
    simulation: Simulation, a: int, b: int, anchor_a: Any, axis: str, limits: tuple[float, float] | None, name: str
) -> None:
    """Hold the left end of b to a by a hinge."""
    turns = FREE if limits is None else LIMITED
    lower, upper = (0.0, 0.0) if limits is None else limits
    simulation.world.spawn(
        Joint(
            a=a, b=b, anchor_a=anchor_a, anchor_b=(-0.5, 0.0, 0.0), frame_a=ABOUT[axis], frame_b=ABOUT[axis],
            mode=(LOCKED, LOCKED, LOCKED, turns, LOCKED, LOCKED), lower=(0.0, 0.0, 0.0, lower, 0.0, 0.0),
            upper=(0.0, 0.0, 0.0, upper, 0.0, 0.0), driven=(False, False, False, True, False, False),
        ),
        name=name,
    )  # fmt: skip


TIP = (0.5, 0.0, 0.0)


def test_a_plane_arm_is_where_its_angles_add_up_to() -> None:
    """Sum of cosines and sines of the sums of angles."""
    kinematics = Kinematics(arm("zzz"))
    angles = np.array([0.3, -0.9, 2.0])
    place, turn = kinematics.pose("hand", angles, TIP)
    sums = np.cumsum(angles)
    assert place == pytest.approx([np.cos(sums).sum(), np.sin(sums).sum(), 0.0], abs=1e-14)
    assert turn == pytest.approx(quaternion.from_axis_angle((0.0, 0.0, 1.0), sums[-1]), abs=1e-14)


def wild(seed: int) -> Simulation:
    """Return a tree of six bodies on joints with all kinds of ways, some the other way round, on a turned base."""
    simulation, chance = Simulation(gravity=(0.0, 0.0, 0.0)), np.random.default_rng(seed)
    base = simulation.add(
        name="base", transform={"position": (1.0, 2.0, 3.0), "rotation": quaternion.normalise(chance.normal(size=4))}
    )
    links = [int(base)]
    for number in range(6):
        link = simulation.add(name=f"link{number}", body={"mass": 1.0, "inertia": (0.1, 0.1, 0.1)})
        ends = [links[chance.integers(len(links))], int(link)]
        a, b = ends if chance.random() < 0.5 else ends[::-1]
        free = chance.random(6) < 0.4
        simulation.world.spawn(
            Joint(
                a=a, b=b, anchor_a=chance.normal(size=3), anchor_b=chance.normal(size=3),
                frame_a=quaternion.normalise(chance.normal(size=4)),
                frame_b=quaternion.normalise(chance.normal(size=4)),
                mode=np.where(free, FREE, LOCKED), lower=np.where(free, 0.0, 0.3 * chance.normal(size=6)),
            ),
            name=f"joint{number}",
        )  # fmt: skip
        links.append(int(link))
    return simulation


@pytest.mark.parametrize("seed", range(8))
def test_what_is_placed_is_measured_and_held(seed: int) -> None:
    """Positions come back from the poses, and the solver finds nothing to mend: every joint is where it was put."""
    simulation = wild(seed)
    kinematics = Kinematics(simulation, "base")
    asked = np.random.default_rng(seed).uniform(-1.4, 1.4, len(kinematics.slots))
    kinematics.place(asked)
    assert kinematics.positions() == pytest.approx(asked, abs=1e-12)
    world = simulation.world
    simulation.step()
    joint, rows = world[Joint], world.slots.rows(kinematics.joints)
    assert joint.position[rows, kinematics.slots] == pytest.approx(asked, abs=1e-9)
    every = world.row_numbers(Joint)
    locked = joint.mode[every] == LOCKED
    assert joint.position[every][locked] == pytest.approx(joint.lower[every][locked], abs=1e-9)


@settings(max_examples=30)
@given(seed=st.integers(0, 10**6))
def test_the_jacobian_is_the_slope_of_poses(seed: int) -> None:
    """Central differences of places and turns, for a point off the middle of the last body."""
    kinematics = Kinematics(wild(seed), "base")
    at, point, h = np.random.default_rng(seed).uniform(-1.4, 1.4, len(kinematics.slots)), (0.3, -0.2, 0.5), 1e-6
    jacobian = kinematics.jacobian("link5", at, point)
    for way in range(len(at)):
        step = h * (np.arange(len(at)) == way)
        (before, turned_before), (after, turned_after) = (
            kinematics.pose("link5", at + sign * step, point) for sign in (-1.0, 1.0)
        )
        turn = quaternion.multiply(turned_after, quaternion.conjugate(turned_before))
        spin = turn[:3] * np.sign(turn[3]) / h
        assert jacobian[:, way] == pytest.approx([*(after - before) / (2.0 * h), *spin], abs=1e-7)


@pytest.mark.parametrize("axes", ["zzz", "yzzxzx"])
def test_a_hand_follows_a_circle(axes: str) -> None:
    """Within a millimetre, and much less, of a target that goes round; each frame begins where the last has ended."""
    simulation = arm(axes, BEND)
    kinematics = Kinematics(simulation)
    found = None
    for angle in np.linspace(0.0, 4.0 * math.pi, 240):
        target = np.array([1.2 + 0.8 * math.cos(angle), 0.9 + 0.8 * math.sin(angle), 0.0])
        found = kinematics.reach("hand", target, point=TIP, start=None if found is None else found.positions)
        assert found.off < 1e-6
        assert (np.abs(found.positions) <= 2.5).all()
        place, _ = kinematics.pose("hand", found.positions, TIP)
        assert np.abs(place - target).max() < 1e-6
        kinematics.place(found.positions)
        assert simulation["hand"].transform.position + quaternion.rotate(
            simulation["hand"].transform.rotation, TIP
        ) == pytest.approx(target, abs=1e-6)


def test_six_hinges_turn_the_hand_as_well() -> None:
    """The pose of some angles is found again, place and turn."""
    kinematics = Kinematics(arm("yzzxzx"))
    for seed in range(20):
        angles = np.random.default_rng(seed).uniform(-1.2, 1.2, 6)
        place, turn = kinematics.pose("hand", angles, TIP)
        found = kinematics.reach("hand", place, turn, TIP, angles + 0.2)
        assert found.off < 1e-6
        again, turned = kinematics.pose("hand", found.positions, TIP)
        assert again == pytest.approx(place, abs=1e-6)
        assert abs(float(turned @ turn)) == pytest.approx(1.0, abs=1e-9)


@pytest.mark.parametrize("target", [(4.0, 1.0, 0.0), (0.0, 300.0, 0.0), (-3.5, 0.0, 0.0)])
def test_out_of_reach_the_arm_is_stretched(target: tuple[float, float, float]) -> None:
    """As near as can be is 3 m on the way there."""
    kinematics = Kinematics(arm("zzz"))
    found = kinematics.reach("hand", target, point=TIP)
    assert np.isfinite(found.positions).all()
    place, _ = kinematics.pose("hand", found.positions, TIP)
    nearest = 3.0 * np.array(target) / np.linalg.norm(target)
    assert place == pytest.approx(nearest, abs=1e-3)
    assert found.off == pytest.approx(float(np.linalg.norm(target)) - 3.0, abs=1e-6)


def test_limits_are_kept_also_where_they_forbid_the_target() -> None:
    """One link that turns by half a radian at most points as near to straight up as that."""
    kinematics = Kinematics(arm("z", (-0.5, 0.5)))
    found = kinematics.reach("hand", (0.0, 1.0, 0.0), point=TIP)
    assert found.positions.tolist() == [0.5]
    assert found.off == pytest.approx(2.0 * math.sin(0.25 * math.pi - 0.25), abs=1e-12)


def test_what_lies_in_line_bends_a_straight_arm() -> None:
    """No step along a straight arm shortens it to first order; a second try does."""
    assert Kinematics(arm("zz")).reach("hand", (1.0, 0.0, 0.0), point=TIP).off < 1e-6


def test_motors_are_told_where_to_pull() -> None:
    """Targets of the springs of the driven ways."""
    simulation = arm("zz")
    kinematics = Kinematics(simulation)
    kinematics.drive((0.5, -0.25))
    assert [float(simulation[f"joint{n}"].joint.target[3]) for n in (0, 1)] == [0.5, -0.25]


def test_joints_that_close_loops_or_lie_along_lines_are_left_out() -> None:
    """The tree has each body once."""
    simulation = arm("zzz")
    hand, elbow = simulation.world.find("hand"), simulation.world.find("link1")
    simulation.world.spawn(Joint(a=int(elbow), along=LINE), name="rope")
    simulation.world.spawn(Joint(a=int(elbow), b=int(hand)), name="loop")
    kinematics = Kinematics(simulation)
    assert [simulation.world.name(joint) for joint in kinematics.joints] == ["joint0", "joint1", "joint2"]


def test_what_cannot_be_done_is_refused() -> None:
    """Whole messages."""
    simulation = arm("zz")
    kinematics = Kinematics(simulation)
    simulation.add(name="free", body={"mass": 1.0})
    with pytest.raises(DeclarationError) as refused:
        kinematics.place((1.0, 2.0, 3.0))
    assert str(refused.value) == "kinematics take 2 positions, one for each way of joint0, joint1; received 3"
    with pytest.raises(DeclarationError) as refused:
        kinematics.reach("free", (0.0, 0.0, 0.0))
    assert str(refused.value) == "no joints hold 'free' to the world"
    with simulation.world.edit(Joint) as joint:
        row = simulation.world.row(simulation.world.find("joint1"))
        joint.about[row], joint.mode[row, 4] = SWING_TWIST, FREE
    with pytest.raises(DeclarationError) as refused:
        Kinematics(simulation)
    assert str(refused.value) == (
        "joint 'joint1' measures twist and swing, which do not say how it is turned; kinematics take joints about axes"
    )
