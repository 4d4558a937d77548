"""Arcs of particles: what a stretch of flight needs to know of each.

An arc is a column of eight numbers: how long it lasts (s), which part of the velocity drag leaves in half of that, the
acceleration, and the velocity of the medium. Arcs are laid for a chunk of particles at once.
"""

from __future__ import annotations

# mypy: disable-error-code="no-untyped-def"
from carom.systems.kernels.kernel import kernel
from carom.systems.kernels.spatial import exponential

CHUNK = 4096  # particles: what is known of so many stays in the cache of the processor
TIME, LEFT, ACCELERATION, FLOW = 0, 1, 2, 5  # rows of arcs
ARC_ROWS = 8


@kernel("arcs")
def lay_even_arcs(times, drag, ax, ay, az, fx, fy, fz, arcs):
    """Lay arcs of ``times`` (s) at one drag (1/s), acceleration (m/s2) and flow (m/s)."""
    for i in range(len(times)):
        h = times[i]
        arcs[TIME, i], arcs[LEFT, i] = h, exponential(-0.5 * h * drag)
        arcs[ACCELERATION, i], arcs[ACCELERATION + 1, i], arcs[ACCELERATION + 2, i] = ax, ay, az
        arcs[FLOW, i], arcs[FLOW + 1, i], arcs[FLOW + 2, i] = fx, fy, fz


@kernel("arcs")
def lay_arcs(times, inverse_mass, force, drag, drag_flow, arcs):
    """Lay arcs of ``times`` (s) by what the forces on each particle add up to."""
    for i in range(len(times)):
        h = times[i]
        arcs[TIME, i], arcs[LEFT, i] = h, exponential(-0.5 * h * drag[i] * inverse_mass)
        for k in range(3):
            arcs[ACCELERATION + k, i] = force[i, k] * inverse_mass
            arcs[FLOW + k, i] = drag_flow[i, k] / drag[i] if drag[i] > 0.0 else 0.0
