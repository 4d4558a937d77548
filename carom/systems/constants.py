"""Every tolerance of the step: its unit, why this size, and what breaks if it changes."""

# m. Bounds reach this much further than the motion foreseen, so that small pushes do not ask for a new detection; and
# where everybody moves, by up to this part of their size, for those who are struck. Larger: more pairs to look at.
# Smaller: more detections in the middle of a step, twice as many in falling piles.
REACH_SLACK, REACH_STIRRED = 3e-3, 0.125

# Part of itself, one in this many, by which a step is due early in real time, so that 100 steps of 0.01 s fit into 1 s
# although the float 0.01 is more than a hundredth; never seen, 16 ns at 60 Hz. Larger: sums of rounded numbers such as
# 1/144 s may end a step short.
EARLY = 2**20

# Factor on the motion foreseen within a step. Below 1 a falling body leaves its bounds in every step.
REACH_FACTOR = 1.25

# Part of a bound's smallest half extent by which the pair cache sees it wider. Larger: more pairs are kept in vain, as
# the cube of it. Smaller: bodies leave their fat bounds sooner and are looked up anew.
FAT = 0.05

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

# m. A pair nearer than this, not parting and not closing fast, rests: contact and friction act on it as a constraint.
# Larger: bodies are held before they touch. Smaller than what the solver leaves open: resting pairs fall apart.
TOUCH = 1e-4

# Resting ends and bouncing begins at this many times (pressing acceleration x substep): a bounce that would land again
# within about two substeps is a contact. Below 1, gravity alone would make a resting body bounce.
REST_SPEED_FACTOR = 2.0

# A blow that makes a resting pair close faster than this many times (acceleration by forces x substep) is an impact of
# its own. Smaller: blows run through piles as endless rows of impacts. Larger: bodies sink in until the next substep.
BLOW_SPEED_FACTOR = 0.1

# Impacts of one pair within a substep after which the rest speed counts all that forces do to its bodies, not only what
# presses the two together, and plastic ones after which the pair is left to the resting stage. They end the endless
# rows of ever smaller impacts inside piles; larger numbers only make piles slower.
PATIENCE = 8

# m/s. Closing slower than this is not closing. It ends the infinite row of ever smaller impacts between bodies that
# nothing presses together; at this speed a pair moves 0.3 mm in a year.
APPROACH = 1e-11

# m. An impact's gap is solved to this; a thousandth of an atom, far above the rounding of positions below 1 km.
ROOT_GAP = 1e-12

# Newton steps to the time of an impact; the bound is quadratic, 5 are usual, grazing ones take some 20.
ROOT_STEPS = 64

# Impacts a substep may hold per near pair, and at least; beyond it bodies pass unseen to the end of the substep, which
# is counted and reported. A ball wedged between others may need hundreds.
IMPACTS_PER_PAIR = 64
IMPACTS_AT_LEAST = 1024

# Sweeps over the points of a manifold that strikes; 30 are usual. Fewer: what lands flat leaves with a spin.
BLOW_SWEEPS = 200

# Part of the smaller shape's longest half extent. A point this near to one of the step before, which is no more, takes
# over its impulses. Larger: impulses of points far off turn bodies for a substep. Smaller: where corners change places,
# edge on edge or among the four of five that are kept, bodies are let go for a substep, and piles tremble for good.
SAME_POINT = 1.0

# Part of the smaller shape's longest half extent by which points may slip or sink, and turn in radians, before a pair
# is measured anew. Larger: contacts are where the shapes no longer are. Smaller: piles are measured at every tremble,
# and tremble.
RECYCLED_SLIP, RECYCLED_TURN = 1e-3, 2e-3

# Points of a manifold; a pair with more on one plane has several.
MANIFOLD_POINTS = 4

# Hz and damping ratio of the spring by which contacts of two moving bodies yield. Stiffer: pyramids flutter (from 60 Hz
# on). Softer: ten cubes of one size sink by 25 mm instead of 11 (30 Hz). A heavy body sinks into light ones.
CONTACT_FREQUENCY, CONTACT_DAMPING = 45.0, 10.0

# Part of the overlap with what cannot move that leaves in a substep; such contacts do not yield, so that what lies on
# the ground lies where it should. Larger: bodies under a pile tremble. Smaller: it takes longer.
RIGID_RATE = 0.05

# Part of what a joint is off by that goes in a substep; and part of the mass, and of the impulse of the substep before,
# that counts meanwhile. Smaller: joints under heavy loads stretch, and pendulums lose energy. Larger: straight chains
# of light links with a heavy end, which a sweep solves in part only, tear themselves apart.
JOINT_RATE, JOINT_HARDNESS = 0.7, 0.85

# m/s, rad/s. What reaches the limit of a joint more slowly does not bounce. Larger: soft bounces end too early.
# Smaller: what lies at its limit trembles.
BOUNCE_SPEED = 0.01

# m/s. Overlap leaves no faster: what begins deep inside another would be shot out.
PUSH_SPEED = 3.0

# Sweeps of the resting stage: over the points of a manifold, over all manifolds after the drift, and over friction and
# rolling of a manifold that resists rolling. One sweep over points lets stacks drift by centimetres; one after the
# drift leaves 3 mm/s in a pyramid; with fewer over rolling a ball takes more substeps to stop than theory does.
POINT_SWEEPS, RELAX_SWEEPS, ROLL_SWEEPS = 2, 2, 8

# Squared part of the most that friction and rolling may be, by which a sweep changes what is found: rounding.
ROLLING_SOLVED = 1e-28

# m/s, times the speed of the impact where that is above 1 m/s. What the points of a striking manifold may leave open.
SOLVED = 1e-13

