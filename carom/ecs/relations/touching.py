"""ContactBegin, ContactEnd and Touching: who touches whom."""

from carom.ecs.column import Floats, Integers, column
from carom.ecs.component import Relation


class Touching(Relation):
    """The pairs of colliders that touch, in order of their rows: those since before the last step have stayed so.

    A pair touches in a step when it was pressed in it: one of its points has an impulse, at rest or by an impact. It
    does so too when it overlaps at the end of the step, and, once it touches, until it is TOUCH (0.1 mm) apart, so that
    what rests does not begin and end by trembling. To bounce is to touch for one step.
    """

    kept = True
    a: Integers = column(unit="1", doc="first collider, that of the lower row", holds="entities")
    b: Integers = column(unit="1", doc="second collider", holds="entities")
    since: Floats = column(unit="s", doc="simulated time at which it began")


class ContactBegin(Relation):
    """The pairs that touch since the last step, in order of time, a and b."""

    kept = True
    time: Floats = column(unit="s", doc="time of the first impact, of none the end of the step", role="derived")
    a: Integers = column(unit="1", doc="first collider, that of the lower row", role="derived", holds="entities")
    b: Integers = column(unit="1", doc="second collider", role="derived", holds="entities")


class ContactEnd(Relation):
    """The pairs that touch no longer, in order of time, a and b; either may be gone for good."""

    kept = True
    time: Floats = column(unit="s", doc="start of the first step in which they do not", role="derived")
    a: Integers = column(unit="1", doc="first collider, that of the lower row then", role="derived", holds="entities")
    b: Integers = column(unit="1", doc="second collider", role="derived", holds="entities")
