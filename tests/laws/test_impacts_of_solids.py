"""Impacts of boxes and capsules: face on as balls, and off centre by the closed form with moments of inertia."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np
import pytest

from carom.ecs import Motion, RigidBody, Transform
from carom.ecs.relations.impact import Impact
from carom.ecs.spatial import quaternion
from carom.systems.simulation import Simulation

UPRIGHT = quaternion.IDENTITY
LYING = quaternion.from_axis_angle((0.0, 0.0, 1.0), math.pi / 2.0)
BOX = {"box": {"size": (0.5, 0.4, 0.3)}}
CAPSULE = {"capsule": {"radius": 0.2, "length": 0.6}}


class Pose(NamedTuple):
    """A shape, turned, and how far it reaches along x and y then."""

    shape: dict[str, Any]
    rotation: Any
    along: float
    up: float


POSES = {
    "box": Pose(BOX, UPRIGHT, 0.25, 0.2),
    "capsule upright": Pose(CAPSULE, UPRIGHT, 0.2, 0.5),
    "capsule lying": Pose(CAPSULE, LYING, 0.5, 0.2),
}
RATIOS = [0.001, 0.1, 1.0, 10.0, 1000.0]
RESTITUTIONS = [0.0, 0.5, 1.0]
WHEN = 0.0479  # s: in the midst of a step


def material(restitution: float, friction: float = 0.0) -> dict[str, float]:
    """Return the words of a material."""
    return {"restitution": restitution, "friction": friction}


def free(**settings: Any) -> Simulation:
    """Return a world without gravity."""
    return Simulation(gravity=(0.0, 0.0, 0.0), checked=False, **settings)


def random_turns(count: int, seed: int) -> np.ndarray:
    """Return random rotations (count, 4)."""
    return quaternion.normalise(np.random.default_rng(seed).normal(size=(count, 4)))


@pytest.mark.parametrize("pose", POSES)
@pytest.mark.parametrize("turn", random_turns(8, seed=1), ids=lambda turn: np.array2string(turn, precision=2))
def test_a_solid_is_reflected_face_on_off_any_plane(turn: np.ndarray, pose: str) -> None:
    """V' = v - 2 (v.n) n within 1e-9, whatever way the plane is turned, and nothing begins to spin."""
    shape, rotation, _, up = POSES[pose]
    normal = quaternion.rotate(turn, (0.0, 1.0, 0.0))
    velocity = quaternion.rotate(turn, (1.5, -2.0, 0.7))
    simulation = free()
    simulation.add(collider={"plane": {"normal": tuple(normal), "offset": 0.3}}, material=material(1.0))
    solid = simulation.add(
        collider=shape, body={}, material=material(1.0),
        transform={"position": (0.3 + up + 0.5) * normal, "rotation": quaternion.multiply(turn, rotation)},
        motion={"linear": velocity},
    )  # fmt: skip
    simulation.step(30)
    assert simulation[solid].motion.linear == pytest.approx(quaternion.rotate(turn, (1.5, 2.0, 0.7)), abs=1e-9)
    assert np.abs(simulation[solid].motion.angular).max() <= 1e-9


@pytest.mark.parametrize("restitution", RESTITUTIONS)
@pytest.mark.parametrize("two", POSES)
@pytest.mark.parametrize("one", POSES)
def test_solids_meet_head_on(one: str, two: str, restitution: float) -> None:
    """They part at e times their closing speed within 1e-9 and keep momentum within 1e-12, whatever the mass ratio."""
    for ratio in RATIOS:
        simulation = free()
        first = simulation.add(
            collider=POSES[one].shape, body={"mass": ratio}, material=material(restitution, friction=0.5),
            transform={"position": (-1.2, 0.0, 0.0), "rotation": POSES[one].rotation},
            motion={"linear": (2.0, 0.0, 0.0)},
        )  # fmt: skip
        second = simulation.add(
            collider=POSES[two].shape, body={"mass": 1.0}, material=material(restitution, friction=0.5),
            transform={"rotation": POSES[two].rotation},
        )  # fmt: skip
        simulation.step(60)
        a, b = simulation[first].motion, simulation[second].motion
        assert b.linear[0] - a.linear[0] == pytest.approx(2.0 * restitution, abs=1e-9)
        assert ratio * a.linear + b.linear == pytest.approx([2.0 * ratio, 0.0, 0.0], abs=1e-12 * 2.0 * max(ratio, 1.0))
        assert np.abs([a.angular, b.angular]).max() <= 1e-9


