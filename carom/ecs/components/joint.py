"""Joint: what holds two bodies together, and how they may move against each other."""

from math import inf

from carom.ecs.column import Booleans, Floats, Integers, column
from carom.ecs.component import Component

SLOTS = 6  # along x, y, z, then about them
FREE, LOCKED, LIMITED = 0, 1, 2
AXES, LINE = 0, 1  # what a joint measures along: the axes of its frame on a, or the line between the anchors
EULER, SWING_TWIST = 0, 1  # and about


class Joint(Component):
    """Two bodies that move against each other in six ways at most: along the axes of a frame, and about them.

    Joints are entities. The frame of the joint on a stands at the anchor of a; of what b does there, each way may be
    free, locked or limited, driven towards a target, and rubbed. Along a ``LINE`` there is one way, the distance of the
    anchors. Turns are angles about x, then y, then z (intrinsic), or (``SWING_TWIST``) the twist about x and the angle
    between both x axes. Where ``a`` or ``b`` is -1, it is the world, in whose frame the anchor is then.
    """

    a: Integers = column(unit="1", doc="who holds, -1 for the world", holds="entities")
    b: Integers = column(unit="1", doc="who is held, -1 for the world", holds="entities")
    anchor_a: Floats = column(3, unit="m", doc="anchor in the frame of a")
    anchor_b: Floats = column(3, unit="m", doc="anchor in the frame of b")
    frame_a: Floats = column(4, unit="1", doc="unit quaternion xyzw, joint to a", default=(0.0, 0.0, 0.0, 1.0))
    frame_b: Floats = column(4, unit="1", doc="unit quaternion xyzw, joint to b", default=(0.0, 0.0, 0.0, 1.0))
    along: Integers = column(unit="1", doc="measured along: 0 axes, 1 the line of the anchors", dtype="int64")
    about: Integers = column(unit="1", doc="measured about: 0 Euler's angles x y z, 1 twist and swing", dtype="int64")
    mode: Integers = column(SLOTS, unit="1", doc="each way: 0 free, 1 locked, 2 limited", dtype="int64")
    lower: Floats = column(SLOTS, unit="m, rad", doc="least position, and where it is locked")
    upper: Floats = column(SLOTS, unit="m, rad", doc="greatest position")
    restitution: Floats = column(unit="1", doc="with which it bounces off its limits")
    driven: Booleans = column(SLOTS, unit="1", doc="whether it has a spring, damper or motor", dtype="bool")
    stiffness: Floats = column(SLOTS, unit="N/m, N m/rad", doc="of the spring towards the target")
    damping: Floats = column(
        SLOTS, unit="N s/m, N m s/rad", doc="of the damper towards the speed; infinite for a motor that keeps it"
    )
    target: Floats = column(SLOTS, unit="m, rad", doc="position to which the spring pulls")
    speed: Floats = column(SLOTS, unit="m/s, rad/s", doc="speed to which the damper or motor drives")
    most: Floats = column(SLOTS, unit="N, N m", doc="greatest force of spring, damper and motor", default=inf)
    friction: Floats = column(SLOTS, unit="N, N m", doc="greatest force of friction")
    break_force: Floats = column(unit="N", doc="mean force of a step beyond which it breaks", default=inf)
    break_torque: Floats = column(unit="N m", doc="mean torque of a step beyond which it breaks", default=inf)
    collide: Booleans = column(unit="1", doc="whether the two bodies touch each other", dtype="bool")
    impulse: Floats = column(
        SLOTS, unit="N s, N m s", doc="of locks and limits in the last substep; what bounds ask of locks is theirs"
    )
    drive_impulse: Floats = column(SLOTS, unit="N s, N m s", doc="of springs, dampers and motors in the last substep")
    friction_impulse: Floats = column(SLOTS, unit="N s, N m s", doc="of friction in the last substep")
    position: Floats = column(SLOTS, unit="m, rad", doc="where b is against a; angles go on beyond a whole turn")
    velocity: Floats = column(SLOTS, unit="m/s, rad/s", doc="how fast that changes")
    force: Floats = column(
        3, unit="N", doc="mean force on b in the last step, at its anchor, world frame", role="derived"
    )
    torque: Floats = column(3, unit="N m", doc="mean torque on b in the last step, world frame", role="derived")
    effort: Floats = column(
        SLOTS, unit="N, N m", doc="mean force of springs, dampers and motors in the last step", role="derived"
    )
    gap: Floats = column(unit="m", doc="how far locked ways are off", role="derived")
    twist: Floats = column(unit="rad", doc="how far locked turns are off", role="derived")
    limit: Integers = column(
        SLOTS, unit="1", doc="-1 at the lower limit, 1 at the upper", dtype="int64", role="derived"
    )
    margin: Floats = column(
        unit="1", doc="part of what it bears that is left: 1 without load, 0 where it breaks", role="derived"
    )
