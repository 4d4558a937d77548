"""Joints: pendulums, tops, hanging chains, limits, motors, friction and breaking, against closed forms."""

from __future__ import annotations

from math import cos, inf, pi, radians, sin

import numpy as np
import pytest

from carom.ecs import Motion, Transform
from carom.ecs.components.joint import Joint
from carom.ecs.relations.contact import Contact
from carom.ecs.relations.impact import Impact
from carom.ecs.relations.joint_break import JointBreak
from carom.ecs.spatial import quaternion
from carom.systems.detection.why import why_no_contact
from carom.systems.energy import kinetic_energy, potential_energies
from carom.systems.simulation import Simulation

G = 9.81
BALL = {"sphere": {"radius": 0.05}}
UNIT = {"mass": 1.0, "inertia": (1.0, 1.0, 1.0)}


def weightless(dt: float = 1 / 240) -> Simulation:
    """Return a world without gravity in which nobody sleeps."""
    return Simulation(dt=dt, gravity=(0.0, 0.0, 0.0), sleeping=False)


def energy(simulation: Simulation) -> float:
    """Return the total energy (J)."""
    return kinetic_energy(simulation.world) + sum(potential_energies(simulation.world).values())


def test_a_pendulum_keeps_its_period_its_energy_and_its_length() -> None:
    """A ball 1 m from its pivot, let go at 90 degrees: 4 K(sin 45) sqrt(L (1 + 2/5 (r/L)^2) / g) a swing."""
    simulation = Simulation(dt=1 / 240, sleeping=False, checked=False)  # twice as fast
    simulation.add(name="bob", collider=BALL, body={"mass": 1.0}, transform={"position": (1.0, 0.0, 0.0)})
    simulation.add(name="pivot", joint={"ball": {"b": "bob", "at": (0.0, 0.0, 0.0)}})
    row, joint = simulation.world.row(simulation.world.find("bob")), simulation.world.find("pivot")
    angles, energies, gaps = [], [], []
    for _ in range(4800):
        simulation.step()
        x, y, _ = simulation.world[Transform].position[row]
        angles.append(np.arctan2(x, -y))
        if simulation.frame % 8 == 0:
            energies.append(energy(simulation))
            gaps.append(float(simulation[joint].joint.gap))
    angle = np.array(angles)
    down = np.nonzero((angle[:-1] > 0.0) & (angle[1:] <= 0.0))[0]
    times = (down + 1 + angle[down] / (angle[down] - angle[down + 1])) / 240
    assert len(times) >= 8
    # The issue asks for 5e-3; the error is of second order in the substep.
    assert np.abs(np.diff(times) - 2.3690256).max() < 1e-4
    assert np.abs(energies).max() < 0.002 * G  # swings about the true one by half a kick: 0.15 %
    assert abs(np.mean(energies[-30:]) - np.mean(energies[:30])) < 2e-4 * G  # and does not drift
    assert max(gaps) < 0.03e-3


def test_a_top_precesses() -> None:
    """Steady precession W of a top: I3 s W = M g l + (I1 - I3) W^2 cos(30 deg), I1 about the point (Goldstein, 5.7)."""
    rate, tilt, spin = 1.57953, radians(30.0), 100.0
    axis = np.array((sin(tilt), cos(tilt), 0.0))
    angular = spin * axis + rate * (np.array((0.0, 1.0, 0.0)) - axis * axis[1])
    simulation = Simulation(dt=1 / 240, sleeping=False, checked=False)
    place = {"position": tuple(0.3 * axis), "rotation": (0.0, 0.0, -sin(tilt / 2), cos(tilt / 2))}
    motion = {"linear": tuple(np.cross(angular, 0.3 * axis)), "angular": tuple(angular)}
    body = {"mass": 1.0, "inertia": (0.01, 0.02, 0.01)}
    simulation.add(name="top", collider=BALL, body=body, transform=place, motion=motion)
    simulation.add(joint={"ball": {"b": "top", "at": (0.0, 0.0, 0.0)}})
    row, turned, tilts = simulation.world.row(simulation.world.find("top")), [], []
    for _ in range(2400):
        simulation.step()
        x, y, z = simulation.world[Transform].position[row]
        turned.append(np.arctan2(-z, x))
        tilts.append(np.arccos(y / 0.3))
    turned = np.unwrap(turned)
    assert (turned[-1] - turned[0]) / (2399 / 240) == pytest.approx(rate, rel=2e-4)  # the issue asks for 2 %
    assert np.abs(np.degrees(tilts) - 30.0).max() < 0.05


