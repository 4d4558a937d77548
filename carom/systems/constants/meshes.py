"""Meshes: which triangles, edges and corners a body touches."""

# Sine of the angle below which two triangles of a mesh lie in one plane: their common edge never touches for itself.
# Larger: corners of bodies sink into slight ridges; smaller: noise in vertices (float32 in STL files) makes ridges.
COPLANAR = 1e-4

# Sine of the angle by which a mesh may rise about an edge or corner and still be touched there: rounding. Larger: edges
# within flat areas give normals of their own.
LEANING = 1e-7

# m. Points that FCL gives for triangles with one normal (SAME_NORMAL) are one where they are nearer than this. Larger:
# corners of small bodies are lost; smaller: triangles that meet under a corner give it several times.
SAME_SPOT = 1e-3

# Cosine of 10 degrees: a body has one manifold with all triangles of a mesh whose normals are within it. Larger angles
# lose points on bent land; smaller ones give more points than it takes.
SAME_NORMAL = 0.985

# Part of the depth under a triangle. A body that overlaps it by less, seen along an axis that leads past a convex edge
# or corner of the mesh, meets the triangles beyond. Larger: thin bodies lose points near edges. Smaller: a body that
# grazes the corner of a block is lifted over all of its height.
BORDER = 0.05

# Part of a body's width within which two points of a manifold are one, and how far it may sink into edges of triangles
# that face away from its middle. Larger: points are lost; smaller: twins of triangles that meet in a corner stay.
SAME_PLACE = 1e-3

# Part by which a point on a mesh must be deeper or farther out than one found before to be taken instead. Smaller:
# noise changes the choice.
BETTER = 1e-3

# How many times as far as it is beneath a triangle's plane something may be beyond its edge, for it to be looked for
# beneath the bottom of a valley: cotangent of half the angle between its sides, of 19 degrees. Smaller: what has sunk
# into narrow gorges falls on.
GORGE = 6.0

# Part of SAME_PLACE by which a point within a manifold is to be lower than what the others span to be one of it too.
# Larger: bodies sink onto ridges that are left out, and rock; smaller: noise in vertices gives points of its own.
LOWER = 1e-2

# Contacts that FCL may return for a pair with a mesh, one or more for each triangle. Fewer: sides of a body go unseen.
TRIANGLE_CONTACTS = 32

# rad. A direction that parts a round body from an edge and is nearer than this to the normal of a face beside it is of
# that face. Larger: contacts of blunt edges are lost; smaller: what lies on a face has points on its edges as well.
BESIDE_FACE = 1e-6

# Part of a body's longest half extent by which a box may rise above the one that the body lies on and still be flush
# with it. Larger: kerbs are climbed instead of struck; smaller than what bodies sink in by: they stumble over seams.
FLUSH = 1e-3
