"""Resting contacts and joints: what is kept from step to step, how they yield, and how often they are swept."""

# Part of the smaller shape's longest half extent. A point this near to one of the step before, which is no more, takes
# over its impulses. Larger: impulses of points far off turn bodies for a substep. Smaller: where corners change places,
# edge on edge or among the four of five that are kept, bodies are let go for a substep, and piles tremble for good.
SAME_POINT = 1.0

# Part of the smaller shape's longest half extent by which points may slip or sink, and turn in radians, before a pair
# is measured anew. Larger: contacts are where the shapes no longer are. Smaller: piles are measured at every tremble,
# and tremble.
RECYCLED_SLIP, RECYCLED_TURN = 1e-3, 2e-3

# Sine of the angle between a normal and the axis of what is round about that, below which it stands on its end and does
# not roll. Smaller: points of what stands wander about. Larger: coins that wobble touch where they did before. And sine
# of the angle by which a normal leans along the axis of a cylinder that lies on its side. Smaller: one that sinks in at
# one end counts as standing on its rim. Larger: one that tips over its rim counts as lying.
ON_END, ON_SIDE = 0.1, 0.01

# Radians by which one of two bodies turns in a substep before their points are carried on with that. Larger:
# what tips over an edge does so late. Smaller: what is at rest is asked in vain.
TURNED = 1e-6

# Radians by which bodies turn before what their inertia is about contacts is found anew. Larger: it is that of some
# substeps ago, and tops that spin gain speed by what keeps them up. Smaller: it takes time, for what hardly turns.
STALE_TURN = 1e-3

# Radians by which one of two bodies turns in a substep before the frames of their contacts go on with the face. Larger:
# what goes round together creeps. Smaller: it takes time, for what hardly does.
LAGS = 1e-3

# Radians by which the normal between two that are round turns in a substep before it goes on within the step, and part
# of how far their cores are apart up to which a gap between them may be. Larger: who rolls off what is round is jolted
# as it begins to; normals turn too far. Smaller: what trembles is turned for nothing; who leaves comes down again.
GOES_ROUND, ROUND_GAP = 1e-4, 0.1

# Sine of the angle by which a normal may lean against that of a cylinder's end or a hull's face and still be of it, and
# part of the radius within which one touches an end and not its rim. Larger: points of rims and edges glide as over
# faces. Smaller: faces that turn leave behind who leans a little, or lies near the rim.
FACING, WITHIN = 1e-3, 0.999

# Points of a manifold; a pair with more on one plane has several.
MANIFOLD_POINTS = 4

# Periods, in a substep, and damping ratio of the spring by which contacts of two moving bodies yield: 45 Hz in substeps
# of 1/240 s, stiffer in finer ones. Stiffer: pyramids flutter (from a quarter on). Softer: ten cubes of 1 m sink by
# 25 mm instead of 11 (1/8), and towers buckle sooner. A heavy body sinks into light ones.
CONTACT_PERIODS, CONTACT_DAMPING = 0.1875, 10.0

# m. A gap between two moving bodies yields the less the wider it is, up to this. Narrower: of corners that land at once
# some yield and some do not, by how they turned by a billionth, and columns fall elsewhere. Wider: pyramids sway.
HARD_GAP = 1e-4

# Part of the overlap with what cannot move that leaves in a substep; such contacts do not yield, so that what lies on
# the ground lies where it should. Larger: bodies under a pile tremble. Smaller: it takes longer.
RIGID_RATE = 0.05

# m/s2, and part of what a point bears beyond so much times the mass that counts there by which it yields then: between
# two moving bodies, and on what cannot move, which yields to no less. Less load: walls of 40 rows lean sooner. More, or
# a larger part: who is heavy sinks in, and what stands on columns of light bodies leans. Smaller: it rocks for longer.
LOADED, LOADED_YIELD = 800.0, 0.001
LOADED_RIGID, LOADED_RIGID_YIELD = 400.0, 0.001

