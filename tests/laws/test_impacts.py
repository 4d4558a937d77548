"""Impacts: single ones are exact, for any plane, mass ratio, restitution and friction."""

from __future__ import annotations

import math

import numpy as np
import pytest

from carom.ecs import Motion, Transform
from carom.ecs.relations.impact import Impact
from carom.systems.energy import total_energy
from carom.systems.simulation import Simulation

SMOOTH = {"friction": 0.0, "restitution": 1.0}


def unit_vectors(count: int, seed: int) -> np.ndarray:
    """Return random directions (count, 3)."""
    vectors = np.random.default_rng(seed).normal(size=(count, 3))
    return vectors / np.linalg.norm(vectors, axis=1, keepdims=True)


@pytest.mark.parametrize("normal", unit_vectors(20, seed=1), ids=lambda n: np.array2string(n, precision=2))
def test_a_ball_is_reflected_off_any_plane(normal: np.ndarray) -> None:
    """V' = v - 2 (v.n) n within 1e-9 of the speed, without gravity, friction or loss."""
    velocity = 3.0 * unit_vectors(1, seed=int(abs(normal[0]) * 1e6))[0]
    velocity -= normal * (velocity @ normal + 2.0)  # closes at 2 m/s
    simulation = Simulation(gravity=(0.0, 0.0, 0.0))
    simulation.add(collider={"plane": {"normal": tuple(normal), "offset": 0.3}}, material=SMOOTH)
    ball = simulation.add(
        collider={"sphere": {"radius": 0.1}},
        body={},
        material=SMOOTH,
        transform={"position": (0.3 + 0.1 + 0.5) * normal},
        motion={"linear": velocity},
    )
    simulation.step(30)
    expected = velocity - 2.0 * (velocity @ normal) * normal
    assert np.abs(simulation[ball].motion.linear - expected).max() <= 1e-9 * np.linalg.norm(velocity)


@pytest.mark.parametrize("ratio", [0.001, 0.01, 0.1, 1.0, 10.0, 100.0, 1000.0])
@pytest.mark.parametrize("shape", [{"sphere": {"radius": 0.1}}, {"point": {}}], ids=["sphere", "point"])
def test_two_bodies_exchange_velocities_elastically(ratio: float, shape: dict[str, object]) -> None:
    """v1' = (m1 - m2) / (m1 + m2) u and v2' = 2 m1 / (m1 + m2) u within 1e-9, momentum within 1e-12."""
    simulation = Simulation(gravity=(0.0, 0.0, 0.0))
    one = simulation.add(
        collider=shape,
        body={"mass": ratio},
        material=SMOOTH,
        transform={"position": (-1.0, 0.0, 0.0)},
        motion={"linear": (4.0, 0.0, 0.0)},
    )
    two = simulation.add(collider={"sphere": {"radius": 0.1}}, body={"mass": 1.0}, material=SMOOTH)
    simulation.step(60)
    first, second = simulation[one].motion.linear, simulation[two].motion.linear
    assert first == pytest.approx([4.0 * (ratio - 1.0) / (ratio + 1.0), 0.0, 0.0], abs=4e-9)
    assert second == pytest.approx([8.0 * ratio / (ratio + 1.0), 0.0, 0.0], abs=4e-9)
    assert abs(ratio * first[0] + second[0] - 4.0 * ratio) <= 1e-12 * 4.0 * max(ratio, 1.0)


@pytest.mark.parametrize("ratio", [1.0, 10.0, 1000.0])
@pytest.mark.parametrize("restitution", [0.0, 0.5, 1.0])
def test_two_blocks_meet_head_on(ratio: float, restitution: float) -> None:
    """Blocks part at e times their closing speed and keep momentum, whatever the mass ratio."""
    simulation = Simulation(gravity=(0.0, 0.0, 0.0))
    material = {"friction": 0.5, "restitution": restitution}
    block = {"box": {"size": (0.5, 0.4, 0.3)}}
    one = simulation.add(
        collider=block,
        body={"mass": ratio},
        material=material,
        transform={"position": (-1.0, 0.0, 0.0)},
        motion={"linear": (2.0, 0.0, 0.0)},
    )
    two = simulation.add(collider=block, body={"mass": 1.0}, material=material)
    simulation.step(60)
    first, second = simulation[one].motion.linear, simulation[two].motion.linear
    assert second[0] - first[0] == pytest.approx(2.0 * restitution, abs=2e-9)
    assert ratio * first[0] + second[0] == pytest.approx(2.0 * ratio, abs=2e-12 * ratio)
    assert np.abs(simulation[one].motion.angular).max() < 1e-9
    assert np.abs(simulation[two].motion.angular).max() < 1e-9


@pytest.mark.parametrize("dt", [1 / 60, 1 / 240, 1 / 37])
@pytest.mark.parametrize("restitution", [0.0, 0.25, 0.5, 0.75, 1.0])
def test_a_dropped_ball_rises_by_the_square_of_its_restitution(restitution: float, dt: float) -> None:
    """sqrt(h1 / h0) is e within 1e-6, by the energy between the first two bounces."""
    simulation = Simulation(dt=dt)
    simulation.add(collider={"plane": {}}, material={"restitution": 0.0})
    ball = simulation.add(
        collider={"sphere": {"radius": 0.1}},
        body={},
        material={"restitution": restitution},
        transform={"position": (0.0, 1.1, 0.0)},
    )
    while simulation.world.count(Impact) == 0:
        simulation.step()
    if simulation.world.count(Impact) > 1:
        pytest.fail("the second bounce came in the same step")
    body = simulation[ball]
    height = body.transform.position[1] - 0.1 + body.motion.linear[1] ** 2 / (2.0 * 9.81)
    assert math.sqrt(max(height, 0.0)) == pytest.approx(restitution, abs=1e-6)
    assert simulation.world[Impact].time[0] == pytest.approx(math.sqrt(2.0 / 9.81), abs=1e-12)


