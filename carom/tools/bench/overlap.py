"""Overlap: how well a scene was stepped, told from poses alone, so that every engine is measured alike."""

from __future__ import annotations

import numpy as np

from carom.ecs.column import Floats
from carom.ecs.spatial import quaternion
from carom.tools.bench.contact_scenes import Scene, height

LEAST = 1e-5  # m: what touches by less is not told from what is apart
PARALLEL = 1e-3  # sine below which two edges give no axis of their own
OUTSIDE, BELOW = 0.25, 0.5  # m: how far beyond a wall or below the land a centre is lost


def lost(scene: Scene, position: Floats) -> int:
    """Return how many bodies went through what should hold them, or are nowhere."""
    with np.errstate(invalid="ignore"):
        there = np.isfinite(position).all(axis=1)
        for distance in _from_walls(scene, position):
            there &= distance > -OUTSIDE
        if scene.land is not None:
            there &= position[:, 2] > height(position[:, 0], position[:, 1]) - BELOW
    return int(np.count_nonzero(~there))


def mean_overlap(scene: Scene, position: Floats, rotation: Floats) -> float:
    """Return the mean depth, m, of all pairs that overlap, walls included; every body is of one kind."""
    from scipy.spatial import cKDTree

    turn = quaternion.matrix(rotation)
    reach = scene.half[:, 0] if scene.ball[0] else np.linalg.norm(scene.half, axis=1)
    pairs = cKDTree(position).query_pairs(2.0 * float(reach.max()), output_type="ndarray")
    apart = np.linalg.norm(position[pairs[:, 1]] - position[pairs[:, 0]], axis=1)
    near = apart < reach[pairs].sum(axis=1)
    if scene.ball[0]:
        depths = [(reach[pairs].sum(axis=1) - apart)[near]]
    else:
        depths = [box_overlap(position[pairs[near]], turn[pairs[near]], scene.half[pairs[near]])]
    for distance, normal in zip(_from_walls(scene, position), _normals(scene), strict=True):
        across = reach if scene.ball[0] else (np.abs(np.einsum("nij,i->nj", turn, normal)) * scene.half).sum(axis=1)
        depths.append(across - distance)
    depth = np.concatenate(depths)
    depth = depth[depth > LEAST]
    return float(depth.mean()) if len(depth) else 0.0


def box_overlap(position: Floats, turn: Floats, half: Floats) -> Floats:
    """Return by how much pairs of boxes (n, 2, ...) overlap along the best of 15 axes, negative where apart."""
    one, other = turn[:, 0], turn[:, 1]
    axes = np.cross(one[:, :, :, None], other[:, :, None, :], axisa=1, axisb=1, axisc=1).reshape(-1, 3, 9)
    axes = np.concatenate([one, other, axes], axis=2)
    length = np.linalg.norm(axes, axis=1)
    with np.errstate(divide="ignore", invalid="ignore"):
        axes = axes / length[:, None, :]
        extent = sum(
            np.einsum("nai,na->ni", np.abs(np.einsum("nka,nki->nai", turn[:, s], axes)), half[:, s]) for s in (0, 1)
        )
        between = np.abs(np.einsum("nk,nki->ni", position[:, 1] - position[:, 0], axes))
        depth: Floats = np.where(length > PARALLEL, extent - between, np.inf).min(axis=1)
    return depth


def _normals(scene: Scene) -> Floats:
    return np.array([_inner(center, half)[0] for center, half in scene.walls]).reshape(-1, 3)


def _from_walls(scene: Scene, position: Floats) -> list[Floats]:
    """Return for each wall how far every centre is from its inner face."""
    found = (_inner(center, half) for center, half in scene.walls)
    return [position @ normal - offset for normal, offset in found]


def _inner(center: Floats, half: Floats) -> tuple[Floats, float]:
    """Return the face of a wall that looks at the scene: the large one, upwards or towards the middle."""
    thin = int(np.argmin(half))
    normal = np.zeros(3)
    normal[thin] = 1.0 if center[thin] < 0.0 else -1.0
    return normal, float(normal @ center + half[thin])
