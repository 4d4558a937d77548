"""Hit: two colliders struck each other hard enough to be heard."""

from carom.ecs.column import Integers, column
from carom.ecs.relations.impact import Impact


class Hit(Impact):
    """The impacts of the last step that closed at the world's ``hit_speed`` or faster, in order of time, a and b."""

    material_a: Integers = column(
        unit="1", doc="number of a's named material, -1 for none", dtype="int64", role="derived"
    )
    material_b: Integers = column(
        unit="1", doc="number of b's named material, -1 for none", dtype="int64", role="derived"
    )
