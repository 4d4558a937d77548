"""ExternalForce: a push from outside the step."""

from carom.ecs.column import Floats, column
from carom.ecs.component import Component


class ExternalForce(Component):
    """Force and torque on a body, set from outside, held over the substeps of one step and then cleared."""

    force: Floats = column(3, unit="N", doc="force at the centre of mass, world frame", role="input")
    torque: Floats = column(3, unit="N m", doc="torque about the centre of mass, world frame", role="input")
