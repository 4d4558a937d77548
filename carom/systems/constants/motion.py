"""Motion: who is fast, who falls asleep, and how bodies turn."""

# Part of a body's smallest half extent by which it may move within a step before it is looked after on its way. Larger:
# thin bodies pass through thin walls. Smaller: slow bodies cost as much as fast ones.
FAST = 0.5

# m. Half extent that smaller bodies, points among them, are taken to have. Larger: small ones pass through thin walls.
# Smaller: points are looked after at any speed, and looked at again and again.
LEAST_FAST = 1e-3

# Part of a body's smallest half extent up to which a contact found on the way is trusted to say when the gap closes.
# Larger: it is followed past edges that are not there. Smaller: more looks.
TRUST = 0.25

# Part of the way that bodies glide that counts against what contacts are trusted: all of it where they turn, or where a
# face of a mesh may end. Larger: whoever falls fast beside a wall has all contacts found anew in each substep. Smaller:
# what glides over an edge at hundreds of m/s is struck by the face that has ended there.
GLIDING = 0.25

# Part of what contacts are trusted by which the nearest of them may be nearer or farther than its pair, where contacts
# still tell how that meets. Larger: rims that roll on are struck beside where they touch. Smaller: more
# detections.
TOLD = 0.05

# Cosine of 0.04 rad, by which the normal of such a contact may lean. Smaller: what turns about an edge is struck along
# where its face was. Larger: more detections.
TOLD_ALIKE = 0.9992

# Part of what contacts are trusted that is left where they are asked too when others are. Larger: more are asked each
# time. Smaller: more often.
SOON_SPENT = 0.5

# Part of what contacts are trusted by which the nearest of something round must be off to be put where that is nearest.
# Larger: it stays behind as a rim rolls on. Smaller: of those of two faces that lie on each other one is put anywhere.
ROLLED_ASIDE = 0.005

# Part of what contacts are trusted at which a body on its way is near enough for its contact to be found. Smaller: more
# steps to come there.
MEET = 0.25

# Turn of a body within a substep (rad) beyond which those of its contacts that are too far to be trusted are let go,
# which are followed straight on. Smaller: more detections. Larger: they strike where nobody is.
ASTRAY = 1.0

# Steps towards a meeting. Fewer: it is looked at again before.
STEPS_TO_MEET = 64

# Looks within a substep at those who are fast, of which a detection counts as one. Fewer: bodies that tumble past
# others are given up before they meet; those are counted.
MOST_LOOKS = 256

# Pairs of two fast bodies that can both be pushed, up to which they are looked after, and detections in a step up to
# which they are. More: clouds of fragments are detected again and again. Fewer: some turn off by a tenth.
FEW_MEETING = 32

# m/s. A body no point of which is faster may fall asleep, with its island. Larger: what rolls out slowly stops short.
# Smaller: tall piles, of which cubes tremble by a tenth of this, stay awake longer.
SLEEP_SPEED = 0.03

# s. For how long. Shorter: what turns round, as a pendulum does at its end, is caught there.
SLEEP_TIME = 0.5

# Part of what a medium bears. A body that touches nothing falls asleep in it when the forces on it are less than this
# off balance. Larger: bodies stop above or below where they float, and heeled. Smaller: they stay awake for longer.
AFLOAT = 2e-4

# Part of itself, one in this many, by which a step is due early in real time, so that 100 steps of 0.01 s fit into 1 s
# although the float 0.01 is more than a hundredth; never seen, 16 ns at 60 Hz. Larger: sums of rounded numbers such as
# 1/144 s may end a step short.
EARLY = 2**20
