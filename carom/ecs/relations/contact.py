"""Contact: where two colliders touch or are about to."""

from carom.ecs.column import Booleans, Floats, Integers, column
from carom.ecs.component import Relation


class Contact(Relation):
    """One row per contact point, sorted by (a, b, feature), a the lower entity row.

    The normal points from a to b and is unit; depth > 0 is overlap and depth < 0 a gap within the step's reach; the
    point lies midway. Impulses are summed over the step. Rows live from step to step by feature, which keeps the warm
    starts; those of a pair that hardly moves are not found anew but go with their shapes.
    """

    kept = True
    a: Integers = column(unit="1", doc="first collider", holds="entities")
    b: Integers = column(unit="1", doc="second collider", holds="entities")
    feature: Integers = column(unit="1", doc="which point of the pair", dtype="int64")
    normal: Floats = column(3, unit="1", doc="unit normal from a to b, world frame")
    depth: Floats = column(unit="m", doc="overlap, negative for a gap")
    point: Floats = column(3, unit="m", doc="point midway between the surfaces, world frame")
    impulse: Floats = column(unit="N s", doc="normal impulse on b, summed over the step")
    friction_impulse: Floats = column(3, unit="N s", doc="friction impulse on b, world frame, summed over the step")
    warm_normal: Floats = column(unit="N s", doc="normal impulse of the last substep")
    warm_friction: Floats = column(3, unit="N s", doc="friction impulse of the last substep")
    warm_rolling: Floats = column(
        3, unit="N m s", doc="angular impulse of rolling and spinning friction of the last substep"
    )
    seat_a: Floats = column(3, unit="m", doc="point on a where it was found, frame of a")
    seat_b: Floats = column(3, unit="m", doc="point on b where it was found, frame of b")
    lean_a: Floats = column(3, unit="1", doc="normal as it was found, frame of a")
    lean_b: Floats = column(3, unit="1", doc="normal as it was found, frame of b")
    seat_depth: Floats = column(unit="m", doc="overlap with which it was found")
    seat_reach: Floats = column(unit="m", doc="gap up to which points of its pair were found then")
    form: Floats = column(unit="1", doc="what the two shapes were when it was found, as one number")
    by_fcl: Booleans = column(unit="1", doc="answered by FCL, not by a kernel", dtype="bool")
    friction: Floats = column(unit="1", doc="combined friction", role="derived")
    restitution: Floats = column(unit="1", doc="combined restitution", role="derived")
    rolling: Floats = column(unit="m", doc="rolling friction times radius", role="derived")
    spinning: Floats = column(unit="m", doc="spinning friction times radius", role="derived")
    surface: Floats = column(
        3,
        unit="m/s",
        doc="velocity of b's surface against a's beyond that of their bodies, along the contact, world frame",
        role="derived",
    )
    resting: Booleans = column(
        unit="1",
        doc="held together in the last substep, at rest or after a plastic impact",
        dtype="bool",
    )
    strikes: Integers = column(unit="1", doc="impacts in this substep so far", dtype="int64", role="derived")
    plastic: Integers = column(unit="1", doc="those after which the pair kept together", dtype="int64", role="derived")
    grouped: Booleans = column(unit="1", doc="was resting when manifolds were put into groups", dtype="bool")
    row_a: Integers = column(unit="1", doc="row of a", role="derived", holds="rows")
    row_b: Integers = column(unit="1", doc="row of b", role="derived", holds="rows")
    body_a: Integers = column(unit="1", doc="row of the body of a, -1 static", role="derived", holds="rows")
    body_b: Integers = column(unit="1", doc="row of the body of b, -1 static", role="derived", holds="rows")
    offset_a: Floats = column(3, unit="m", doc="point on a from the centre of mass of its body", role="derived")
    offset_b: Floats = column(3, unit="m", doc="point on b from the centre of mass of its body", role="derived")
    share: Floats = column(
        unit="1", doc="how much the point goes with b: 0 a corner of a, 1 a corner of b, 0.5 neither", role="derived"
    )
    kind: Integers = column(
        unit="1", doc="exact impacts: how to read extent; -1 for others", dtype="int64", role="derived"
    )
    ball: Integers = column(unit="1", doc="exact impacts: row of the ball's body", role="derived", holds="rows")
    other: Integers = column(
        unit="1", doc="exact impacts: row of the other body, -1 static", role="derived", holds="rows"
    )
    sign: Floats = column(unit="1", doc="exact impacts: 1 where the ball is a, -1 where it is b", role="derived")
    radius: Floats = column(unit="m", doc="exact impacts: radius of the ball", role="derived")
    extent: Floats = column(3, unit="m", doc="exact impacts: radius, half edges or normal of the other", role="derived")
    other_position: Floats = column(3, unit="m", doc="exact impacts: where a static other is", role="derived")
    other_rotation: Floats = column(4, unit="1", doc="exact impacts: how a static other is turned", role="derived")
