"""How wide lanes are."""

WIDTH = 8  # numbers in a lane
BLOCK, BLOCKS = 8, 4  # numbers in a block of a body, and blocks of a body
