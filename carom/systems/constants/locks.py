"""Locked axes: what of a mass and of its moments is left."""

# Part of the inverse moments about all axes, and of how fast two bodies yield along all ways of a joint, or about them.
# One that is less is rounding, about an axis that the body cannot turn about anyway; locking it changes nothing.
# Larger: the heaviest axis of a needle counts as none. Smaller: joints in two dimensions fly apart.
HELD = 1e-12

# Part of the angular velocity to which that of a body with one locked axis is solved, and most steps of the iteration,
# which gains the angle turned in half a substep each; 8 are usual.
HELD_TURN, HELD_TURNS = 1e-15, 50

# Part of the inverse masses of two bodies. Where locks leave less of it along a normal, no impulse parts them: on a
# rail within a milliradian of the plane of contact, a normal that is off by rounding would ask for any impulse. Larger:
# bodies on rails pass through what they graze. Smaller: overlap hurls bodies along their rails.
IMMOVABLE = 1e-6

# Determinant of what yields at a point over the cube of its trace, from which the point cannot move in all directions,
# whatever locked axes are there. Larger: friction of needles is solved along one direction. Smaller than rounding: what
# no impulse can stop asks for any.
SINGULAR = 1e-13
