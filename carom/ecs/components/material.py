"""Material: one record for how a surface acts and looks."""

from enum import IntEnum

from carom.ecs.column import Floats, Integers, column
from carom.ecs.component import Component


class Combine(IntEnum):
    """How the values of two materials become one; of two chosen rules the later in this list wins.

    ``DEFAULT`` stands for the quantity's own rule (friction: square root of the product, restitution: max) and yields
    to any chosen one.
    """

    DEFAULT = 0
    AVERAGE = 1
    SQRT = 2
    MIN = 3
    MULTIPLY = 4
    MAX = 5


class Material(Component):
    """Surface and substance of an entity.

    Rolling and spinning friction are of what is round, with the smaller radius of two: that of balls, capsules,
    cylinders and cones, of ellipsoids and hulls the mean of their half extents. Boxes, planes and meshes have none.
    """

    friction: Floats = column(unit="1", doc="Coulomb friction", default=0.5, least=0.0)
    restitution: Floats = column(unit="1", doc="parting over closing speed of an impact", least=0.0, most=1.0)
    density: Floats = column(unit="kg/m3", doc="density, used where a body states no mass", default=1000.0, above=0.0)
    rolling_friction: Floats = column(unit="1", doc="torque against rolling over normal force times radius", least=0.0)
    spinning_friction: Floats = column(
        unit="1", doc="torque against spinning over normal force times radius", least=0.0
    )
    friction_combine: Integers = column(unit="1", doc="rule for friction of a pair", dtype="int64")
    restitution_combine: Integers = column(unit="1", doc="rule for restitution of a pair", dtype="int64")
    number: Integers = column(
        unit="1", doc="number among the named materials, -1 for one without a name", dtype="int64", default=-1
    )
    color: Floats = column(
        4, unit="1", doc="colour, red green blue alpha in 0..1", default=(0.8, 0.8, 0.8, 1.0), least=0.0, most=1.0
    )
