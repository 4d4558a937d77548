"""Motion: how an entity moves."""

from carom.ecs.column import Floats, column
from carom.ecs.component import Component


class Motion(Component):
    """Velocity of the centre of mass, world frame, and the accelerations the last substep felt."""

    linear: Floats = column(3, unit="m/s", doc="velocity of the centre of mass")
    angular: Floats = column(3, unit="rad/s", doc="angular velocity")
    linear_acceleration: Floats = column(3, unit="m/s2", doc="acceleration by forces in the last substep")
    angular_acceleration: Floats = column(3, unit="rad/s2", doc="angular acceleration by torques in the last substep")
