"""Force: what the forces of one substep add up to."""

from carom.ecs.column import Floats, column
from carom.ecs.component import Component


class Force(Component):
    """The sum over all forces of a substep; drag is a rate, applied exponentially so that it never overshoots."""

    force: Floats = column(3, unit="N", doc="sum of forces, world frame", role="derived")
    torque: Floats = column(3, unit="N m", doc="sum of torques about the centre of mass, world frame", role="derived")
    drag: Floats = column(unit="kg/s", doc="sum of drag coefficients: the force is -drag v", role="derived")
    drag_flow: Floats = column(3, unit="N", doc="sum of drag coefficients times velocity of the medium", role="derived")
    angular_drag: Floats = column(unit="1/s", doc="rate at which angular velocity decays", role="derived")
    medium: Floats = column(3, unit="m/s", doc="velocity of the medium around the body", role="derived")
