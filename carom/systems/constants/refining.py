"""Refining: how what FCL says of two solids is brought to the depth and the normal."""

# m. The overlap or distance of two cores is known to this once the bounds between which FCL's answer is refined are so
# near. Larger: depths are wrong by as much and normals of round bodies by its root; smaller: refining takes longer.
BRACKET = 1e-8

# m, and part of what a pair reaches. FCL is not asked of pairs that are apart by more than they reach and this, found
# by a search that ends once it knows their distance to that part. Smaller than BRACKET: what is as far as it reaches
# might be missed; larger: FCL is asked in vain, as with a larger part; with a smaller one the search takes longer.
SURELY_APART, ROUGHLY = 1e-6, 0.1

# m. A corner that is less above a face of the growing polytope lies in it. Larger: bounds are wrong by as much;
# smaller: rounding folds faces that lie in one plane.
SEEN = 1e-12

# Sine of the angle below which a face of that polytope is a line, which hides nothing.
SLIVER = 1e-9

# m. How far FCL moves two overlapping shapes of others' making apart to see along which direction they part. Larger:
# less of the direction that they overlap along; smaller: FCL's nearest points, good to a micrometre, turn by degrees.
PARTED = 2e-2

# rad. How far the direction leans in which corners are sought, so that two aligned bodies choose the same of those as
# far. Larger: overlaps are short by as much of the size; smaller: rounding chooses for each body by itself.
LEAN = 1e-10

# m. How near the bounds of an overlap or distance are when the search goes on as between round surfaces. Larger: in
# vain more often; smaller: later.
CURVED_FROM = 1e-3

# rad. Step of the differences that give the slope there, and the farthest that it leads. Larger steps see it less
# exactly; smaller ones are rounding. Farther, it is another place of the surface.
CURVED_STEP, CURVED_TURN = 1e-5, 0.2

# Cosine of 11 degrees: faces turned so nearly alike belong to one round place. Smaller: a place beside it that is less
# deep may be overlooked; larger: the search goes on in vain.
CURVED_ALIKE = 0.98

# Cosine of 14 microradians, within which the faces of a growing polytope are in one plane. Smaller: the point of a
# contact is taken from another face; larger: rounding parts a plane.
ONE_PLANE = 1.0 - 1e-10

# Part of its length by which the first four corners of a growing polytope are wide, if any are. Larger: the search for
# wide ones takes longer; smaller: it begins from a needle, whose faces are rounding.
EVEN = 1e-3

# Newton's steps to the point of an ellipsoid nearest to another; 6 are usual, 20 for one within a needle. Fewer: depths
# of flat ellipsoids at corners of meshes are wrong.
ROUND_STEPS = 40

# What the squared length of a point's share in an ellipsoid may be beyond 1 at the end of those steps. Smaller than
# rounding: the steps go on in vain; larger: depths are wrong by half of it times the ellipsoid's size.
SQUARE_ENOUGH = 1e-14
