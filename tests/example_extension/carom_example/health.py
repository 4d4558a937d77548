"""Health: how much more an entity bears."""

from carom.ecs import Component, column
from carom.ecs.column import Floats, Integers


class Health(Component):
    """What blows wear down."""

    points: Integers = column(unit="1", doc="blows it still bears", dtype="int32", default=1)
    toughness: Floats = column(unit="N s", doc="impulse up to which a blow does nothing")
    guardian: Integers = column(unit="1", doc="who takes its blows, if anyone", holds="entities")
    armor: Floats = column(3, unit="m", doc="thickness of its plates along x, y and z", default=(0.01, 0.01, 0.01))
