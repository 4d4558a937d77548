"""Enter, Exit and Inside: what sensors tell."""

from carom.ecs.column import Floats, Integers, column
from carom.ecs.component import Relation


class Enter(Relation):
    """Who entered which sensor in the last step, in order of time, sensor and entity."""

    kept = True
    time: Floats = column(unit="s", doc="simulated time at which it came in, inside the step", role="derived")
    sensor: Integers = column(unit="1", doc="the sensor", role="derived", holds="entities")
    entity: Integers = column(unit="1", doc="who entered", role="derived", holds="entities")


class Exit(Relation):
    """Who left which sensor in the last step, in order of time, sensor and entity; either may be gone for good."""

    kept = True
    time: Floats = column(unit="s", doc="simulated time at which it went out, inside the step", role="derived")
    sensor: Integers = column(unit="1", doc="the sensor", role="derived", holds="entities")
    entity: Integers = column(unit="1", doc="who left", role="derived", holds="entities")


class Inside(Relation):
    """Who is inside which sensor, in order of sensor and entity: those that stay are in no other table."""

    kept = True
    sensor: Integers = column(unit="1", doc="the sensor", holds="entities")
    entity: Integers = column(unit="1", doc="who is inside", holds="entities")
    since: Floats = column(unit="s", doc="simulated time at which it came in")
