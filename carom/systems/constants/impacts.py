"""Impacts: when a pair strikes, when it rests, and how exactly the time and impulse are found."""

# m. A pair nearer than this, not parting and not closing fast, rests: contact and friction act on it as a constraint.
# Larger: bodies are held before they touch. Smaller than what the solver leaves open: resting pairs fall apart.
TOUCH = 1e-4

# Resting ends and bouncing begins at this many times (pressing acceleration x substep): a bounce that would land again
# within about two substeps is a contact. Below 1, gravity alone would make a resting body bounce. A blow that makes
# solids which rest, and bounce, close faster than this many times (acceleration by forces x substep) is an impact.
REST_SPEED_FACTOR = 2.0

# The same of balls, whose impacts take less time. Smaller: blows run through piles as endless rows of impacts. Larger:
# bodies sink in until the next substep.
BLOW_SPEED_FACTOR = 0.1

# Part of the radius of gyration of the smaller of two bodies by which a blow may sink a resting pair until the substep
# ends (TOUCH at least); where it would by more it is an impact of its own, also of those who do not bounce. Smaller:
# blows run through piles. Larger: small bodies that land one on the other are driven into each other.
BLOW_SINK = 0.02

# Impacts of one pair within a substep after which the rest speed counts all that forces do to its bodies, not only what
# presses the two together; and as many plastic ones after which the pair is left to the resting stage. They end the
# endless rows of ever smaller impacts inside piles. More: what crashes is slower. Fewer: it sinks in deeper.
PATIENCE = 8

# Times as many plastic ones where one of the pair cannot be pushed. Fewer: crowds drive those in front through walls.
STANDING = 32

# What is left of a speed after as many bounces as a pair had within a substep, below which it bounces no more: then
# others press the two together. Larger: who bounces in a closing gap stops. Smaller: crowds that crash are slower.
ENDED = 1e-6

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

# Sweeps after which impulses leap to where the last two lead. More: slower. Fewer: before they lead anywhere.
LEAP_SWEEPS = 5

# m/s, times the speed of the impact where that is above 1 m/s. What the points of a striking manifold may leave open.
SOLVED = 1e-13

# m. A gap or overlap up to here counts as touching. Larger: bodies are held that are about to part.
SLOP = 1e-4
