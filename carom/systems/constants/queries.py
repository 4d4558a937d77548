"""Queries and sensors: rays, casts, and who is inside."""

# m. How far from a sensor who is inside must come to be out, and how deep a trip in or out must be to be seen. Larger:
# sensors overlook who grazes them, and who leaves one slowly does so late. Smaller than what landing bodies tremble by:
# who comes to lie at the border of a sensor goes in and out.
SENSED = 1e-5

# s, m. How near the time of a crossing is found, or the gap there. Larger: times are less exact; smaller: rounding.
CROSSED, CROSSING_GAP = 1e-12, 1e-13

# Newton steps from 0 to an angle of at most a quarter turn, each of which cubes the error; the fifth leaves rounding.
ANGLE_STEPS = 5

# Times within a substep at which a pair is measured in the search for a trip into a sensor and back; 6 are usual.
# Fewer: more trips past its edges are overlooked; more: what glides along a mesh that is a sensor takes longer.
MOST_PROBES = 64

# m. A ray that begins no farther than this from a surface begins on it: what it leads into is met at once, what it
# leads out of is not. Larger: thin plates are overlooked from within. Smaller than the rounding of positions: a ray
# that begins where another has hit meets the same face again.
ON_SURFACE = 1e-9

# m. Farthest from the origin that a query may look: products of two such lengths are still numbers.
FARTHEST_QUERY = 1e100

# m. A shape that is cast has come to what it meets when their gap is this. Larger: it stops short by as much, and by
# more where it comes at a slant. Smaller than the rounding of positions: steps in vain.
CAST_GAP = 1e-11

# m. How far before the end of a cast its last step begins where the two are too near to be measured. Larger: round
# shapes stop short by its square over their radius. Smaller: their distance has too few digits there.
CAST_BACK = 1e-5

# m. A cast that begins nearer than this to a convex collider is told by their gap and normal alone. Smaller: cores
# are so near that their distance has no direction.
CAST_BEGUN = 1e-6
