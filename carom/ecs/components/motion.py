"""Motion: how an entity moves."""

from carom.ecs.column import Booleans, Floats, column
from carom.ecs.component import Component


class Motion(Component):
    """Velocity of the centre of mass, world frame, the accelerations the last substep felt, and whether it sleeps."""

    linear: Floats = column(3, unit="m/s", doc="velocity of the centre of mass")
    angular: Floats = column(3, unit="rad/s", doc="angular velocity")
    linear_acceleration: Floats = column(3, unit="m/s2", doc="acceleration by forces in the last substep")
    angular_acceleration: Floats = column(3, unit="rad/s2", doc="angular acceleration by torques in the last substep")
    still: Floats = column(unit="s", doc="for how long it has been slower than what may sleep; below 0, is to wake")
    asleep: Booleans = column(unit="1", doc="left alone until something touches or changes it", dtype="bool")
