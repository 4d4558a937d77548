"""Joint gaps: how well joints hold, told from poses alone, so that every engine is measured alike."""

from __future__ import annotations

import numpy as np

from carom.ecs.column import Floats, Integers
from carom.ecs.spatial import quaternion
from carom.tools.bench.contact_scenes import Joints, Scene


def anchors(scene: Scene, joints: Joints) -> tuple[Floats, Floats]:
    """Return where joints are, as seen by a and by b (m, 3), m; the world sees them where they are."""
    on_a = _seen(scene.position, scene.rotation, joints.a, joints.at)
    return on_a, _seen(scene.position, scene.rotation, joints.b, joints.at)


def gaps(scene: Scene, joints: Joints, position: Floats, rotation: Floats) -> Floats:
    """Return by how much (m,), m, the two anchors of each joint are apart."""
    on_a, on_b = anchors(scene, joints)
    of_a, of_b = _placed(position, rotation, joints.a, on_a), _placed(position, rotation, joints.b, on_b)
    return np.asarray(np.linalg.norm(of_b - of_a, axis=1))


def _seen(position: Floats, rotation: Floats, body: Integers, point: Floats) -> Floats:
    local = quaternion.rotate(quaternion.conjugate(rotation[body]), point - position[body])
    return np.asarray(np.where(body[:, None] < 0, point, local))


def _placed(position: Floats, rotation: Floats, body: Integers, local: Floats) -> Floats:
    point = position[body] + quaternion.rotate(rotation[body], local)
    return np.asarray(np.where(body[:, None] < 0, local, point))
