"""Shapes: what has an area, a volume, a face and an axis."""

# Height over longest edge below which a triangle has no area: corners on a line, up to the rounding of doubles. Larger
# would drop thin triangles of real models; smaller leaves some whose normal is noise.
NO_AREA = 1e-10

# Part of their width that points must leave a plane by to have a hull. Larger would refuse thin plates; smaller leaves
# some to Qhull, which would push them about until they have a volume.
FLATTEST_HULL = 1e-9

# Part of a hull's width that corners may leave the plane of their face by, and by what it is multiplied in turn until
# the faces close a volume. Larger: normals are off by as much over an edge. Smaller: rounding splits faces.
FACE_FLAT = 1e-6
FACE_COARSER = (1.0, 3.0, 10.0, 30.0)

# Least cosine of two triangles of one face. Only slivers, whose normal is noise, are let off; larger would keep some of
# them apart, smaller let thin edges of a wedge pass for flat.
FACE_COSINE = 0.5

# Sine of the tilt up to which an upright cylinder or cone stands on points of its rim that stay. Larger: it stands
# deeper than 2e-5 radii on the side where it leans. Smaller: noise in its tilt turns the points around the rim.
UPRIGHT = 1e-3

# Sweeps of Jacobi's method to the principal axes of a solid; it converges quadratically, 6 are usual. Fewer: axes of
# long thin bodies are not perpendicular.
JACOBI_SWEEPS = 30

# How far a direction may differ from a plane's normal, both of length 1, to be along it, where the half space has an
# end. Larger: finite answers to directions that have none; smaller than rounding: none along the normal.
ALONG_NORMAL = 1e-12

# How far from 1 the length of a plane's normal may be to be left as it is, so that to make a plane of it again changes
# no bit: rounding of a length. Larger: distances to the plane are off by as much.
NORMAL_LENGTH = 1e-15

# m. Radius of the ball that stands for a point in FCL, which has no points. Larger: points touch too early by as much.
LEAST_FCL_RADIUS = 1e-9

# Most triangles of a mesh or height field. Reading, joining and weighing one takes 6 to 11 us for each, and FCL 10 us
# more to build its tree: this many load in 20 s. Larger ones look like a program that hangs.
MOST_TRIANGLES = 1_000_000

# m. How far a collider may reach, but a plane: there doubles are 0.1 mm apart. Larger: FCL looks without end for where
# a bar of 1e19 m touches a box. Smaller: refuses what stands for a planet.
FARTHEST = 1e12
