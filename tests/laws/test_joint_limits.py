"""Limits, motors, friction and breaking of joints, against closed forms."""

from __future__ import annotations

from math import pi

import pytest
from hinges import BALL, UNIT, hinged, weightless

from carom.ecs.relations.joint_break import JointBreak
from carom.systems.simulation import Simulation

LIMITED = {"limits": (-1.0, 0.5), "restitution": 0.3}


@pytest.mark.parametrize("restitution", [0.0, 0.5, 1.0])
def test_a_limit_is_not_passed_and_bounces_as_asked(restitution: float) -> None:
    """A hinge that turns at 3 rad/s meets 45 degrees, and goes back with e times as much."""
    simulation = weightless()
    joint = hinged(simulation, spin=3.0, limits=(-pi, pi / 4), restitution=restitution)
    angles = []
    for _ in range(100):
        simulation.step()
        angles.append(float(simulation[joint].joint.position[3]))
    assert max(angles) < pi / 4 + 1e-12
    assert simulation[joint].joint.velocity[3] == pytest.approx(-3.0 * restitution, abs=1e-12)


def test_a_limit_that_holds_says_so() -> None:
    """A flap of 1 kg m^2, driven by 2 N m against its limit, presses with as much and is said to be there."""
    simulation = weightless()
    joint = hinged(simulation, spin=0.0, limits=(-1.0, 0.5))
    for _ in range(480):
        simulation["flap"].external_force.torque = (2.0, 0.0, 0.0)
        simulation.step()
    view = simulation[joint].joint
    assert view.limit[3] == 1
    assert view.torque[0] == pytest.approx(-2.0, rel=1e-9)
    assert view.position[3] == pytest.approx(0.5, abs=1e-9)


def test_a_motor_ramps_up_and_keeps_its_speed() -> None:
    """10 N m on 1 kg m^2 is 10 rad/s^2 up to 5 rad/s, to rounding, and nothing from there on."""
    simulation = weightless()
    joint = hinged(simulation, spin=0.0, motor={"speed": 5.0, "most": 10.0})
    for step in range(1, 240):
        simulation.step()
        assert simulation[joint].joint.velocity[3] == pytest.approx(min(5.0, 10.0 * step / 240), abs=1e-12)
    assert simulation[joint].joint.effort[3] == pytest.approx(0.0, abs=1e-9)
    assert simulation[joint].joint.position[3] == pytest.approx(5.0 * (239 / 240 - 0.25), abs=0.005)


