"""Who is joined touches, lands, sleeps and wakes with the others."""

from __future__ import annotations

from math import inf

import numpy as np
import pytest
from hinges import BALL, G, hinged, weightless

from carom.ecs import Motion
from carom.ecs.relations.contact import Contact
from carom.ecs.relations.impact import Impact
from carom.systems.detection.why import why_no_contact
from carom.systems.simulation import Simulation


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
