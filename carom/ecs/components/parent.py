"""Parent: whom an entity is carried by."""

from carom.ecs.column import Floats, Integers, column
from carom.ecs.component import Component


class Parent(Component):
    """The entity that carries this one, and this one's pose in its frame; its Transform follows from both."""

    entity: Integers = column(unit="1", doc="who carries it", holds="entities")
    position: Floats = column(3, unit="m", doc="position of the origin in the frame of the parent")
    rotation: Floats = column(4, unit="1", doc="unit quaternion xyzw, body to parent", default=(0.0, 0.0, 0.0, 1.0))
