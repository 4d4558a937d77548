"""RigidBody: mass and its distribution."""

from enum import IntEnum

from carom.ecs.column import Booleans, Floats, Integers, column
from carom.ecs.component import Component


class BodyType(IntEnum):
    """Dynamic bodies obey forces; kinematic ones keep the velocity they are given and push without being pushed."""

    DYNAMIC = 0
    KINEMATIC = 1


class RigidBody(Component):
    """A body that moves. An entity with a collider and no RigidBody is static."""

    type: Integers = column(unit="1", doc="0 dynamic, 1 kinematic", dtype="int64")
    mass: Floats = column(unit="kg", doc="mass", default=1.0, above=0.0)
    inverse_mass: Floats = column(unit="1/kg", doc="1 / mass, 0 for kinematic bodies", default=1.0)
    inertia: Floats = column(3, unit="kg m2", doc="principal moments about the centre of mass", default=1.0, least=0.0)
    inverse_inertia: Floats = column(3, unit="1/(kg m2)", doc="1 / inertia, 0 where rotation is locked", default=1.0)
    center_of_mass: Floats = column(3, unit="m", doc="centre of mass in the body frame")
    principal_axes: Floats = column(
        4, unit="1", doc="unit quaternion xyzw, principal axes to body frame", default=(0.0, 0.0, 0.0, 1.0)
    )
    freedom: Floats = column(
        6, unit="1", doc="along x, y, z, then about them, world axes: 1 free, 0 locked", default=1.0
    )
    gravity_scale: Floats = column(unit="1", doc="factor on the world's gravity", default=1.0)
    linear_damping: Floats = column(unit="1/s", doc="rate at which velocity decays", least=0.0)
    angular_damping: Floats = column(unit="1/s", doc="rate at which angular velocity decays", least=0.0)
    continuous: Booleans = column(
        unit="1",
        doc="however fast, passes through no moving body either",
        dtype="bool",
    )
    sleeps: Booleans = column(unit="1", doc="may fall asleep at rest", dtype="bool", default=True)
