"""Hit: two colliders struck each other hard enough to be heard."""

from carom.ecs.column import Floats, Integers, column
from carom.ecs.component import Relation


class Hit(Relation):
    """The impacts of the last step that closed at the world's ``hit_speed`` or faster, in order of time, a and b."""

    kept = True
    time: Floats = column(unit="s", doc="simulated time of the impact, inside the step", role="derived")
    a: Integers = column(unit="1", doc="first collider", role="derived", holds="entities")
    b: Integers = column(unit="1", doc="second collider", role="derived", holds="entities")
    point: Floats = column(3, unit="m", doc="where, world frame", role="derived")
    normal: Floats = column(3, unit="1", doc="unit normal from a to b", role="derived")
    speed: Floats = column(unit="m/s", doc="closing speed along the normal", role="derived")
    impulse: Floats = column(unit="N s", doc="normal impulse", role="derived")
    material_a: Integers = column(
        unit="1", doc="number of a's named material, -1 for none", dtype="int64", role="derived"
    )
    material_b: Integers = column(
        unit="1", doc="number of b's named material, -1 for none", dtype="int64", role="derived"
    )