@pytest.mark.parametrize(("end", "part"), [(1.0, 0.0012), (100.0, 0.009)])
def test_a_chain_hangs_together(end: float, part: float) -> None:
    """The gaps of 32 links of 0.2 m and 1 kg, the last heavier, sum up to little from the first step on."""
    simulation = Simulation(dt=1 / 240, sleeping=False)
    for n in range(32):
        place = {"position": (0.0, -0.1 - 0.2 * n, 0.0)}
        shape = {"capsule": {"radius": 0.03, "length": 0.14}}
        simulation.add(name=f"{n}", collider=shape, body={"mass": 1.0 if n < 31 else end}, transform=place)
        joint = {"b": f"{n}", "at": (0.0, -0.2 * n, 0.0)} | ({"a": f"{n - 1}"} if n else {})
        simulation.add(joint={"ball": joint})
    joint, rows = simulation.world[Joint], simulation.world.row_numbers(Joint)
    gaps = []
    for _ in range(720):
        simulation.step()
        gaps.append(joint.gap[rows].sum())
    assert max(gaps) < part * 6.4
    assert np.abs(simulation.world[Motion].linear).max() < 0.05
    if end == 1.0:  # with 100 kg it takes its time to come to rest
        assert joint.force[rows, 1] == pytest.approx((32 - np.arange(32)) * G, rel=1e-6)  # on b, which is below


def hinged(simulation: Simulation, *, spin: float, **words: object) -> int:
    """Add a body of unit inertia that turns about x at ``spin`` (rad/s) on a hinge; return the joint."""
    simulation.add(name="flap", collider=BALL, body=UNIT, motion={"angular": (spin, 0.0, 0.0)})
    axis = {"b": "flap", "at": (0.0, 0.0, 0.0), "axis": (1.0, 0.0, 0.0)}
    return int(simulation.add(joint={"hinge": axis | words}))


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


def test_a_spring_that_is_too_stiff_for_the_step_only_settles() -> None:
    """A soft spring of 1e5 N/m on 1 kg, by dt 1/60, never stretches further than it was let go."""
    simulation = weightless(dt=1 / 60)
    simulation.add(name="mass", collider=BALL, body=UNIT, transform={"position": (1.1, 0.0, 0.0)})
    words = {"b": "mass", "anchor_a": (0.0, 0.0, 0.0), "anchor_b": (0.0, 0.0, 0.0), "stiffness": 1e5, "length": 1.0}
    joint = simulation.add(joint={"spring": words})
    stretch = []
    for _ in range(600):
        simulation.step()
        stretch.append(abs(float(simulation[joint].joint.position[0]) - 1.0))
    assert max(stretch) < 0.1
    assert stretch[-1] < 1e-9


def test_a_rope_that_hangs_slack_is_not_felt() -> None:
    """A ball below its knot falls as if there were no rope, to the last bit, until the rope is taut; then it hangs."""
    places = []
    for rope in (False, True):
        simulation = Simulation(dt=1 / 240, sleeping=False)
        place = {"position": (0.0, -0.5, 0.0)}
        simulation.add(name="ball", collider=BALL, body={"mass": 1.0}, transform=place)
        if rope:
            words = {"b": "ball", "anchor_a": (0.0, 0.0, 0.0), "anchor_b": (0.0, 0.0, 0.0), "length": 1.0}
            joint = simulation.add(joint={"rope": words})
        simulation.step(60)
        places.append(simulation["ball"].transform.position.tolist())
    assert places[0] == places[1]
    assert not simulation[joint].joint.force.any()
    simulation.step(480)
    assert simulation[joint].joint.force == pytest.approx((0.0, G, 0.0), abs=1e-6)
    assert simulation[joint].joint.position[0] == pytest.approx(1.0, abs=1e-4)


