"""Scenes of joints that every engine is given alike: chains that swing, and a net that falls from one edge."""

from __future__ import annotations

from math import pi

import numpy as np

from carom.ecs.spatial import quaternion
from carom.tools.bench.contact_scenes import Joints, Scene, at_rest

LINKS, RADIUS, LENGTH, HIGH = 32, 0.05, 0.4, 20.0  # m: of a capsule, caps included, and where chains hang
KNOTS, PITCH, KNOT, HOLDS = 100, 1.0, 0.4, 4  # along either edge of a net; m; which of an edge are held


def chains(count: int) -> Scene:
    """Return straight chains a metre apart, 45 degrees off vertical, their tops held by the world."""
    chain, link = np.divmod(np.arange(count * LINKS), LINKS)
    turn = quaternion.from_axis_angle((1.0, 0.0, 0.0), -0.25 * pi)  # local y to 45 degrees below level
    down = quaternion.rotate(turn, np.array((0.0, 1.0, 0.0)))
    top = np.stack([chain, np.zeros(len(chain)), np.full(len(chain), HIGH)], axis=1) + LENGTH * link[:, None] * down
    scene = at_rest(300, top + 0.5 * LENGTH * down, (RADIUS, 0.5 * LENGTH, RADIUS), ball=True)
    scene.rotation[:] = turn
    k = np.arange(len(link))
    scene.joints = Joints(np.where(link > 0, k - 1, -1), k, top)
    return scene


def net() -> Scene:
    """Return a level square net of balls, each joined to its neighbours halfway, every fourth of one edge held."""
    k = np.arange(KNOTS * KNOTS).reshape(KNOTS, KNOTS)
    place = np.stack([*np.divmod(k.ravel(), KNOTS), np.zeros(k.size)], axis=1) * PITCH
    scene = at_rest(300, place, KNOT, ball=True)
    a = np.concatenate([k[:-1].ravel(), k[:, :-1].ravel()])
    b = np.concatenate([k[1:].ravel(), k[:, 1:].ravel()])
    held = k[0, ::HOLDS]
    middle = 0.5 * (place[a] + place[b])
    scene.joints = Joints(
        np.concatenate([np.full(len(held), -1), a]), np.concatenate([held, b]), np.concatenate([place[held], middle])
    )
    return scene
