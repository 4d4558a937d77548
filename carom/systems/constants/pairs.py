"""Finding pairs: bounds, the grid and the tree over them."""

# m. Bounds reach this much further than the motion foreseen, so that small pushes do not ask for a new detection; and
# where everybody moves, by up to this part of their size, for those who are struck. Larger: more pairs to look at.
# Smaller: more detections in the middle of a step, twice as many in falling piles.
REACH_SLACK, REACH_STIRRED = 3e-3, 0.125

# Part of the ways of all to which they come down as seen from what moves as they do in the mean, from which on it is
# that from where they reach; and of how many. Larger: those who do not go that way reach farther. Smaller: crowds that
# fly are slower. Fewer: who strikes leaves his reach, and is looked after where nothing was to be gained.
STREAMS, CROWD = 0.25, 32

# Part of a body's least radius of gyration beyond which neither makes its bounds reach further. Larger: gravel, which
# is as small as these lengths, has contacts with all that is near. Smaller: it leaves its reach in every step.
REACH_SMALL = 0.3

# Bodies that may leave their reach at once and are asked one by one whether they meet somebody new: if not, as most,
# the detection of the step still holds. More: asked in vain where many are struck, by an explosion.
MOST_WIDENED = 16

# Pairs for each collider that is in any, beyond which detection foresees what may be within the substep only, and not
# within the step, in which gravel that falls by 5 cm would have 250 contacts a cube: all that may pile up by then.
# Larger: slower from there on. Smaller: piles, which have up to 12, are detected anew in every substep.
CROWDED = 16

# Part of a gap by which a pair has to come nearer no more before it is measured again, and of a trust below which
# nothing is left of it, for what ways are rounded by.
# Smaller: contacts might be overlooked. Larger: pairs are measured in vain.
APART_MARGIN = 1e-6

# Factor on what a ball and another body reach up to which their contact stays in the table, though none comes. Larger:
# more are looked at in vain. Smaller: they come and go, and all manifolds are put into groups anew each time.
REACH_KEPT = 1.25

# Factor on the motion foreseen within a step, or in what is left of it. Below 1 a falling body leaves its bounds in
# every step. Larger: more of those who leave theirs meet somebody new, far off.
REACH_FACTOR = 1.25

# Part of a bound's smallest half extent by which the pair cache sees it wider. Larger: more pairs are kept in vain, as
# the cube of it. Smaller: bodies leave their fat bounds sooner and are looked up anew.
FAT = 0.05

# Steps for which it sees a bound on the way that it goes and turns, and up to which part of its least extent. Larger:
# more pairs are kept in vain. Smaller: whoever flies or tumbles is looked up anew every few steps.
AHEAD, MOST_AHEAD = 16.0, 0.5

# Sizes that may share a grid, in quarters of a power of two: within a factor of four. More: small bodies crowd in cells
# made for large ones. Fewer: more bodies are in the tree, which is slower.
SIZE_CLASS = 8

# Part by which a cell of the grid is larger than the largest bounds in it, and how many cells may be along an axis. The
# rounding of a cell's number, a few times 2**-53 of it, must be less, or neighbours would be overlooked.
CELL_SLACK = 2.0**-20
MOST_CELLS_ALONG = 2.0**30

# Part of all rows that may have left their place in grid and tree before both are built anew, which costs as much as
# looking up about a fifth of the rows.
MOST_ASTRAY = 0.125

# Rows that may in any case, since testing these one by one costs a tenth of building anything.
FEW_ASTRAY = 64

# Colliders that may stand or sleep beside a stream with which the pair cache goes along, in which they are looked up in
# every step. More: crowds that come to rest are looked up one by one. Fewer: who falls over a few walls is.
FEW_BESIDE = 16
