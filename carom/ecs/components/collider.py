"""Collider: the shape by which an entity touches others."""

from carom.ecs.column import Booleans, Floats, Integers, column
from carom.ecs.component import Component

SHAPE_PARAMETERS = 4


class Collider(Component):
    """A shape. Colliders are entities: one that is carried is part of the nearest body above it, if there is one."""

    shape: Integers = column(unit="1", doc="number of the shape in the registry", dtype="int64")
    size: Floats = column(SHAPE_PARAMETERS, unit="m", doc="parameters of the shape in declared order")
    geometry: Integers = column(unit="1", doc="number in the table of meshes, -1 for none", dtype="int64", default=-1)
    position: Floats = column(3, unit="m", doc="position of the shape in the frame of its entity")
    rotation: Floats = column(4, unit="1", doc="unit quaternion xyzw, shape to entity", default=(0.0, 0.0, 0.0, 1.0))
    bound_center: Floats = column(3, unit="m", doc="centre of the bounds in the frame of the entity")
    bound_half: Floats = column(3, unit="m", doc="half extents of the bounds in the frame of the entity")
    bound_radius: Floats = column(unit="m", doc="radius by which the bounds are widened")
    layer: Integers = column(unit="1", doc="bit of the layer it is on, 0 for none", dtype="int64", default=1)
    mask: Integers = column(unit="1", doc="bits of the layers it collides with", dtype="int64", default=-1)
    sensor: Booleans = column(unit="1", doc="reports who enters, touches nothing", dtype="bool")
    surface_velocity: Floats = column(
        3, unit="m/s", doc="velocity of the surface like that of a belt, frame of the shape"
    )
    enter_layer: Integers = column(
        unit="1", doc="sensor: layer bit given to who enters; -1 keeps", dtype="int64", default=-1
    )
    enter_mask: Integers = column(unit="1", doc="sensor: mask given to who enters", dtype="int64", default=-1)


class ColliderPose(Component):
    """Where a collider's shape is, and the box around all it can reach within the step."""

    position: Floats = column(3, unit="m", doc="position of the shape in the world", role="derived")
    rotation: Floats = column(4, unit="1", doc="unit quaternion xyzw, shape to world", role="derived")
    lower: Floats = column(3, unit="m", doc="lower corner of the bounds", role="derived")
    upper: Floats = column(3, unit="m", doc="upper corner of the bounds", role="derived")
    body_row: Integers = column(unit="1", doc="row of the body, -1 for static", role="derived", holds="rows")
    turning: Floats = column(unit="m", doc="how far turning may take a point of it within the step", role="derived")
    moved: Booleans = column(unit="1", doc="not where it was when last placed", dtype="bool", role="derived")
