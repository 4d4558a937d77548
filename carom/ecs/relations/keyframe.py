"""Keyframe: where a body is at a time."""

from carom.ecs.column import Floats, column
from carom.ecs.component import Relation


class Keyframe(Relation):
    """Poses at times; a `Path` is a run of them, between which a body goes straight and turns evenly."""

    at: Floats = column(unit="s", doc="simulated time")
    position: Floats = column(3, unit="m", doc="position of the origin in the world frame")
    rotation: Floats = column(4, unit="1", doc="unit quaternion xyzw, body to world", default=(0.0, 0.0, 0.0, 1.0))
