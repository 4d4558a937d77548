"""Emitter: a source of particles."""

import math
from enum import IntEnum

from carom.ecs.column import Floats, Integers, column
from carom.ecs.component import Component


class Source(IntEnum):
    """Where particles are born: at a point, or anywhere in a sphere, a box or a disc across the direction."""

    POINT = 0
    SPHERE = 1
    BOX = 2
    DISC = 3


class Collide(IntEnum):
    """What particles bounce off: nothing, planes, or the surface of any collider."""

    NONE = 0
    PLANES = 1
    ALL = 2


class Drawn(IntEnum):
    """What particles are drawn as: points of a few pixels, discs that face the camera, or solids."""

    POINTS = 0
    SPRITES = 1
    SPHERES = 2
    BOXES = 3


class Within(IntEnum):
    """Where particles may be: anywhere, or in a part of space beyond which they die."""

    ANYWHERE = 0
    BOX = 1
    SPHERE = 2


class Emitter(Component):
    """A source of particles at the origin of its entity, which may be a body or be carried by one.

    Pairs are a least and a greatest value, evenly distributed between; what runs over life does so from ``size`` and
    ``color`` to those at the end. Where it is (and how fast) at the start of a step is kept for births within it.
    """

    rate: Floats = column(unit="1/s", doc="particles born in a second")
    burst: Integers = column(unit="1", doc="particles born at once", dtype="int64")
    every: Floats = column(unit="s", doc="time between bursts, 0 for a single one")
    start: Floats = column(unit="s", doc="simulated time at which it begins, with a burst")
    duration: Floats = column(unit="s", doc="for how long it emits", default=math.inf)
    source: Integers = column(unit="1", doc="0 point, 1 sphere, 2 box, 3 disc", dtype="int64")
    extent: Floats = column(3, unit="m", doc="radius, or full edges of the box")
    direction: Floats = column(3, unit="1", doc="mean direction, frame of the entity", default=(0.0, 1.0, 0.0))
    cone: Floats = column(unit="rad", doc="greatest angle from that direction")
    speed: Floats = column(2, unit="m/s", doc="least and greatest speed against the emitter")
    life: Floats = column(2, unit="s", doc="shortest and longest life", default=1.0)
    size: Floats = column(unit="m", doc="diameter at birth", default=0.05)
    end_size: Floats = column(unit="m", doc="diameter at the end of life", default=0.05)
    color: Floats = column(4, unit="1", doc="colour at birth, red green blue alpha in 0..1", default=1.0)
    end_color: Floats = column(4, unit="1", doc="colour at the end of life", default=1.0)
    inherit: Floats = column(
        unit="1", doc="share of the emitter's own velocity that particles are born with", default=1.0
    )
    mass: Floats = column(unit="kg", doc="mass of a particle", default=0.001)
    gravity_scale: Floats = column(unit="1", doc="factor on the world's gravity", default=1.0)
    most: Integers = column(unit="1", doc="particles alive at most, the oldest die first; 0: any number", dtype="int64")
    collide: Integers = column(
        unit="1", doc="they bounce off 0 nothing, 1 planes, 2 colliders", dtype="int64", default=1
    )
    within: Integers = column(unit="1", doc="they may be 0 anywhere, 1 in a box, 2 in a sphere", dtype="int64")
    within_position: Floats = column(3, unit="m", doc="middle of that part of space, world frame")
    within_extent: Floats = column(3, unit="m", doc="its full edges, or its radius")
    drawn: Integers = column(unit="1", doc="0 points, 1 sprites, 2 spheres, 3 boxes", dtype="int64", default=1)
    phase: Floats = column(unit="1", doc="share of the time to the next birth that is over", default=0.5)
    born: Integers = column(unit="1", doc="particles born so far", dtype="int64")
    start_position: Floats = column(3, unit="m", doc="where it was at the start of the step", role="derived")
    start_rotation: Floats = column(4, unit="1", doc="how it was turned then", role="derived")
    start_linear: Floats = column(3, unit="m/s", doc="velocity of its origin then", role="derived")
    start_angular: Floats = column(3, unit="rad/s", doc="angular velocity then", role="derived")