@pytest.mark.parametrize("inertia", [1e-4, 1e-2, 1.0])
@pytest.mark.parametrize("dt", [1 / 60, 1 / 240])
def test_a_motor_that_drives_against_its_limit_stands_there(inertia: float, dt: float) -> None:
    """Whatever inertia the body at the end of the arm has of its own: the limit holds, to rounding, from then on."""
    simulation = weightless(dt)
    place, body = {"position": (0.5, 0.0, 0.0)}, {"mass": 2.0, "inertia": (inertia,) * 3}
    simulation.add(name="arm", collider=BALL, body=body, transform=place)
    words = {"b": "arm", "at": (0.0, 0.0, 0.0), "axis": (0.0, 1.0, 0.0), "limits": (-0.1, 0.2)}
    joint = simulation.add(joint={"hinge": words | {"motor": {"speed": 2.0, "most": 3.0}}})
    angles = []
    for _ in range(round(1.0 / dt)):
        simulation.step()
        angles.append(float(simulation[joint].joint.position[3]))
    assert max(angles) < 0.2 + 1e-9
    assert angles[len(angles) // 2 :] == pytest.approx([0.2] * (len(angles) - len(angles) // 2), abs=1e-9)
    view = simulation[joint].joint
    assert (view.limit[3], view.effort[3]) == (1, pytest.approx(3.0, rel=1e-9))


@pytest.mark.parametrize("words", [{}, {"limits": (-0.5, 0.5)}, {"limits": (-0.5, 0.5), "friction": 1e-12}])
@pytest.mark.parametrize("kind", ["slider", "hinge"])
def test_a_damper_is_the_same_between_limits(kind: str, words: dict[str, object]) -> None:
    """A pea of 0.1 kg on an arm of 0.5 m loses 1 / (1 + c h / m) in each substep, of a hinge 1 / (1 + c h / I).

    At the end of the arm an impulse turns the pea 2,500 times as far as it moves it: whoever asked before locks hold
    again would see the limits come, and locks that yield would let the joint open. Going round is of second order.
    """
    turns = kind == "hinge"
    simulation, joint = pea_on_an_arm(kind, (0.0, 3.0, 0.0), {"motor": {"damping": 2.0}} | words)
    lost = 2.0 / 240 / (1e-5 + 0.1 * 0.5**2 if turns else 0.1)
    for step in range(1, 7):
        simulation.step()
        left = (1.0 + lost) ** (-4 * step)
        view = simulation["pea"].motion
        if turns:
            assert view.angular == pytest.approx((0.0, 0.0, 6.0 * left), rel=1e-4, abs=1e-12)
        else:
            assert view.linear == pytest.approx((0.0, 3.0 * left, 0.0), abs=1e-12)
        assert simulation[joint].joint.gap < 1e-4


@pytest.mark.parametrize("words", [{}, {"limits": (-0.5, 0.5)}])
def test_a_spring_to_a_place_is_felt_at_the_end_of_an_arm(words: dict[str, object]) -> None:
    """The pea swings about 0.2 m as the implicit step says: (m + h c + h^2 k) v' = m v - h k (x - 0.2 m)."""
    spring = {"target": 0.2, "stiffness": 200.0, "damping": 1.0}
    simulation, joint = pea_on_an_arm("slider", (0.0, 3.0, 0.0), {"motor": spring} | words)
    place, speed, h = 0.0, 3.0, 1 / 240
    for _ in range(30):
        simulation.step()
        for _ in range(4):
            speed = (0.1 * speed - h * 200.0 * (place - 0.2)) / (0.1 + h * 1.0 + h * h * 200.0)
            place += h * speed
        view = simulation[joint].joint
        assert (view.position[0], view.velocity[0]) == (pytest.approx(place, abs=1e-9), pytest.approx(speed, abs=1e-9))
        assert view.gap < 1e-9


def pea_on_an_arm(kind: str, linear: tuple[float, float, float], words: dict[str, object]) -> tuple[Simulation, int]:
    """Return a world with 0.1 kg of hardly any inertia, and the joint that holds it 0.5 m away, about z or along y."""
    simulation = weightless(1 / 60)
    turns = kind == "hinge"
    body = {"mass": 0.1, "inertia": (1e-5, 1e-5, 1e-5)}
    motion = {"linear": linear, "angular": (0.0, 0.0, 2.0 * linear[1] if turns else 0.0)}
    simulation.add(name="pea", collider=BALL, body=body, motion=motion, transform={"position": (0.5, 0.0, 0.0)})
    ends = {"b": "pea", "at": (0.0, 0.0, 0.0), "axis": (0.0, 0.0, 1.0) if turns else (0.0, 1.0, 0.0)}
    return simulation, int(simulation.add(joint={kind: ends | words}))


@pytest.mark.parametrize("others", [{"friction": 0.1}, {"motor": {"damping": 0.1}}, {"limits": (-1.0, 1.0)}])
def test_what_a_joint_does_hangs_on_none_beside_it(others: dict[str, object]) -> None:
    """A flap falls, swings and meets its limit to the same bits where others with other words swing elsewhere."""
    angles = []
    for beside in (False, True):
        simulation = Simulation(sleeping=False)
        for k, words in enumerate((LIMITED, others) if beside else (LIMITED,)):
            at = (0.0, 0.0, 3.0 * k)
            simulation.add(
                name=f"flap {k}", collider=BALL, body={"mass": 1.0}, transform={"position": (0.5, 0.0, at[2])}
            )
            simulation.add(name=f"axle {k}", joint={"hinge": {"b": f"flap {k}", "at": at, "axis": (0, 0, 1)} | words})
        simulation.step(60)
        angles.append(float(simulation["axle 0"].joint.position[3]))
    assert angles[0] == angles[1] != 0.0


def test_friction_slows_a_slider_and_lets_it_stand() -> None:
    """2 N on 1 kg take 4 m/s in 2 s of 5 m/s, and the rest in another half; then nothing moves."""
    simulation = weightless()
    simulation.add(name="sled", collider=BALL, body=UNIT, motion={"linear": (0.0, 0.0, 5.0)})
    words = {"b": "sled", "at": (0.0, 0.0, 0.0), "axis": (0.0, 0.0, 1.0), "friction": 2.0}
    simulation.add(joint={"slider": words})
    simulation.step(480)
    assert simulation["sled"].motion.linear == pytest.approx((0.0, 0.0, 1.0), abs=1e-12)
    simulation.step(240)
    assert simulation["sled"].motion.linear == pytest.approx((0.0, 0.0, 0.0), abs=1e-12)


def test_a_joint_breaks_when_it_bears_no_more() -> None:
    """Under a load that rises by 10 N/s one of 50 N breaks at 5 s, tells so, and lets go."""
    simulation = weightless()
    simulation.add(name="load", collider=BALL, body=UNIT)
    joint = simulation.add(name="weld", joint={"fixed": {"b": "load", "at": (0.0, 0.0, 0.0), "break_force": 50.0}})
    while not simulation.world.count(JointBreak):
        simulation["load"].external_force.force = (10.0 * (simulation.time + 1 / 240), 0.0, 0.0)
        simulation.step()
    broken = simulation.world[JointBreak]
    assert simulation.time == pytest.approx(5.0, abs=0.006)
    assert (broken.joint[0], broken.a[0], broken.b[0]) == (joint, -1, simulation.world.find("load"))
    assert broken.force[0] == pytest.approx(50.0, abs=0.1)
    simulation["load"].external_force.force = (50.0, 0.0, 0.0)
    simulation.step()
    assert simulation.world.count(JointBreak) == 0
    assert simulation["load"].motion.linear[0] == pytest.approx(50.0 / 240, rel=1e-9)