@pytest.mark.parametrize("collide", [False, True])
def test_joined_bodies_touch_each_other_only_if_asked(collide: bool) -> None:
    """Two boxes that overlap at their hinge have contacts only where the joint says so."""
    simulation = weightless()
    for name, x in (("left", -0.4), ("right", 0.4)):
        simulation.add(
            name=name, collider={"box": {"size": (1.0, 0.2, 0.2)}}, body={}, transform={"position": (x, 0, 0)}
        )
    axis = {"a": "left", "b": "right", "at": (0.0, 0.0, 0.0), "axis": (0.0, 0.0, 1.0), "collide": collide}
    simulation.add(name="pin", joint={"hinge": axis})
    simulation.step()
    assert (simulation.world.count(Contact) > 0) == collide
    kept = "'left' and 'right' are held by 'pin', which keeps them from touching; its word collide lets them"
    assert (why_no_contact(simulation, "left", "right") == kept) != collide


def add_dumbbell(simulation: Simulation) -> None:
    """Add a floor, and two masses on a rod that fall flat on it."""
    simulation.add(name="floor", collider={"plane": {}})
    for name, x in (("left", -0.5), ("right", 0.5)):
        place, down = {"position": (x, 1.0, 0.0)}, {"linear": (0.0, -5.0, 0.0)}
        ball = {"sphere": {"radius": 0.1}}
        simulation.add(name=name, collider=ball, body={"mass": 2.0}, transform=place, motion=down)
    simulation.add(name="rod", joint={"fixed": {"a": "left", "b": "right", "at": (0.0, 1.0, 0.0)}})


def test_who_lands_on_joints_lands_with_all_of_them() -> None:
    """Two masses on a rod that fall flat stop at once: an impact each, of all its momentum, and the rod holds."""
    simulation = Simulation(dt=1 / 60)
    add_dumbbell(simulation)
    joint = simulation.world.find("rod")
    gaps, impacts = [], []
    for _ in range(20):
        simulation.step()
        gaps.append(float(simulation[joint].joint.gap))
        impact = simulation.world[Impact]
        impacts += [(float(impact.speed[row]), float(impact.impulse[row])) for row in range(impact.count)]
    speed = float(np.sqrt(25.0 + 2.0 * G * 0.9))
    assert len(impacts) == 2
    for closed, impulse in impacts:  # those of a substep: it is closed when the substep begins or ends
        assert closed == pytest.approx(speed, abs=G / 240)
        assert impulse == pytest.approx(2.0 * speed, abs=2.0 * 2.0 * G / 240)
    assert max(gaps) < 1e-4
    assert simulation["left"].motion.linear == pytest.approx((0.0, 0.0, 0.0), abs=1e-9)


def links_asleep() -> tuple[Simulation, list[int]]:
    """Return three links that hang, and have fallen asleep as one island, and their rows."""
    simulation = Simulation(dt=1 / 60, sleeping=True)
    for n in range(3):
        simulation.add(name=f"{n}", collider=BALL, body={"mass": 1.0}, transform={"position": (0.0, -0.2 * n, 0.0)})
        above = {"a": f"{n - 1}"} if n else {}
        simulation.add(name=f"joint {n}", joint={"ball": {"b": f"{n}", "at": (0.0, -0.2 * n + 0.1, 0.0)} | above})
    simulation.step(120)
    rows = [simulation.world.row(simulation.world.find(f"{n}")) for n in range(3)]
    assert simulation.world[Motion].asleep[rows].all()
    return simulation, rows


def test_who_is_joined_to_somebody_who_is_pushed_wakes() -> None:
    """A push on the lowest link wakes all three."""
    simulation, rows = links_asleep()
    simulation["2"].external_force.force = (5.0, 0.0, 0.0)
    simulation.step()
    assert not simulation.world[Motion].asleep[rows].any()


