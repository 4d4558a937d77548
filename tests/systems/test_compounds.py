"""Compounds: carried colliders are part of the body above them, in mass, motion, contact and bounds."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from faults import error

from carom.ecs import Collider, ColliderPose, DeclarationError, Motion, Parent, RigidBody, Transform
from carom.ecs.relations.contact import Contact
from carom.ecs.spatial import quaternion
from carom.systems.bodies import centers_of_mass
from carom.systems.compound import bodies_of, reaches
from carom.systems.detection.bounds import reach_within
from carom.systems.energy import angular_momentum, kinetic_energy
from carom.systems.simulation import Simulation
from carom.worlds import WorldError, load_text

TURN = quaternion.from_axis_angle((1.0, 2.0, -1.0), 0.7)


def boxes(*parts: tuple[Any, Any], density: float = 1000.0) -> tuple[float, Any, Any]:
    """Return mass, centre and inertia matrix of boxes (size, centre), from the sum over their eight octants each.

    A box of edges a has the moments of eight points at a / (2 sqrt 3) from its middle.
    """
    points, masses = [], []
    for size, center in parts:
        for signs in np.ndindex(2, 2, 2):
            points.append(np.array(center) + (np.array(signs) - 0.5) * np.array(size) / math.sqrt(3.0))
            masses.append(density * np.prod(size) / 8.0)
    x, m = np.array(points), np.array(masses)
    center = (m[:, None] * x).sum(axis=0) / m.sum()
    x = x - center
    return m.sum(), center, (m * (x * x).sum(axis=1)).sum() * np.eye(3) - (m[:, None] * x).T @ x


def inertia_of(simulation: Simulation, name: str) -> Any:
    """Return the inertia matrix (kg m2) of a body in its own frame."""
    body = simulation[name].rigid_body
    axes = quaternion.matrix(body.principal_axes)
    return axes @ np.diag(body.inertia) @ axes.T


def hammer(**options: Any) -> Simulation:
    """Return a hammer: a handle that is the body, and a head that it carries, turned a quarter."""
    simulation = Simulation(**options)
    simulation.add(
        name="handle", body={}, collider={"box": {"size": (0.1, 1.0, 0.1)}}, transform={"position": (0.0, 3.0, 0.0)},
        motion={"linear": (0.5, 2.0, 0.0), "angular": (1.0, 2.0, 6.5)},
    )  # fmt: skip
    quarter = quaternion.from_axis_angle((0.0, 0.0, 1.0), math.pi / 2)
    handle = simulation.world.find("handle")
    simulation.add(
        name="head", collider={"box": {"size": (0.2, 0.6, 0.2)}}, material={"density": 3000.0},
        parent={"entity": handle, "position": (0.0, 0.6, 0.0), "rotation": quarter},
    )  # fmt: skip
    return simulation


def test_mass_is_the_sum_over_the_parts() -> None:
    """Each part by its own material; centre and inertia as those of sixteen points."""
    simulation = hammer()
    head = np.array([0.6, 0.2, 0.2])
    light, heavy = boxes(((0.1, 1.0, 0.1), (0, 0, 0))), boxes((head, (0, 0.6, 0)), density=3000.0)
    mass = light[0] + heavy[0]
    center = (light[0] * light[1] + heavy[0] * heavy[1]) / mass
    inertia = sum(
        m * (np.dot(c - center, c - center) * np.eye(3) - np.outer(c - center, c - center)) + i
        for m, c, i in (light, heavy)
    )
    body = simulation["handle"].rigid_body
    assert body.mass == pytest.approx(mass, rel=1e-14)
    assert body.inverse_mass == pytest.approx(1.0 / mass, rel=1e-14)
    assert body.center_of_mass == pytest.approx(center, abs=1e-15)
    assert inertia_of(simulation, "handle") == pytest.approx(inertia, abs=1e-12)
    assert body.inverse_inertia == pytest.approx(1.0 / body.inertia, rel=1e-14)


FILE = """carom: 1
entities:
  - {name: left, parent: {entity: bar, position: [-1, 0, 0]}, collider: {box: {size: [1, 1, 1]}}}
  - {name: bar, body: BODY}
  - {name: joint, parent: {entity: bar}}
  - {name: right, parent: {entity: joint, position: [2, 0, 0]}, collider: {box: {size: [1, 1, 2]}}}
  - {name: eye, parent: {entity: bar, position: [0, 9, 0]}, collider: {sphere: {radius: 1}, sensor: true}}