@pytest.mark.parametrize("restitution", RESTITUTIONS)
@pytest.mark.parametrize(("speed", "dt"), [(1e-4, 1 / 60), (2e-3, 1 / 60), (0.01, 1 / 60), (1.0, 1 / 6000)])
@pytest.mark.parametrize("two", POSES)
@pytest.mark.parametrize("one", POSES)
def test_solids_strike_that_cross_the_last_gap_in_many_substeps(
    one: str, two: str, speed: float, dt: float, restitution: float
) -> None:
    """They part at e times their closing speed within 1e-9 of it, and it is one impact.

    They are within the gap at which what does not close rests, and were held there, without restitution and untold.
    """
    simulation = free(dt=dt)
    apart = POSES[one].along + POSES[two].along + 2e-4
    first = simulation.add(
        collider=POSES[one].shape, body={"mass": 2.0}, material=material(restitution),
        transform={"position": (-apart, 0.0, 0.0), "rotation": POSES[one].rotation},
        motion={"linear": (speed, 0.0, 0.0)},
    )  # fmt: skip
    second = simulation.add(
        collider=POSES[two].shape, body={"mass": 1.0}, material=material(restitution),
        transform={"rotation": POSES[two].rotation},
    )  # fmt: skip
    times: list[float] = []
    for _ in range(math.ceil(3e-4 / (speed * dt))):
        simulation.step()
        impact = simulation.world[Impact]
        times.extend(impact.time[: impact.count])
    a, b = simulation[first].motion.linear[0], simulation[second].motion.linear[0]
    assert b - a == pytest.approx(speed * restitution, abs=1e-9 * speed)
    assert 2.0 * a + b == pytest.approx(2.0 * speed, abs=1e-12 * speed)
    assert times == pytest.approx([2e-4 / speed], rel=1e-9)


@pytest.mark.parametrize("dt", [1 / 60, 1 / 240, 1 / 37])
@pytest.mark.parametrize("restitution", [0.0, 0.25, 0.5, 0.75, 1.0])
@pytest.mark.parametrize("pose", POSES)
def test_a_dropped_solid_rises_by_the_square_of_its_restitution(pose: str, restitution: float, dt: float) -> None:
    """sqrt(h1 / h0) is e within 1e-6; what does not bounce rises by less than 1 um, which is what rest leaves open."""
    shape, rotation, _, up = POSES[pose]
    simulation = Simulation(dt=dt, checked=False)
    simulation.add(collider={"plane": {}}, material=material(0.0))
    solid = simulation.add(
        collider=shape, body={}, material=material(restitution),
        transform={"position": (0.0, 1.0 + up, 0.0), "rotation": rotation},
    )  # fmt: skip
    while simulation.world.count(Impact) == 0:
        simulation.step()
    assert simulation.world[Impact].time[0] == pytest.approx(math.sqrt(2.0 / 9.81), abs=1e-12)
    body = simulation[solid]
    height = body.transform.position[1] - up + body.motion.linear[1] ** 2 / (2.0 * 9.81)
    if restitution > 0.0:
        assert math.sqrt(height) == pytest.approx(restitution, abs=1e-6)
    else:
        assert height <= 1e-6


class Blow(NamedTuple):
    """The impulse along the surface and along its normal, N s."""

    along: float
    normal: float


def closed_form(yields: np.ndarray, slip: float, closing: float, friction: float, restitution: float) -> Blow:
    """Return the impulse at a point that yields by the matrix [[tt, tn], [tn, nn]] to one, by Poisson's restitution.

    Compression ends where nothing closes: the point sticks if Coulomb's cone allows, else it slides on. Restitution
    gives back e times the normal impulse; the friction then is what stops the point, or as much as the cone allows.
    """
    (tt, tn), (_, nn) = yields
    along, normal = -np.linalg.solve(yields, (slip, -closing))
    if abs(along) > friction * normal:
        for side in (-1.0, 1.0):
            pressed = closing / (nn - friction * side * tn)
            if pressed > 0.0 and (slip + (tn - friction * side * tt) * pressed) * side > 0.0:
                normal = pressed
    normal *= 1.0 + restitution
    most = friction * normal
    return Blow(float(np.clip(-(slip + tn * normal) / tt, -most, most)), float(normal))


def yielding(mass: float, inertia: float, lever: np.ndarray) -> np.ndarray:
    """Return how a point of a body moves in a plane by an impulse there; ``inertia`` is about the third axis."""
    x, y = lever[:2]
    return np.eye(2) / mass + np.array([[y * y, -x * y], [-x * y, x * x]]) / inertia


def lowest(shape: dict[str, Any], angle: float) -> np.ndarray:
    """Return the point of a solid turned about z that reaches lowest, from its middle."""
    along, up = np.array([math.cos(angle), math.sin(angle)]), np.array([-math.sin(angle), math.cos(angle)])
    if shape is BOX:
        return min((x * along + y * up for x in (-0.25, 0.25) for y in (-0.2, 0.2)), key=lambda place: place[1])
    return -0.3 * up * np.sign(up[1]) - [0.0, 0.2]


def momenta(simulation: Simulation) -> tuple[np.ndarray, np.ndarray]:
    """Return all momentum, and angular momentum about the origin."""
    world = simulation.world
    rows = world.rows(RigidBody)
    body, motion = world[RigidBody], world[Motion]
    linear = body.mass[rows][:, None] * motion.linear[rows]
    axes = quaternion.matrix(quaternion.multiply(world[Transform].rotation[rows], body.principal_axes[rows]))
    local = np.einsum("nij,ni->nj", axes, motion.angular[rows]) * body.inertia[rows]
    spin = np.einsum("nij,nj->ni", axes, local) + np.cross(world[Transform].position[rows], linear)
    return linear.sum(axis=0), spin.sum(axis=0)