def test_who_hangs_on_a_joint_that_goes_wakes_and_falls() -> None:
    """Without its joint the lowest link falls from where it slept."""
    simulation, rows = links_asleep()
    simulation.world.despawn(simulation.world.find("joint 2"))
    simulation.step(2)
    assert simulation.world[Motion].asleep[rows].tolist() == [False, False, False]
    assert simulation["2"].motion.linear[1] == pytest.approx(-2 * G / 60, rel=1e-9)


def test_motors_do_not_fall_asleep() -> None:
    """A hinge that turns by 0.01 rad/s, slower than what may sleep, goes on doing so."""
    simulation = Simulation(dt=1 / 60, gravity=(0.0, 0.0, 0.0), sleeping=True)
    joint = hinged(simulation, spin=0.0, motor={"speed": 0.01, "most": inf})
    simulation.step(600)
    assert simulation[joint].joint.position[3] == pytest.approx(0.1, abs=1e-4)


def test_a_turned_world_swings_alike() -> None:
    """A double pendulum and the same turned by any rotation end in the same pose, turned."""
    ends = []
    about = quaternion.from_axis_angle((1.0, 2.0, -0.5), 1.3)
    for turn in (np.array((0.0, 0.0, 0.0, 1.0)), about):
        gravity = tuple(quaternion.rotate(turn, np.array((0.0, -G, 0.0))).tolist())
        simulation = Simulation(dt=1 / 240, sleeping=False, gravity=gravity)
        for n in range(2):
            place = quaternion.rotate(turn, np.array((0.5 + n, 0.0, 0.0)))
            shape, pose = {"box": {"size": (0.8, 0.1, 0.1)}}, {"position": place, "rotation": turn}
            simulation.add(name=f"{n}", collider=shape, body={"mass": 1.0}, transform=pose)
            words = {"b": f"{n}", "at": quaternion.rotate(turn, np.array((float(n), 0.0, 0.0)))}
            words |= {"axis": quaternion.rotate(turn, np.array((0.0, 0.0, 1.0)))} | ({"a": "0"} if n else {})
            simulation.add(joint={"hinge": words})
        simulation.step(240)
        ends.append(quaternion.rotate(quaternion.conjugate(turn), simulation["1"].transform.position))
    assert ends[0] == pytest.approx(ends[1], abs=1e-9)  # a double pendulum makes more of rounding


def test_a_landing_is_told_whatever_is_detected_meanwhile() -> None:
    """What a ball strikes leaves its reach, so that contacts are found anew, in other places: no landing is lost."""
    told = []
    for struck in (0, 60):
        simulation = Simulation(dt=1 / 60)
        hard, ball = {"restitution": 1.0}, {"sphere": {"radius": 0.1}}
        for number in range(struck):  # one after the other in every substep
            if number == 20:  # before and behind those who land
                add_dumbbell(simulation)
            place = {"position": (0.4 * number, 5.0 + 0.06 * (number % 2), 5.0)}
            simulation.add(collider=ball, body={"mass": 0.1}, material=hard, transform=place)
        if struck:
            place, fast = {"position": (-0.3, 5.03, 5.0)}, {"linear": (100.0, 0.0, 0.0)}
            simulation.add(collider=ball, body={"mass": 1e4}, material=hard, transform=place, motion=fast)
        else:
            add_dumbbell(simulation)
        landing, found = {simulation.world.find(name) for name in ("left", "right")}, []
        for _ in range(12):
            simulation.step()
            impact = simulation.world[Impact]
            rows = [row for row in range(impact.count) if landing & {impact.a[row], impact.b[row]}]
            found += [(float(impact.speed[row]), float(impact.impulse[row])) for row in rows]
        told.append(found)
    quiet, busy = np.array(told[0]), np.array(told[1])
    assert busy[:, 0] == pytest.approx(quiet[:, 0], rel=1e-12)
    assert (busy[:, 1] > 0.5 * quiet[:, 1]).all()  # it came down within the substep, and is stopped in the next