# rad/s, m. Who rocks so fast on what cannot move leaves it by half of that, who is faster by less; overlap beyond so
# much leaves as ever. Larger, or less overlap: he is lifted after each landing as far as he sank in it, and rocks on
# for good. Smaller: what trembles sinks in. More overlap: what a press crushes comes out late.
ROCKING, ROCKING_DEPTH = 3e-3, 5e-4

# m, and part of its impulses that a body keeps from step to step where it overlaps by more with what is driven against
# it: it is being crushed, which no impulse can help, and those that add up throw it out. A smaller overlap: what is
# carried sinks in. A larger part: what comes out of a press does at hundreds of m/s.
CRUSHED, CRUSHED_PART = 0.02, 0.3

# Part of what a joint is off by that goes in a substep; and part of the mass, and of the impulse of the substep before,
# that counts meanwhile. Smaller: joints under heavy loads stretch, and pendulums lose energy. Larger: straight chains
# of light links with a heavy end, which a sweep solves in part only, tear themselves apart.
JOINT_RATE, JOINT_HARDNESS = 0.7, 0.85

# Squared angle by which a body turns in a substep, times how much more its end yields by turning than by moving, from
# which on what a joint of it is off by goes no faster than so much (m/s, rad/s), and beyond which only so much of the
# impulse of the substep before counts as makes it that. It is 0.001 of a cube hung by its edge that turns at 5 rad/s.
# Larger: chains of small bodies on long arms gain energy without end. Smaller: they come apart, and arms that motors
# drive swing past their limits.
WHIRLS, JOINT_SPEED, STALE = 0.5, 5.0, 32.0

# m/s, rad/s. What reaches the limit of a joint more slowly does not bounce. Larger: soft bounces end too early.
# Smaller: what lies at its limit trembles.
BOUNCE_SPEED = 0.01

# m/s. Overlap leaves no faster: what begins deep inside another would be shot out.
PUSH_SPEED = 3.0

# Sweeps of the resting stage: over the points of a manifold, and over friction and rolling of a manifold that resists
# rolling. One sweep over points lets stacks drift by centimetres; with fewer over rolling a ball takes more substeps to
# stop than theory does.
POINT_SWEEPS, ROLL_SWEEPS = 2, 8

# Sweeps over all manifolds after the drift: in all substeps of a step, and in each of them at least. Fewer: a pyramid
# in one substep sways for long, one in several is left at 3 mm/s. More: the former settles aside.
STEP_SWEEPS, RELAX_SWEEPS = 6, 2

# Sweeps more over those bodies on which somebody starts to press: points and friction find together by half in each.
# Fewer: what starts on a slope gets ahead of theory by a third of what it gains in its first step. More: it takes time.
START_SWEEPS = 2

# m/s. Where the last of these sweeps changed how fast two bodies part by more than the first, others follow until one
# changes nothing by more than the second; and how many at most. Larger: columns that land go on closing, sink into each
# other by centimetres and bounce off that. Smaller: piles are swept often while they settle. It is the centres of two
# that yield, and the points of one on what does not: measured at points too, the former are swept a tenth more often.
STIRRED, CALM, MORE_SWEEPS = 0.5, 0.1, 20

# m/s2. Under a body that is so many times HEAVY beside another, who bears it is swept once more for each time that the
# load of a point is so much times the mass that counts there, up to so many times; and so is who is held by a joint.
# Less often: 1,000 kg sink through three cubes of 1 kg, and what stands on a table rocks. More: a crate on a heap of
# boxes takes long.
BEARING, HEAVY, BEARING_SWEEPS = 20.0, 8.0, 60

# Squared part of the most that friction and rolling may be, by which a sweep changes what is found: rounding.
ROLLING_SOLVED = 1e-28

# Part of all manifolds that may begin or end to rest while all stay in their groups. More: groups are solved in which
# only one rests. Fewer: where balls come to rest, all are grouped anew in each step.
REGROUPED = 1.0 / 64.0
