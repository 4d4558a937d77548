"""Flight: a body's motion within one substep."""

from carom.ecs.column import Booleans, Floats, column
from carom.ecs.component import Component


class Flight(Component):
    """The arc of a body over a substep: from ``center`` at ``time``, with Motion's velocity and these accelerations."""

    kept = True
    center: Floats = column(3, unit="m", doc="centre of mass at the body's time, world frame", role="derived")
    time: Floats = column(unit="s", doc="how far into the substep the body is", role="derived")
    acceleration: Floats = column(3, unit="m/s2", doc="acceleration along the arc, 0 where in contact", role="derived")
    angular_acceleration: Floats = column(3, unit="rad/s2", doc="likewise of rotation", role="derived")
    felt: Floats = column(3, unit="m/s2", doc="acceleration by forces, in contact or not", role="derived")
    decay: Floats = column(unit="1", doc="part of the velocity drag leaves at the end of the substep", role="derived")
    angular_decay: Floats = column(unit="1", doc="likewise of angular velocity", role="derived")
    flow: Floats = column(3, unit="m/s", doc="velocity towards which drag pulls", role="derived")
    touching: Booleans = column(
        unit="1", doc="in resting contact, so stepped semi-implicitly", dtype="bool", role="derived"
    )
    held: Booleans = column(unit="1", doc="held by a joint in this substep", dtype="bool", role="derived")
    start_position: Floats = column(3, unit="m", doc="origin at the start of the substep", role="derived")
    start_rotation: Floats = column(4, unit="1", doc="rotation at the start of the substep", role="derived")
    start_linear: Floats = column(3, unit="m/s", doc="velocity at the start of the substep", role="derived")
    start_angular: Floats = column(3, unit="rad/s", doc="angular velocity at the start of the substep", role="derived")
    start_center: Floats = column(
        3,
        unit="m",
        doc="centre of mass at the start of the substep, or when contacts were detected in it",
        role="derived",
    )
    turned: Floats = column(3, unit="rad", doc="turn since then", role="derived")
    detected_center: Floats = column(3, unit="m", doc="centre of mass when contacts were last detected", role="derived")
    detected_rotation: Floats = column(
        4, unit="1", doc="unit quaternion xyzw, body to world, when contacts were last found", role="derived"
    )
    reach: Floats = column(unit="m", doc="how far from there the detection holds", role="derived")