@pytest.mark.parametrize(
    ("sideways", "after", "spin"), [(10.0, 7.3, 13.5), (5.0, 25.0 / 7.0, 50.0 / 7.0)], ids=["slides", "sticks"]
)
def test_a_bounce_with_friction_gives_spin(sideways: float, after: float, spin: float) -> None:
    """Coulomb's cone over the whole normal impulse: a solid sphere of radius 0.5 slides at 10 m/s and sticks at 5."""
    simulation = Simulation(gravity=(0.0, 0.0, 0.0))
    simulation.add(collider={"plane": {}}, material={"restitution": 0.8, "friction": 0.3})
    ball = simulation.add(
        collider={"sphere": {"radius": 0.5}},
        body={},
        material={"restitution": 0.8, "friction": 0.3},
        transform={"position": (0.0, 1.0, 0.0)},
        motion={"linear": (sideways, -5.0, 0.0)},
    )
    simulation.step(30)
    assert simulation[ball].motion.linear == pytest.approx([after, 4.0, 0.0], abs=1e-6)
    assert simulation[ball].motion.angular == pytest.approx([0.0, 0.0, -spin], abs=1e-6)


@pytest.mark.parametrize("phase", range(20))
def test_a_half_ball_hit_parts_the_balls_at_30_and_60_degrees(phase: int) -> None:
    """Equal balls, e = 1, no friction, 8 m/s: within 0.1 degrees in every phase of the step."""
    radius = 0.028575
    simulation = Simulation(dt=1 / 240, gravity=(0.0, 0.0, 0.0))
    start = -0.5 - 8.0 / 240.0 * phase / 20.0
    cue = simulation.add(
        collider={"sphere": {"radius": radius}},
        body={"mass": 0.17},
        material=SMOOTH,
        transform={"position": (start, 0.0, radius)},
        motion={"linear": (8.0, 0.0, 0.0)},
    )
    target = simulation.add(collider={"sphere": {"radius": radius}}, body={"mass": 0.17}, material=SMOOTH)
    simulation.step(40)
    angles = [
        math.degrees(math.atan2(simulation[ball].motion.linear[2], simulation[ball].motion.linear[0]))
        for ball in (target, cue)
    ]
    assert angles == pytest.approx([-30.0, 60.0], abs=1e-7)


def test_points_and_boxes_meet_where_their_arcs_do() -> None:
    """A thrown point meets a box face, edge-on and under gravity, at the time of the closed form."""
    simulation = Simulation(dt=1 / 60)
    simulation.add(
        collider={"box": {"size": (1.0, 1.0, 1.0)}}, material=SMOOTH, transform={"position": (2.0, 0.0, 0.0)}
    )
    point = simulation.add(
        collider={"point": {}}, body={"mass": 1.0}, material=SMOOTH, motion={"linear": (3.0, 2.0, 0.0)}
    )
    while simulation.world.count(Impact) == 0:
        simulation.step()
    impact = simulation.world[Impact]
    assert impact.time[0] == pytest.approx(0.5, abs=1e-12)
    assert impact.point[0] == pytest.approx([1.5, 1.0 - 9.81 / 8.0, 0.0], abs=1e-12)
    assert simulation.world[Motion].linear[simulation.world.row(point), 0] == pytest.approx(-3.0, abs=1e-12)
    assert np.isfinite(simulation.world[Transform].position).all()


@pytest.mark.parametrize(("restitution", "friction"), [(1.0, 0.0), (1.0, 0.5), (0.7, 0.5)])
@pytest.mark.parametrize(
    "solid",
    [{"box": {"size": (1.0, 0.6, 0.4)}}, {"capsule": {"radius": 0.2, "length": 0.6}}],
    ids=["box", "capsule"],
)
def test_a_tumbling_solid_gains_no_energy_by_bouncing(
    solid: dict[str, object], restitution: float, friction: float
) -> None:
    """With e = 1 and nothing that rubs it keeps all of it, and in no step does it have more than before.

    To 3e-5 of it a bounce: the gap of a turning corner is followed to the first order of its turn within a substep.
    """
    simulation = Simulation(dt=1 / 240, checked=False)
    material = {"friction": friction, "restitution": restitution}
    simulation.add(collider={"plane": {}}, material=material)
    simulation.add(
        collider=solid,
        body={"mass": 1.0},
        material=material,
        transform={"position": (0.0, 1.5, 0.0), "rotation": (0.3, 0.2, 0.5, 0.787400787401181)},
        motion={"angular": (1.0, 2.0, 3.0)},
    )
    simulation.step()
    first = before = total_energy(simulation.world)
    bounces = 0
    for _ in range(720):
        simulation.step()
        bounces += simulation.world.count(Impact)
        after = total_energy(simulation.world)
        assert after - before <= 3e-5 * first
        before = after
    assert bounces >= 4
    if friction == 0.0:
        assert before == pytest.approx(first, rel=3e-5 * bounces)
