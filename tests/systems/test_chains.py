"""Chains lie as they are told to, hang as statics says, and hold together."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from carom.ecs import DeclarationError, Transform
from carom.ecs.components.joint import Joint
from carom.ecs.relations.contact import Contact
from carom.ecs.spatial import quaternion
from carom.systems.chains import WORLD, add_chain, add_net
from carom.systems.simulation import Simulation

LINK = {"body": {"mass": 0.5, "inertia": (0.01, 0.01, 0.01), "linear_damping": 2.0, "angular_damping": 4.0}}


def loads(simulation: Simulation) -> tuple[np.ndarray, np.ndarray]:
    """Return the forces of all joints (n, 3), in order of their rows, and how far they are off."""
    joint, rows = simulation.world[Joint], simulation.world.row_numbers(Joint)
    return joint.force[rows], joint.gap[rows]


@pytest.mark.parametrize("sag", [0.0, 0.4, 2.0, 5.0])
def test_links_are_alike_and_the_middle_sags(sag: float) -> None:
    """The ends are where they were asked to be, links equally long and end to end, the middle joint lowest."""
    simulation, start, end = Simulation(gravity=(0.0, 0.0, 0.0)), np.array([1.0, 5.0, 2.0]), np.array([4.0, 6.0, -1.0])
    links = add_chain(simulation, "rope", start, end, 20, sag=sag, radius=0.01, b=WORLD)
    world = simulation.world
    rows, size = world.slots.rows(links), simulation[int(links[0])].collider.size
    half = 0.5 * float(size[1]) + float(size[0])
    pose = world[Transform]
    tips = [pose.position[rows] + quaternion.rotate(pose.rotation[rows], (0.0, y, 0.0)) for y in (-half, half)]
    assert tips[0][0] == pytest.approx(start, abs=1e-12)
    assert tips[1][-1] == pytest.approx(end, abs=1e-12)
    assert tips[0][1:] == pytest.approx(tips[1][:-1], abs=1e-12)
    middle = tips[1][9] - 0.5 * (start + end)
    assert np.sqrt(middle @ middle) == pytest.approx(sag, abs=1e-12)
    assert middle @ (end - start) == pytest.approx(0.0, abs=1e-12)
    assert middle[1] <= 0.0
    simulation.step()
    assert loads(simulation)[1].max() < 1e-9


@pytest.mark.parametrize("start", [(0.0, 0.0, 0.0), (3.0, 1.0, -2.0)])
def test_a_rope_between_two_points_hangs_as_statics_says(start: tuple[float, float, float]) -> None:
    """The level part of the pull is the same in every joint, and the upright part grows by the weight of a link."""
    simulation = Simulation(dt=1 / 120, sleeping=False)
    add_chain(simulation, "rope", start, np.add(start, (3.0, 0.0, 0.0)), 12, sag=1.0, b=WORLD, collider=None, **LINK)
    simulation.step(1800)
    force, gap = loads(simulation)
    order = np.argsort(force[:, 1])
    assert np.diff(force[order, 1]) == pytest.approx(0.5 * 9.81, rel=1e-3)
    assert np.abs(force[:, 0]) == pytest.approx(np.abs(force[0, 0]), rel=1e-3)
    assert force[:, 2] == pytest.approx(0.0, abs=1e-6)
    assert gap.max() < 2e-4


def test_neighbours_do_not_touch_and_others_do() -> None:
    """Balls that overlap their neighbours lie still on the ground; without joints they would be driven apart."""
    simulation = Simulation(dt=1 / 120, sleeping=False)
    simulation.add(collider={"plane": {}})
    ball = {"collider": {"sphere": {"radius": 0.1}}, "body": {"mass": 1.0}}
    links = add_chain(simulation, "beads", (0.0, 0.1, 0.0), (1.5, 0.1, 0.0), 10, a=None, **ball)
    simulation.step(120)
    contact = simulation.world[Contact]
    pairs = np.stack([contact.a, contact.b], axis=1)[: contact.count]
    assert len(pairs) == 10
    assert not np.isin(pairs, links).all(axis=1).any()
    assert loads(simulation)[1].max() < 1e-6


def test_the_last_link_holds_a_body() -> None:
    """A weight hangs on it; the topmost joint bears all of it."""
    simulation = Simulation(dt=1 / 120, sleeping=False)
    simulation.add(name="weight", body={"mass": 20.0, "linear_damping": 2.0}, transform={"position": (0.0, -2.0, 0.0)})
    add_chain(simulation, "rope", (0.0, 0.0, 0.0), (0.0, -2.0, 0.0), 8, b="weight", collider=None, **LINK)
    simulation.step(600)
    force, _ = loads(simulation)
    assert len(force) == 9
    assert np.abs(force[:, 1]).max() == pytest.approx(24.0 * 9.81, rel=1e-4)
    names = simulation.world.names()
    assert names[1:9] == [f"rope[{k}]" for k in range(8)]
    assert {f"rope.joint[{k}]" for k in range(9)} <= set(names)


def test_a_bridge_of_planks_turns_on_level_hinges() -> None:
    """Boxes lie with z across; hinges about it keep the bridge in its plane."""
    simulation = Simulation(dt=1 / 120, sleeping=False)
    hinge = {"hinge": {"axis": (0.0, 0.0, 1.0)}}
    planks = add_chain(
        simulation, "bridge", (0.0, 2.0, 0.0), (4.0, 2.0, 0.0), 10, sag=0.3, joint=hinge, b=WORLD,
        collider={"box": {"size": (0.05, 0.38, 1.0)}}, body={"mass": 2.0},
    )  # fmt: skip
    simulation.step(240)
    world = simulation.world
    turn = world[Transform].rotation[world.slots.rows(planks)]
    assert np.abs(quaternion.rotate(turn, (0.0, 0.0, 1.0))[:, 2]) == pytest.approx(1.0, abs=1e-9)
    assert loads(simulation)[1].max() < 5e-4


@pytest.mark.parametrize(("joint", "apart"), [({"ball": {}}, 0.5), ({"rope": {}}, 0.5), ({"distance": {}}, 0.5)])
def test_a_net_joins_each_knot_to_its_neighbours(joint: dict[str, Any], apart: float) -> None:
    """There are n (m - 1) + m (n - 1) joints, none of them off after a fall from its pinned corner."""
    simulation = Simulation(dt=1 / 120, sleeping=False)
    knots = add_net(
        simulation, "net", (0.0, 0.0, 0.0), (apart, 0.0, 0.0), (0.0, 0.0, apart), (4, 3), joint=joint, collider=None,
        body={"mass": 0.1, "inertia": (0.01, 0.01, 0.01)},
    )  # fmt: skip
    simulation.add(joint={"ball": {"b": int(knots[0, 0]), "at": (0.0, 0.0, 0.0)}})
    assert len(simulation.world.row_numbers(Joint)) == 4 * 2 + 3 * 3 + 1
    assert simulation["net.along[3,1]"].joint.b == knots[3, 2]
    simulation.step(60)
    place = simulation.world[Transform].position
    assert place[simulation.world.row(int(knots[3, 2])), 1] < -0.5
    if "ball" not in joint:
        for one, other in ((knots[:-1], knots[1:]), (knots[:, :-1], knots[:, 1:])):
            first, second = (place[simulation.world.slots.rows(part.ravel())] for part in (one, other))
            assert np.sqrt(((second - first) ** 2).sum(axis=1)).max() < apart + 1e-3
    assert loads(simulation)[1].max() < 1e-3


REFUSED = {
    "count: a chain has 1 link or more; received 0": {"count": 0},
    "end: is where the chain starts; accepted: another point": {"end": (0.0, 0.0, 0.0)},
    "sag: is 0 or more, m; received -1": {"sag": -1.0},
    "sag: a chain from one point straight down to the other hangs to no side; leave it out": {
        "end": (0.0, -3.0, 0.0),
        "sag": 0.5,
    },
    "radius: state that of links that are capsules, or a collider of their own": {"radius": None},
    "radius: must be above 0 and below half a link, 0.1 m; received 0.1; take fewer links": {"radius": 0.1},
}


@pytest.mark.parametrize("told", REFUSED)
def test_what_is_no_chain_is_refused(told: str) -> None:
    """Whole messages, and nothing is added."""
    simulation = Simulation()
    words: dict[str, Any] = {"end": (2.0, 0.0, 0.0), "count": 10, "radius": 0.02, **REFUSED[told]}
    with pytest.raises(DeclarationError) as refused:
        add_chain(simulation, "rope", (0.0, 0.0, 0.0), words.pop("end"), words.pop("count"), **words)
    assert str(refused.value) == told
    assert simulation.world.names() == []
