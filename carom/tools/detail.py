"""Detail: round things that are small in a picture are drawn with fewer triangles."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from carom.tools.batch import Batch
from carom.tools.cameras import Camera

MOST_OFF = 0.25  # px by which an outline may be off: one of four samples of a pixel


def in_detail(batch: Batch, camera: Camera, height: int) -> list[Batch]:
    """Return a batch by the meshes it is drawn with in pictures ``height`` px high: itself where there is one only."""
    if not batch.coarser:
        return [batch]
    ahead = (batch.poses[:, :3, 3] - camera.position) @ -camera.pose()[:3, 2]
    nearer = np.ones(len(ahead)) if camera.height is not None else ahead / camera.distance
    seen = camera.reach * nearer  # half of what is seen there, m
    pixels = 0.5 * height / np.maximum(seen, camera.planes[0] * camera.reach / camera.distance)  # a metre
    level = np.sum([surface.off * pixels <= MOST_OFF for surface in batch.coarser], axis=0)
    parts = [batch.take(np.nonzero(level == 0)[0])] if level.any() else [batch]
    for number, surface in enumerate(batch.coarser, 1):
        if (level == number).any():
            part = batch.take(np.nonzero(level == number)[0])
            parts.append(replace(part, vertices=surface.vertices, faces=surface.faces))
    return parts
