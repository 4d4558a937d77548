"""Manifolds: which points of two solids touch, and how exactly a contact must keep to its pair."""

# m. A manifold keeps to a face, an axis, a corner or a point of its own unless another one is better by more than this.
# Larger: depths are wrong by as much. Smaller than what rounding and the solver leave: manifolds flicker.
BIAS = 1e-6

# Cosine of 0.36 degrees. A face that is so near to the direction that parts a pair stands for it, with all its points.
# Further from 1: normals are wrong by more than half a degree. Nearer: what lands almost flat rocks on single points.
FACE_CONE = 0.99998

# m. Distance below which the two nearest points of a pair give no direction; 1e-16 / 1e-9 is how wrong it may be.
LEAST_PART = 1e-9

# Squared sine of an angle below which two edges have no common normal of their own: other axes are as good to 1e-7 m.
PARALLEL_EDGES = 1e-14

# Squared sine of 5.7 degrees, up to which a capsule may lie along another or an edge and have two points. Larger is no
# use: the points are taken only if they are as deep as the nearest ones, to BIAS.
ALONG = 0.01

# m. How far beyond a face's edge the other body's corners still count as over it, so that bodies stacked edge on edge
# keep their corners. Larger: points hang in the air; smaller: noise in poses swaps corners for crossings of edges.
OVER_EDGE = 1e-5

# Cosine of 5.7 degrees: a contact whose normal is nearer than this to that of a face is that of the face's area, else
# one point. Beyond it the points of an area only press when the bodies are about to turn by as much.
FLAT_COSINE = 0.995

# Part of its length by which two straight sides may be beside each other where they count as touching. Larger: points
# hang in the air beside rods that cross; smaller: rods that lie along each other all but exactly rock on one point.
ASKEW = 1e-3

# Part of the radii of round sides by which lines on them may be beside each other where they count as touching: as far
# apart there as two arcs are, which is a hundredth of it. Larger: the normal is off by as much; smaller: the points of
# rods that lie along each other jump from end to end with the least turn, and rods on rods never come to rest.
ASKEW_ROUND = 0.02

# m. Polyhedra nearer than this are parted along their faces' and edges' normals; their distance has no direction that
# rounding leaves alone.
APART_LEAST = 1e-7

# m. Error of a distance of polyhedra beyond which it is not believed.
APART_ERROR = 1e-9

# Steps to the distance of two polyhedra; 5 are usual, 15 between round ones. Fewer: distances are not believed.
APART_STEPS = 64

# How far the length of a contact's normal may be from 1; quaternions and FCL leave 1e-15. Larger: impulses as wrong.
UNIT_NORMAL = 1e-6

# m, and part of the length: how exactly a contact must keep to the sizes of its pair. FCL gives points 1 nm of extent.
# Smaller: contacts at the very edge of what is accepted are dropped by rounding.
MEASURED = 1e-6

# Degrees, and part of the smaller size: a stand-in whose deepest point differs from FCL's by a larger turn or depth
# disagrees with it. Larger would pass faults that show in rolling; smaller, what rounding leaves.
AUDITED_TURN, AUDITED_DEPTH = 0.5, 3e-6

# m. Points that are no higher above the lowest one stand for an area by how much of it they span, further ones by how
# low they are. Larger: bodies roll onto corners that are left out. Smaller: as they rock, the choice changes.
AS_LOW = 1e-3

# Part of its radius by which the contact of a rim or an ellipsoid may go on in half a step; what goes farther comes to
# lie flat, and where it leans is found anew. Larger: its contact is where nothing is yet. Smaller: coins that are about
# to come to rest sink in.
ROLLED_ON = 0.5

# Part of its radius within which a contact is that of the lowest point of an end. Larger: points of a rim go on that
# turn with their body. Smaller: rounding holds it where it was.
ROLLING_POINT = 1e-3

# Further points of a rim that leans, of those that do not touch. Fewer: drums roll 1 to 2 cm in between the others.
# More: piles of cylinders take longer to come to rest.
ROLLED_ONTO = 2
