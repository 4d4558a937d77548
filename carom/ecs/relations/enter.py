"""Enter: something came into a sensor."""

from carom.ecs.column import Floats, Integers, column
from carom.ecs.component import Relation


class Enter(Relation):
    """Who entered which sensor in the last step, in order of sensor and entity row."""

    kept = True
    time: Floats = column(unit="s", doc="simulated time at the start of the step that saw it", role="derived")
    sensor: Integers = column(unit="1", doc="the sensor", role="derived", holds="entities")
    entity: Integers = column(unit="1", doc="who entered", role="derived", holds="entities")


class Inside(Relation):
    """Who is inside which sensor, so that entering is told once."""

    kept = True
    sensor: Integers = column(unit="1", doc="the sensor", holds="entities")
    entity: Integers = column(unit="1", doc="who is inside", holds="entities")
