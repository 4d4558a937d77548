"""Many: particles, and bodies that attract each other."""

# Most particles that an emitter brings forth in a step. Larger: the memory fills before a word is said.
MOST_BORN = 1_000_000

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
