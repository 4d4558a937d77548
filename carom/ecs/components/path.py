"""Path: the keyframes a kinematic body goes along."""

from enum import IntEnum

from carom.ecs.column import Integers, column
from carom.ecs.component import Component


class Repeat(IntEnum):
    """What a body does after its last keyframe: stay there, begin anew, or go back and forth."""

    ONCE = 0
    LOOP = 1
    PING_PONG = 2


class Path(Component):
    """Which keyframes a kinematic body goes along, a run of rows of `Keyframe`; bodies may share them."""

    first: Integers = column(unit="1", doc="row of its first keyframe", dtype="int64")
    count: Integers = column(unit="1", doc="how many there are", dtype="int64")
    repeat: Integers = column(unit="1", doc="0 once, 1 loop, 2 there and back", dtype="int64")
