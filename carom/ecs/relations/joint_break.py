"""JointBreak: a joint was loaded with more than it bears."""

from carom.ecs.column import Floats, Integers, column
from carom.ecs.component import Relation


class JointBreak(Relation):
    """The joints that broke in the last step, in order of their rows; they hold nothing any more."""

    kept = True
    time: Floats = column(unit="s", doc="end of the step", role="derived")
    joint: Integers = column(unit="1", doc="which joint", role="derived", holds="entities")
    a: Integers = column(unit="1", doc="who held, -1 for the world", role="derived", holds="entities")
    b: Integers = column(unit="1", doc="who was held, -1 for the world", role="derived", holds="entities")
    force: Floats = column(unit="N", doc="mean force in the step", role="derived")
    torque: Floats = column(unit="N m", doc="mean torque in the step", role="derived")