@pytest.mark.parametrize("restitution", RESTITUTIONS)
@pytest.mark.parametrize("friction", [0.0, 0.1, 0.5, 2.0])
@pytest.mark.parametrize("shape", [BOX, CAPSULE], ids=["box", "capsule"])
def test_a_solid_strikes_a_plane_off_centre(shape: dict[str, Any], friction: float, restitution: float) -> None:
    """At a corner or an end: impulse, velocity and spin are those of the closed form within 1e-9, turned anyhow."""
    for angle, speed, turn in zip((0.3, 0.9, -0.5, -1.1), (0.0, 3.0, -1.0, 6.0), random_turns(4, seed=2), strict=True):
        simulation = free(dt=1 / 240)
        normal = quaternion.rotate(turn, (0.0, 1.0, 0.0))
        simulation.add(collider={"plane": {"normal": tuple(normal)}}, material=material(restitution, friction))
        lever = lowest(shape, angle)
        tilt = quaternion.from_axis_angle((0.0, 0.0, 1.0), angle)
        solid = simulation.add(
            collider=shape, body={"mass": 1.7}, material=material(restitution, friction),
            transform={
                "position": quaternion.rotate(turn, (0.0, 2.0 * WHEN - lever[1], 0.0)),
                "rotation": quaternion.multiply(turn, tilt),
            },
            motion={"linear": quaternion.rotate(turn, (speed, -2.0, 0.0))},
        )  # fmt: skip
        while simulation.world.count(Impact) == 0:
            simulation.step()
        inertia = float(simulation.world[RigidBody].inertia[simulation.world.row(solid)][2 if shape is BOX else 0])
        blow = closed_form(yielding(1.7, inertia, lever), speed, 2.0, friction, restitution)
        impact = simulation.world[Impact]
        assert impact.time[0] == pytest.approx(WHEN, abs=1e-12)
        assert impact.impulse[0] == pytest.approx(blow.normal, abs=1e-9)
        friction_impulse = quaternion.rotate(turn, (blow.along, 0.0, 0.0))
        assert impact.friction_impulse[0] == pytest.approx(friction_impulse, abs=1e-9)
        if restitution == 0.0 or impact.count > 1:
            continue  # it goes on in contact
        linear = np.array([speed + blow.along / 1.7, -2.0 + blow.normal / 1.7, 0.0])
        spin = np.array([0.0, 0.0, (lever[0] * blow.normal - lever[1] * blow.along) / inertia])
        assert simulation[solid].motion.linear == pytest.approx(quaternion.rotate(turn, linear), abs=1e-9)
        assert simulation[solid].motion.angular == pytest.approx(quaternion.rotate(turn, spin), abs=1e-9)


@pytest.mark.parametrize("restitution", RESTITUTIONS)
@pytest.mark.parametrize("friction", [0.0, 0.1, 0.5, 2.0])
@pytest.mark.parametrize("shape", [BOX, CAPSULE], ids=["box", "capsule"])
@pytest.mark.parametrize("ratio", [0.1, 1.0, 10.0])
def test_a_solid_strikes_a_box_off_centre(
    shape: dict[str, Any], ratio: float, friction: float, restitution: float
) -> None:
    """Both yield: the impulse is that of the closed form, momentum and angular momentum stay within 1e-12."""
    for angle, speed, place in ((0.4, 0.0, 0.3), (-0.7, 2.0, -0.4), (1.2, -4.0, 0.1)):
        simulation = free(dt=1 / 240)
        lever = lowest(shape, angle)
        simulation.add(
            collider=shape, body={"mass": ratio}, material=material(restitution, friction),
            transform={
                "position": (place - lever[0] - WHEN * speed, 0.5 + 2.0 * WHEN - lever[1], 0.0),
                "rotation": quaternion.from_axis_angle((0.0, 0.0, 1.0), angle),
            },
            motion={"linear": (speed, -2.0, 0.0)},
        )  # fmt: skip
        simulation.add(
            collider={"box": {"size": (2.0, 1.0, 1.0)}}, body={"mass": 1.0}, material=material(restitution, friction)
        )
        before = momenta(simulation)
        while simulation.world.count(Impact) == 0:
            simulation.step()
        inertia = simulation.world[RigidBody].inertia[simulation.world.rows(RigidBody)]
        yields = yielding(ratio, float(inertia[0, 2 if shape is BOX else 0]), lever)
        yields += yielding(1.0, float(inertia[1, 2]), np.array([place, 0.5]))
        blow = closed_form(yields, speed, 2.0, friction, restitution)
        impact = simulation.world[Impact]
        assert impact.time[0] == pytest.approx(WHEN, abs=1e-12)
        assert impact.impulse[0] == pytest.approx(blow.normal, abs=1e-9)
        assert impact.friction_impulse[0] == pytest.approx([-blow.along, 0.0, 0.0], abs=1e-9)  # on b, the box
        for now, then in zip(momenta(simulation), before, strict=True):
            assert np.abs(now - then).max() <= 1e-12 * max(1.0, ratio) * 10.0
