"""Transform: where an entity is."""

from carom.ecs.column import Floats, column
from carom.ecs.component import Component


class Transform(Component):
    """The pose ``world_from_body`` of the authored origin."""

    position: Floats = column(3, unit="m", doc="position of the origin in the world frame")
    rotation: Floats = column(4, unit="1", doc="unit quaternion xyzw, body to world", default=(0.0, 0.0, 0.0, 1.0))
