"""How wide lanes are."""

WIDTH = 8  # numbers in a lane
BLOCK, PLANES = 8, 4  # numbers of a body in a plane, and planes