# m. A gap or overlap up to here counts as touching. Larger: bodies are held that are about to part.
SLOP = 1e-4

# Part of a body's smallest half extent by which it may move within a step before it is looked after on its way. Larger:
# thin bodies pass through thin walls. Smaller: slow bodies cost as much as fast ones.
FAST = 0.5

# m. Half extent that smaller bodies, points among them, are taken to have. Larger: small ones pass through thin walls.
# Smaller: points are looked after at any speed, and looked at again and again.
LEAST_FAST = 1e-3

# Part of a body's smallest half extent up to which a contact found on the way is trusted to say when the gap closes.
# Larger: it is followed past edges that are not there. Smaller: more looks.
TRUST = 0.25

# Part of that at which a body on its way is near enough for its contact to be found. Smaller: more steps to come there.
MEET = 0.25

# Steps towards a meeting, and detections in the middle of a substep for those who are fast. Fewer: bodies that tumble
# past others are given up before they meet; those are counted.
MOST_LOOKS = 64

# m/s. A body no point of which is faster may fall asleep, with its island. Larger: what rolls out slowly stops short.
# Smaller: tall piles, of which cubes tremble by a tenth of this, stay awake longer.
SLEEP_SPEED = 0.03

# s. For how long. Shorter: what turns round, as a pendulum does at its end, is caught there.
SLEEP_TIME = 0.5

# Part of what a medium bears. A body that touches nothing falls asleep in it when the forces on it are less than this
# off balance. Larger: bodies stop above or below where they float, and heeled. Smaller: they stay awake for longer.
AFLOAT = 2e-4

# rad. Closest to zero a squared angle may come before the quaternion exponential uses its limit.
SMALL_ANGLE = 1e-12

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

# Most particles that an emitter brings forth in a step. Larger: the memory fills before a word is said.
MOST_BORN = 1_000_000

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

# m. The overlap or distance of two cores is known to this once the bounds between which FCL's answer is refined are so
# near. Larger: depths are wrong by as much and normals of round bodies by its root; smaller: refining takes longer.
BRACKET = 1e-8

# m. A corner that is less above a face of the growing polytope lies in it. Larger: bounds are wrong by as much;
# smaller: rounding folds faces that lie in one plane.
SEEN = 1e-12

# Sine of the angle below which a face of that polytope is a line, which hides nothing.
SLIVER = 1e-9

# m. How far FCL moves two overlapping shapes of others' making apart to see along which direction they part. Larger:
# less of the direction that they overlap along; smaller: FCL's nearest points, good to a micrometre, turn by degrees.
PARTED = 2e-2

# Contacts that FCL may return for a pair with a mesh, one or more for each triangle. Fewer: sides of a body go unseen.
TRIANGLE_CONTACTS = 32

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

# Part of its length by which two straight sides may be beside each other where they count as touching. Larger: points
# hang in the air beside rods that cross; smaller: rods that lie along each other all but exactly rock on one point.
ASKEW = 1e-3

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

# rad. A direction that parts a round body from an edge and is nearer than this to the normal of a face beside it is of
# that face. Larger: contacts of blunt edges are lost; smaller: what lies on a face has points on its edges as well.
BESIDE_FACE = 1e-6

# Part of a body's longest half extent by which a box may rise above the one that the body lies on and still be flush
# with it. Larger: kerbs are climbed instead of struck; smaller than what bodies sink in by: they stumble over seams.
FLUSH = 1e-3

# Part of the inverse moments about all axes. One that is less is rounding, about an axis that the body cannot turn
# about anyway; locking it changes nothing. Larger: the heaviest axis of a needle counts as none.
HELD = 1e-12

# Part of the angular velocity to which that of a body with one locked axis is solved, and most steps of the iteration,
# which gains the angle turned in half a substep each; 8 are usual.
HELD_TURN, HELD_TURNS = 1e-15, 50

# Part of the inverse masses of two bodies. Where locks leave less of it along a normal, no impulse parts them: on a
# rail within a milliradian of the plane of contact, a normal that is off by rounding would ask for any impulse. Larger:
# bodies on rails pass through what they graze. Smaller: overlap hurls bodies along their rails.
IMMOVABLE = 1e-6

# Determinant of what yields at a point over the cube of its trace, from which the point cannot move in all directions,
# whatever locked axes are there. Larger: friction of needles is solved along one direction. Smaller than rounding: what
# no impulse can stop asks for any.
SINGULAR = 1e-13

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

# Steps of inverse kinematics. From the solution of the frame before, a few are usual; what is out of reach takes most.
REACH_ROUNDS = 200

# Damping of these steps, as part of the trace of J J^T: at first, at least, and that at which no step helps any more.
# Larger: slower at first. A smaller least lets steps next to singular poses grow so long that they are tried in vain.
REACH_DAMPING, REACH_LEAST_DAMPING, REACH_MOST_DAMPING = 1e-3, 1e-10, 1e9

# m and rad. Inverse kinematics ends this near to its target.
REACH_CLOSE = 1e-7

# Bodies that attract each other pair by pair, which is exact and takes 11 ms for as many; of more, those far away pull
# as one, in a quarter of that time with errors of a few thousandths. Larger: the time grows as the square. Smaller: the
# errors of a tree where it saves little.
PAIR_BY_PAIR = 4000

# m. How far a particle is kept off a collider that it bounced off, and how deep below a plane one may lie at rest.
# More than float32 rounds within 1 km; larger, and they would be seen to float.
PARTICLE_SKIN = 1e-4

# m/s. A particle that lies on a plane and is slower than this along its normal does not bounce. Larger, and slow
# bounces would end early; smaller, and rounding would make what lies bounce.
PARTICLE_REST = 1e-5
