"""Bodies that fly past each other strike nobody, and who meets does so where the two touch first."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from carom.ecs import Collider, ColliderPose, Motion, RigidBody
from carom.ecs.column import Floats
from carom.ecs.components.flight import Flight
from carom.ecs.relations.impact import Impact
from carom.ecs.spatial import quaternion
from carom.systems.constants import FEW_MEETING
from carom.systems.continuous import fast_of
from carom.systems.detection.answered import Answered
from carom.systems.detection.bounds import reach_within
from carom.systems.detection.broad import overlapping
from carom.systems.kernels.fast_pairs import find_quick
from carom.systems.simulation import Simulation

SHAPES: dict[str, Any] = {
    "box": {"box": {"size": (0.1, 0.1, 0.1)}},
    "plate": {"box": {"size": (0.15, 0.09, 0.02)}},
    "capsule": {"capsule": {"radius": 0.02, "length": 0.1}},
    "hull": {
        "convex": {"points": 0.1 * np.array([[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]])}
    },
}
RADIUS = 0.1  # m; no point of any of them is farther out


def placed(place: Any, random: np.random.Generator) -> dict[str, Any]:
    """Return a place (m), turned anyhow."""
    return {"position": place, "rotation": quaternion.normalise(random.normal(size=4))}


def flight(
    shape: str, speed: float, apart: float, *, seed: int = 0, pairs: int = 1, **body: Any
) -> tuple[Simulation, Floats]:
    """Return pairs of bodies, each in a place of its own, of which one flies by the other, and all their velocities.

    Its way is so far ``apart`` (m) from the middle of the other.
    """
    simulation, random = Simulation(gravity=(0.0, 0.0, 0.0)), np.random.default_rng(seed)
    for k in range(pairs):
        for fast in (0.0, 1.0):
            place = -fast * (RADIUS + speed * random.uniform(0.01, 0.05)), fast * apart, 2.0 * k
            simulation.add(
                collider=SHAPES[shape], transform=placed(place, random), body=body,
                motion={"linear": (fast * speed, 0.0, 0.0), "angular": 5.0 * random.normal(size=3)},
            )  # fmt: skip
    return simulation, simulation.world[Motion].linear[: 2 * pairs].copy()


@pytest.mark.parametrize("speed", [6.0, 20.0, 100.0])
@pytest.mark.parametrize("shape", SHAPES)
@pytest.mark.parametrize(("pairs", "seeds"), [(1, 12), (3 * FEW_MEETING, 1)], ids=["alone", "crowd"])
def test_who_passes_by_strikes_nobody(shape: str, speed: float, pairs: int, seeds: int) -> None:
    """However near, and whether few do or many at once."""
    for seed in range(seeds):
        simulation, begun = flight(shape, speed, 2.0 * RADIUS + 1e-3, seed=seed, pairs=pairs)
        simulation.step(10)
        assert (simulation.world[Motion].linear[: 2 * pairs] == begun).all()


@pytest.mark.parametrize("speed", [6.0, 20.0])
@pytest.mark.parametrize("shape", ["box", "capsule", "hull"])
def test_in_a_crowd_who_meets_is_struck(shape: str, speed: float) -> None:
    """None flies through another, and none is struck but by its own."""
    pairs = 3 * FEW_MEETING
    simulation, begun = flight(shape, speed, 0.02, pairs=pairs)
    simulation.step(10)
    after = simulation.world[Motion].linear[: 2 * pairs]
    assert (np.abs(after - begun).max(axis=1) > 0.1 * speed).all()
    assert after[::2] + after[1::2] == pytest.approx(begun[::2] + begun[1::2], abs=1e-9 * speed)


@pytest.mark.parametrize("speed", [6.0, 20.0, 60.0])
@pytest.mark.parametrize("shape", SHAPES)
def test_a_few_meet_as_those_do_who_are_always_looked_after(shape: str, speed: float) -> None:
    """Their first impact is the same to the last bit: contacts found from afar say another time, point and normal."""
    met = 0
    for seed in range(10):
        firsts = []
        for body in ({}, {"continuous": True}):
            simulation, _ = flight(shape, speed, 0.05, seed=seed, **body)
            while not simulation.world[Impact].count and simulation.frame < 10:
                simulation.step()
            impact = simulation.world[Impact]
            firsts.append(
                [column[:1].tolist() for column in (impact.time, impact.impulse, impact.point, impact.normal)]
            )
        assert firsts[0] == firsts[1]
        met += len(firsts[0][0])
    assert met


@pytest.mark.parametrize("speed", [6.0, 20.0, 60.0, 200.0])
@pytest.mark.parametrize("pairs", [FEW_MEETING - 2, 3 * FEW_MEETING])
def test_there_is_an_end_to_looking_after_them(pairs: int, speed: float) -> None:
    """Where they turn on each other, and where many do; who leaves his reach is detected anew in any substep."""
    simulation, _ = flight("plate", speed, 0.05, pairs=pairs)
    answered = simulation.world[Answered]
    for _ in range(10):
        before = answered.detections
        simulation.step()
        assert answered.detections - before <= FEW_MEETING + simulation.settings.substeps


def test_who_is_fast_does_not_hang_on_how_far_all_have_gone() -> None:
    """A box that turns slowly beside another is not fast where both have flown on since detection."""
    simulation = Simulation(gravity=(0.0, 0.0, 0.0))
    for k in range(2):
        simulation.add(
            collider=SHAPES["box"],
            body={},
            transform={"position": (0.0, 0.2 * k, 0.0)},
            motion={"angular": (0, 0, 1 - k)},
        )
    world, pairs = simulation.world, np.array([[0, 1]])
    with world.faces(None):
        reach_within(world, simulation.settings.dt)
        flight, pose = world[Flight], world[ColliderPose]
        flight.center[:2] = flight.detected_center[:2] + 50.0
        pose.position[:2] += 50.0
        assert not len(fast_of(world, pairs, simulation.settings.dt, flight.center, free=True)[0])
        assert len(fast_of(world, pairs, simulation.settings.dt, flight.detected_center, free=True)[0])


@pytest.mark.parametrize("shape", ["plate", "bullet", "wedge", "arm"])
@pytest.mark.parametrize("seed", [*range(4), *(pytest.param(k, marks=pytest.mark.slow) for k in range(4, 20))])
def test_where_none_may_be_fast_none_are(seed: int, shape: str) -> None:
    """Pairs are gone through where the fastest and the smallest of all might be fast, and there those of quick bodies.

    A wedge is far from the origin of its shape, an arm far from that of its body, about which both turn; bullets fly.
    """
    random, answers, found, far = np.random.default_rng(seed), set(), 0, np.array([8.0, 0.0, 0.0])
    parted = False  # whether some were quick, and others not
    wedge = {"convex": {"points": far + SHAPES["hull"]["convex"]["points"]}}
    form = wedge if shape == "wedge" else SHAPES["plate"]
    off, spin = far if shape == "arm" else 0.0, 0.0 if shape == "bullet" else 10.0
    middle = {} if shape in ("plate", "bullet") else {"center_of_mass": (0.0, 0.0, 0.0)}
    for speed in 10.0 ** np.arange(-4.0, 2.0, 0.25):
        simulation = Simulation(gravity=(0.0, 0.0, 0.0))
        for k in range(12):
            simulation.add(
                collider={**form, "position": off + 0.2 * random.normal(size=3)},
                body=middle | ({"type": "kinematic"} if k % 4 == 0 else {"continuous": k % 4 == 1}),
                transform=placed(0.1 * random.normal(size=3), random) if not middle else {},
                motion={"linear": speed * random.normal(size=3), "angular": spin * speed * random.normal(size=3)},
            )  # fmt: skip
        world, span = simulation.world, simulation.settings.dt
        with world.faces(None):
            reach_within(world, span)
            pairs = overlapping(world)
            center = world[Flight].detected_center
            fast = [pair for free in (False, True) for pair in fast_of(world, pairs, span, center, free=free)[0]]
            collider, pose, motion = world[Collider], world[ColliderPose], world[Motion]
            quick = np.zeros(len(motion.asleep), np.bool_)
            some = find_quick(
                span, world.row_numbers(Collider), collider.position, collider.bound_center, collider.bound_half,
                collider.bound_radius, pose.position, pose.body_row, center, world[RigidBody].inverse_mass,
                motion.linear, motion.angular, quick,
            )  # fmt: skip
        assert some or not len(fast)
        assert all(quick[pose.body_row[pair]].any() for pair in fast)
        answers.add(some)
        parted |= bool(some and not quick[pose.body_row[:12]].all())
        found += len(fast)
    assert found > 0
    assert answers == {False, True}
    assert parted