"""


@pytest.mark.parametrize(
    ("words", "mass", "center"),
    [("{}", 3000.0, 1.0), ("{mass: 6}", 6.0, 1.0), ("{mass: 6, center_of_mass: [0, 1, 0]}", 6.0, None)],
)
def test_files_say_it_in_any_order(words: str, mass: float, center: float | None) -> None:
    """A bar without a shape of its own, one part carried by what it carries; a stated mass is shared out by volume."""
    simulation = load_text(FILE.replace("BODY", words)).simulation
    body = simulation["bar"].rigid_body
    assert body.mass == pytest.approx(mass, rel=1e-15)
    assert body.center_of_mass == pytest.approx([0, 1, 0] if center is None else [center, 0, 0], abs=1e-15)
    total, _, inertia = boxes(((1, 1, 1), (-1, 0, 0)), ((1, 1, 2), (2, 0, 0)))
    assert inertia_of(simulation, "bar") == pytest.approx(inertia * mass / total, rel=1e-12)
    names = ["left", "bar", "joint", "right", "eye"]
    assert [simulation.world.name(simulation.world.entity(row)) for row in bodies_of(simulation.world)] == ["bar"] * 5
    assert simulation.world.names() == names


def test_points_share_a_stated_mass_evenly() -> None:
    """Two points 2 m apart turn about their middle: m l^2 across, nothing about the line between them."""
    simulation = Simulation()
    bar = simulation.add(name="bar", body={"mass": 4.0})
    for side in (0.0, 2.0):
        simulation.add(parent={"entity": bar, "position": (side, 0.0, 0.0)}, collider={"point": {}})
    body = simulation["bar"].rigid_body
    assert body.center_of_mass.tolist() == [1.0, 0.0, 0.0]
    assert body.inertia.tolist() == [0.0, 4.0, 4.0]
    assert body.inverse_inertia.tolist() == [0.0, 0.25, 0.25]


def test_the_centre_flies_a_parabola_and_the_spin_keeps_its_momentum() -> None:
    """A thrown hammer tumbles about its centre of mass; with verlet gravity alone is exact at every step."""
    simulation = hammer(dt=1 / 240)
    world = simulation.world
    rows = world.row_numbers(RigidBody)
    start = centers_of_mass(world, rows)[0].copy()
    velocity, energy = np.array([0.5, 2.0, 0.0]), kinetic_energy(world)
    spin = angular_momentum(world) - simulation["handle"].rigid_body.mass * np.cross(start, velocity)
    simulation.step(120)
    time = simulation.time
    fallen = velocity + np.array([0.0, -9.81, 0.0]) * time
    expected = start + velocity * time + 0.5 * np.array([0.0, -9.81, 0.0]) * time**2
    center = centers_of_mass(world, rows)[0]
    mass = simulation["handle"].rigid_body.mass
    assert center == pytest.approx(expected, abs=1e-13)
    assert angular_momentum(world) - mass * np.cross(center, fallen) == pytest.approx(spin, rel=1e-12, abs=1e-12)
    turning = kinetic_energy(world) - 0.5 * mass * fallen @ fallen
    assert turning == pytest.approx(energy - 0.5 * mass * velocity @ velocity, rel=1e-6)  # of order dt^2


def test_parts_follow_within_the_step() -> None:
    """What is detected is where the body is now, also when it was put elsewhere between two steps."""
    simulation = hammer()
    simulation.step(7)
    simulation["handle"].transform.position = (5.0, 6.0, 7.0)
    simulation["handle"].transform.rotation = TURN
    with simulation.world.faces(None):
        reach_within(simulation.world, 1 / 60)
    pose, row = simulation.world[ColliderPose], simulation.world.row(simulation.world.find("head"))
    quarter = quaternion.from_axis_angle((0.0, 0.0, 1.0), math.pi / 2)
    assert pose.position[row] == pytest.approx(np.add((5, 6, 7), quaternion.rotate(TURN, (0.0, 0.6, 0.0))), abs=1e-15)
    assert pose.rotation[row] == pytest.approx(quaternion.multiply(TURN, quarter), abs=1e-15)
    assert pose.body_row[row] == simulation.world.row(simulation.world.find("handle"))


def test_bounds_hold_what_a_spinning_arm_can_reach() -> None:
    """A small part 2 m from the centre of a body that turns at 20 rad/s moves 0.6 m in a step of 1/60 s."""
    simulation = Simulation(gravity=(0.0, 0.0, 0.0))
    hub = simulation.add(name="hub", body={"mass": 1.0, "center_of_mass": (0, 0, 0)}, motion={"angular": (0, 0, 20)})
    simulation.add(
        name="tip", parent={"entity": hub, "position": (2.0, 0.0, 0.0)}, collider={"sphere": {"radius": 0.1}}
    )
    world = simulation.world
    simulation.step()
    pose, row = world[ColliderPose], world.row(world.find("tip"))
    lower, upper = pose.lower[row].copy(), pose.upper[row].copy()
    tip = simulation["tip"].transform.position
    assert tip[1] == pytest.approx(2.0 * math.sin(20.0 / 60.0), rel=1e-12)
    assert (lower <= tip - 0.1).all()
    assert (tip + 0.1 <= upper).all()
    assert reaches(world)[world.row(hub)] == pytest.approx(2.1)


def test_a_hammer_comes_to_rest_on_the_ground() -> None:
    """The centre of mass lies over the heavy head: it stands on one of its long sides, the handle in the air.

    The handle is the body, but the head is what touches, and its contacts say so.
    """
    simulation = hammer(dt=1 / 120, sleeping=False)
    simulation.add(name="floor", collider={"plane": {}})
    simulation.step(120 * 6)
    world = simulation.world
    motion, contact = simulation["handle"].motion, world[Contact]
    assert np.linalg.norm(motion.linear) < 1e-3
    assert np.linalg.norm(motion.angular) < 1e-3
    assert simulation["head"].transform.position[1] == pytest.approx(0.1, abs=1e-3)
    touching = contact.depth[: contact.count] > -1e-3
    names = {world.name(int(e)) for e in (*contact.a[: contact.count][touching], *contact.b[: contact.count][touching])}
    assert names == {"head", "floor"}
    assert simulation["handle"].transform.position[1] == pytest.approx(0.1, abs=1e-3)
    bodies = np.maximum(contact.body_a[: contact.count], contact.body_b[: contact.count])
    assert set(bodies.tolist()) == {world.row(world.find("handle"))}


def drop(parts: list[tuple[tuple[float, float, float], tuple[float, float, float]]]) -> Simulation:
    """Return a body of boxes (size, centre), thrown at a floor, with restitution."""
    simulation = Simulation(dt=1 / 240)
    bouncy = {"restitution": 0.5, "friction": 0.3}
    simulation.add(collider={"plane": {}}, material=bouncy)
    motion = {"linear": (1.0, 0.0, 0.2), "angular": (0.3, -0.2, 1.5)}
    pose = {"position": (0.0, 1.2, 0.0), "rotation": TURN}
    if len(parts) == 1:
        simulation.add(
            name="it", body={}, transform=pose, motion=motion, collider={"box": {"size": parts[0][0]}}, material=bouncy
        )
        return simulation
    mass = 1000.0 * sum(math.prod(size) for size, _ in parts)
    body = simulation.add(name="it", body={"mass": mass}, transform=pose, motion=motion)
    for size, center in parts:
        simulation.add(collider={"box": {"size": size}}, parent={"entity": body, "position": center}, material=bouncy)
    return simulation


def test_two_halves_are_the_whole() -> None:
    """Cut in two across its length, a box falls, bounces on a corner and tumbles as the one box does, to rounding."""
    whole = drop([((0.8, 0.3, 0.4), (0.0, 0.0, 0.0))])
    halves = drop([((0.4, 0.3, 0.4), (-0.2, 0.0, 0.0)), ((0.4, 0.3, 0.4), (0.2, 0.0, 0.0))])
    bounced = False
    for _ in range(150):
        whole.step()
        halves.step()
        bounced |= bool(whole["it"].motion.linear[1] > 0.5)
        for kind, column in ((Transform, "position"), (Transform, "rotation"), (Motion, "linear"), (Motion, "angular")):
            one, other = (getattr(s["it"][kind], column) for s in (whole, halves))
            assert np.abs(one - other).max() < 1e-11
    assert bounced


def test_parts_of_one_body_do_not_touch_each_other_but_meet_others() -> None:
    """Overlapping parts are no pair; a part and a foreign ball are, named as themselves."""
    simulation = hammer(gravity=(0.0, 0.0, 0.0))
    simulation.add(name="ball", body={}, collider={"sphere": {"radius": 0.2}}, transform={"position": (0.0, 3.85, 0.0)})
    simulation.step()
    world, contact = simulation.world, simulation.world[Contact]
    pairs = {
        (world.name(int(a)), world.name(int(b)))
        for a, b in zip(contact.a[: contact.count], contact.b[: contact.count], strict=True)
    }
    assert pairs == {("head", "ball")}
    handle = world.row(world.find("handle"))
    assert contact.body_a[0] == handle
    assert contact.friction[0] == pytest.approx(0.5)


def test_who_is_let_go_is_static_and_who_is_handed_over_follows() -> None:
    """The body is looked up anew in every step, by who carries whom."""
    simulation = hammer(gravity=(0.0, 0.0, 0.0))
    world = simulation.world
    head, handle = world.find("head"), world.find("handle")
    other = simulation.add(name="other", body={"mass": 1.0})
    simulation[head].parent.entity = other
    assert bodies_of(world)[world.row(head)] == world.row(other)
    world.detach(head, Parent)
    assert bodies_of(world)[world.row(head)] == -1
    world.despawn(handle)
    simulation.step()
    assert world[Collider].shape[world.row(head)] == 1


def test_faults_from_python() -> None:
    """A static shape on a body, and a body that nothing gives a mass; neither stays behind."""
    simulation = Simulation()
    car = simulation.add(name="car", body={"mass": 1.0})
    message = "collider.plane: only a static entity may have it, and 'car' has a body"
    with error(DeclarationError, message):
        simulation.add(name="road", parent={"entity": car}, collider={"plane": {}})
    assert simulation.world.names() == ["car"]


def test_faults_in_files() -> None:
    """Told where the part, or the body without mass, stands."""
    text = """carom: 1
entities:
  - {name: car, body: {mass: 1}}
  - {name: road, parent: {entity: car}, collider: {height_field: {heights: [[0, 0], [0, 0]], spacing: 1}}}
  - {name: sky, parent: {entity: car}, collider: {plane: {}}}
"""
    with pytest.raises(WorldError) as caught:
        load_text(text, "w.yaml")
    assert str(caught.value).split("\n") == [
        "w.yaml:4:52: entities.1.collider.height_field: only a static entity may have it, and 'car' has a body",
        "w.yaml:5:51: entities.2.collider.plane: only a static entity may have it, and 'car' has a body",
    ]
    text = "carom: 1\nentities:\n  - {name: cart, body: {}}\n  - {name: flag, parent: {entity: cart}}\n"
    with pytest.raises(WorldError) as caught:
        load_text(text, "w.yaml")
    assert str(caught.value) == (
        "w.yaml:3:18: entities.0.body.mass: must be finite and above 0 kg, received 0; "
        "state mass, or a shape with volume"
    )
