"""Coming up: how the surfaces of kinematic bodies that turn come up to who goes along with them.

Whoever lies on the inside of a drum is pressed on it by its turning, as by a force: seen from the drum, what moves at u
there is accelerated by -w x (w x r) - 2 w x u (Goldstein, Classical Mechanics, 3rd ed., section 4.10).
"""

from __future__ import annotations

# mypy: disable-error-code="no-untyped-def,no-untyped-call"
from carom.systems.kernels import groups as of
from carom.systems.kernels.bodies import surface_velocity
from carom.systems.kernels.going_along import turns_by_itself
from carom.systems.kernels.kernel import inlined, woven
from carom.systems.kernels.lane_vectors import cross, dot, minus, plus, spanned, three, times
from carom.systems.kernels.lanes import choose, larger, some, spread
from carom.systems.kernels.levers import frame_of
from carom.systems.kernels.spatial import cross as cross_of


@inlined
def coming_up(a, b, ax, ay, az, bx, by, bz, nx, ny, nz, linear, angular, inverse_mass):
    """Return how fast (m/s2) turning presses two bodies together at a point ax from a's centre and bx from b's.

    The normal n is from a to b. It is 0 where none of them is kinematic, or none turns.
    """
    up = 0.0
    for i, o, rx, ry, rz, sx, sy, sz, sense in (
        (a, b, ax, ay, az, bx, by, bz, 1.0), (b, a, bx, by, bz, ax, ay, az, -1.0),
    ):  # fmt: skip
        if i >= 0 and inverse_mass[i] == 0.0:
            wx, wy, wz = angular[i, 0], angular[i, 1], angular[i, 2]
            vx, vy, vz = surface_velocity(o, sx, sy, sz, linear, angular)
            cx, cy, cz = cross_of(wx, wy, wz, rx, ry, rz)
            vx, vy, vz = 2.0 * (vx - linear[i, 0]) - cx, 2.0 * (vy - linear[i, 1]) - cy, 2.0 * (vz - linear[i, 2]) - cz
            cx, cy, cz = cross_of(wx, wy, wz, vx, vy, vz)
            up += sense * (nx * cx + ny * cy + nz * cz)
    return max(0.0, up)


@woven
def coming_up_in_lanes(r, lanes, a, b):
    """Return what `coming_up` does for the middles of eight manifolds, of bodies as they move."""
    none, w_a, w_b = spread(0.0), a[4:7], b[4:7]
    turns_a, turns_b = turns_by_itself(a), turns_by_itself(b)
    if not (some(turns_a) or some(turns_b)):
        return none
    t, u, n = frame_of(r, lanes)
    x, y, z = three(lanes, r + of.MIDDLE_A)
    by_a = cross(w_a, plus(spanned(x, t, y, u), times(z, n)))
    x, y, z = three(lanes, r + of.MIDDLE_B)
    by_b, twice = cross(w_b, plus(spanned(x, t, y, u), times(z, n))), spread(2.0)
    apart = minus(b[:3], a[:3])
    up_a = dot(n, cross(w_a, minus(times(twice, plus(apart, by_b)), by_a)))
    up_b = dot(n, cross(w_b, plus(times(twice, minus(apart, by_a)), by_b)))
    return larger(none, choose(turns_a, up_a, none) + choose(turns_b, up_b, none))
