"""Impact: two colliders struck each other."""

from carom.ecs.column import Floats, Integers, column
from carom.ecs.component import Relation


class Impact(Relation):
    """The impacts of the last step, in order of time."""

    kept = True
    time: Floats = column(unit="s", doc="simulated time of the impact, inside the step", role="derived")
    a: Integers = column(unit="1", doc="first collider", role="derived", holds="entities")
    b: Integers = column(unit="1", doc="second collider", role="derived", holds="entities")
    point: Floats = column(3, unit="m", doc="where, world frame", role="derived")
    normal: Floats = column(3, unit="1", doc="unit normal from a to b", role="derived")
    speed: Floats = column(unit="m/s", doc="closing speed along the normal", role="derived")
    impulse: Floats = column(unit="N s", doc="normal impulse", role="derived")
    work: Floats = column(
        unit="J",
        doc="energy that the bodies gained, friction included; below 0: lost; 0 for who is on a joint",
        role="derived",
    )
    friction_impulse: Floats = column(3, unit="N s", doc="friction impulse on b, world frame", role="derived")
