"""Joints: chains and a net against other engines, in turns, with how well the joints held beside what they took."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import partial
from math import inf

import numpy as np

from carom.ecs import RigidBody
from carom.ecs.column import Floats
from carom.ecs.spatial import quaternion
from carom.tools.bench import joint_scenes as scenes
from carom.tools.bench.contact_scenes import Joints, Scene
from carom.tools.bench.engines import GRAVITY, Carom, Engine
from carom.tools.bench.joint_gaps import gaps
from carom.tools.bench.measure import Figure
from carom.tools.bench.race import OURS, race

PEERS = ("rapier3d",)


@dataclass(frozen=True)
class Row:
    """A scene and its bounds: CPU time by rapier3d's, the worst and the mean gap of joints, drift of energy."""

    scene: Callable[[], Scene]
    ratio: float = inf
    worst: float = inf  # m
    mean: float = inf  # m
    drift: float = inf  # of the potential energy between where the bodies begin and the highest joint


ROWS = {
    "chains": Row(partial(scenes.chains, 64), 1.0, worst=0.008, mean=0.003, drift=0.02),
    "net": Row(scenes.net),
}


def figures() -> Iterator[Figure]:
    """Yield every part's figures."""
    for part in PARTS.values():
        yield from part()


def compare(name: str) -> Iterator[Figure]:
    """Step a scene by all engines that are installed, and tell what each took and how well the joints held."""
    row, scene = ROWS[name], ROWS[name].scene()
    assert scene.joints is not None
    found = yield from race(name, scene, PEERS, row.ratio)
    weight = weights(found[OURS])
    for engine, stood in found.items():
        yield from quality(f"{name}, {engine}", row, scene, scene.joints, stood, weight, bounded=engine == OURS)


def quality(
    name: str, row: Row, scene: Scene, joints: Joints, engine: Engine, weight: tuple[Floats, Floats], *, bounded: bool
) -> Iterator[Figure]:
    """Yield how far joints are apart and, where it is bounded, how much energy has come or gone; ours is bounded."""
    position, rotation = engine.poses()
    apart = gaps(scene, joints, position, rotation)
    told = [
        ("worst gap", "mm", 1e3 * float(apart.max()), 1e3 * row.worst),
        ("mean gap", "mm", 1e3 * float(apart.mean()), 1e3 * row.mean),
    ]
    if row.drift < inf:
        share = gained(scene, position, rotation, *engine.velocities(), *weight) / fall(scene, joints, weight[0])
        told.append(("energy gained or lost", "%", 100.0 * abs(share), 100.0 * row.drift))
    for what, unit, value, bound in told:
        yield Figure(f"{name}, {what}", unit, value, value, bound if bounded else inf, "value")


def weights(engine: Engine) -> tuple[Floats, Floats]:
    """Return the masses (n,), kg, and principal moments of inertia (n, 3), kg m2, that every engine's bodies have."""
    assert isinstance(engine, Carom)
    body = engine.simulation.world[RigidBody]
    return np.array(body.mass[engine.rows]), np.array(body.inertia[engine.rows])


def gained(
    scene: Scene, position: Floats, rotation: Floats, linear: Floats, angular: Floats, mass: Floats, inertia: Floats
) -> float:
    """Return how much more energy, J, bodies have than at rest where the scene begins."""
    turning = inertia * quaternion.rotate(quaternion.conjugate(rotation), angular) ** 2
    moving = 0.5 * (mass @ (linear**2).sum(axis=1) + turning.sum())
    return float(moving + GRAVITY * mass @ (position - scene.position)[:, 2])


def fall(scene: Scene, joints: Joints, mass: Floats) -> float:
    """Return how much less potential energy, J, bodies begin with than at the height of the highest joint."""
    return float(GRAVITY * mass @ (joints.at[:, 2].max() - scene.position[:, 2]))


PARTS: dict[str, Callable[[], Iterator[Figure]]] = {name: partial(compare, name) for name in ROWS}
