"""Spring: a spring and damper that pulls two bodies towards each other, as a force."""

from carom.ecs.column import Floats, Integers, column
from carom.ecs.component import Component


class Spring(Component):
    """A spring between two anchors, and a damper along the line between them.

    Springs are entities. Where ``a`` or ``b`` is -1, it is the world, in whose frame the anchor is then; so it is with
    an entity without a body, in whose frame the anchor stays. The law is exact, and what bodies make of it is up to the
    integrator: see the soft spring of joints for one that is stable at any stiffness.
    """

    a: Integers = column(unit="1", doc="who is pulled, -1 for the world", holds="entities")
    b: Integers = column(unit="1", doc="by whom, -1 for the world", holds="entities")
    anchor_a: Floats = column(3, unit="m", doc="anchor in the frame of a")
    anchor_b: Floats = column(3, unit="m", doc="anchor in the frame of b")
    rest_length: Floats = column(unit="m", doc="length at which it neither pulls nor pushes", least=0.0)
    stiffness: Floats = column(unit="N/m", doc="force by length beyond that", least=0.0)
    damping: Floats = column(unit="N s/m", doc="force by the speed at which it grows longer", least=0.0)
    length: Floats = column(unit="m", doc="distance of the anchors in the last substep", role="derived")
    tension: Floats = column(unit="N", doc="force in the last substep, below 0 where it pushes", role="derived")
