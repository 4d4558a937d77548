"""Inverse kinematics: how an arm comes to its target."""

# Steps of inverse kinematics. From the solution of the frame before, a few are usual; what is out of reach takes most.
REACH_ROUNDS = 200

# Damping of these steps, as part of the trace of J J^T: at first, at least, and that at which no step helps any more.
# Larger: slower at first. A smaller least lets steps next to singular poses grow so long that they are tried in vain.
REACH_DAMPING, REACH_LEAST_DAMPING, REACH_MOST_DAMPING = 1e-3, 1e-10, 1e9

# m and rad. Inverse kinematics ends this near to its target.
REACH_CLOSE = 1e-7
