"""Visual: what of an entity is seen."""

from carom.ecs.column import Booleans, Floats, Integers, column
from carom.ecs.component import Component
from carom.ecs.components.collider import SHAPE_PARAMETERS


class Visual(Component):
    """A shape to draw at the entity's transform; by default its collider's shape in its material's colour."""

    shape: Integers = column(unit="1", doc="number of the shape in the registry", dtype="int64")
    size: Floats = column(SHAPE_PARAMETERS, unit="m", doc="parameters of the shape in declared order")
    geometry: Integers = column(unit="1", doc="number in the table of meshes, -1 for none", dtype="int64", default=-1)
    position: Floats = column(3, unit="m", doc="position of the shape in the frame of its entity")
    rotation: Floats = column(4, unit="1", doc="unit quaternion xyzw, shape to entity", default=(0.0, 0.0, 0.0, 1.0))
    color: Floats = column(
        4, unit="1", doc="colour, red green blue alpha in 0..1", default=(0.8, 0.8, 0.8, 1.0), least=0.0, most=1.0
    )
    visible: Booleans = column(unit="1", doc="drawn at all", dtype="bool", default=True)
