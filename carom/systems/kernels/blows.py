"""Impacts of bodies without exact arcs: when a manifold closes, and what all its points do at once."""

from __future__ import annotations

from math import sqrt

import numpy as np

# mypy: disable-error-code="no-untyped-def"
from carom.systems.constants import (
    APPROACH,
    BLOW_SWEEPS,
    IMMOVABLE,
    LEAP_SWEEPS,
    SOLVED,
    TOUCH,
)
from carom.systems.kernels.balls import NEVER
from carom.systems.kernels.blow_points import depth_now, meet
from carom.systems.kernels.bodies import (
    hardness,
    movable_of,
    push_at,
    stop_pressing,
    surface_velocity,
)
from carom.systems.kernels.bouncing import bounce_of
from carom.systems.kernels.coming_up import coming_up
from carom.systems.kernels.kernel import inlined, making
from carom.systems.kernels.leaping import leap, times_of_way
from carom.systems.kernels.point_coupling import couple_points, part_points, parted, yields_at
from carom.systems.kernels.spatial import cross


@inlined
def foresee_blow(
    first, end, now, h, slow, sink, struck, bend, center, linear, angular,
    time, acceleration, body_a, body_b, normal, deep, at_a, at_b, start_center, turned, resting,
):  # fmt: skip
    """Return when the first point of a manifold closes within the substep, NEVER if none does.

    Accelerations of the arcs count along the normal, turning as it is now. A point of one that rests counts only where
    a blow makes it close faster than ``slow`` (m/s) and sink by more than ``sink`` (m) until the substep ends: the
    solver holds the others, but for those to come of one that rests since it was ``struck``.
    """
    a, b = body_a[first], body_b[first]
    nx, ny, nz = normal[first, 0], normal[first, 1], normal[first, 2]
    pull, gained, covered = 0.0, 0.0, 0.0  # of a against b, along the normal; the last two since their own times
    for body, sense in ((a, 1.0), (b, -1.0)):
        if body >= 0:
            late = now - time[body]
            along = sense * (nx * acceleration[body, 0] + ny * acceleration[body, 1] + nz * acceleration[body, 2])
            pull, gained, covered = (
                pull + along,
                gained + 2.0 * bend * along * late,
                covered + bend * along * late * late,
            )
    soonest = NEVER
    for c in range(first, end):
        closing = gained
        gap = -depth_now(c, a, b, normal, deep, at_a, at_b, start_center, center, turned) - covered
        for body, at, sense in ((a, at_a, 1.0), (b, at_b, -1.0)):
            if body >= 0:
                x, y, z = surface_velocity(body, at[c, 0], at[c, 1], at[c, 2], linear, angular)
                speed = sense * (nx * x + ny * y + nz * z)
                gap -= speed * (now - time[body])
                closing += speed
        held = resting[first] and (gap <= TOUCH or not struck)
        if held and (closing <= slow or closing * (h - now) - max(0.0, gap) <= sink):
            continue
        if gap <= 0.0:
            if closing > APPROACH:
                return now
            continue
        root = closing * closing + 4.0 * bend * pull * gap  # of gap = closing t + bend pull t^2
        if root >= 0.0 and closing + sqrt(root) > 0.0:
            soonest = min(soonest, now + 2.0 * gap / (closing + sqrt(root)))
    return soonest if soonest <= h else NEVER


@making
def blow(
    first, end, h, struck_before, center, rotation, linear, angular, acceleration, felt,
    inverse_mass, inverse_inertia, principal, freedom,
    body_a, body_b, row_a, row_b, shape, bound_radius, normal, offset_a, offset_b, deep, at_a, at_b, start_center,
    turned, detected_rotation, share, surface, friction, restitution, impulse, friction_impulse,
):  # fmt: skip
    """Let all touching points of a manifold strike at once, within Coulomb's cone over the whole impulse.

    Poisson's restitution: each gives back its impulse of compression times e. That is Newton's where nothing rubs, and
    where something does a body gains no energy by it (Glocker and Pfeiffer, Nonlinear Dynamics 7, 471, 1995).

    Returns (closing speed, normal impulse, its point from the centre of a or, where a is static, of b, friction impulse
    on b (3), whether they stay together).
    Gauss-Seidel over the points of one pair; of four points in a plane, whichever solution gives the same motion. Every
    few sweeps they leap (`leap`), where as many follow: those take back what was too far. Where friction undoes in each
    sweep what the normal impulse did, the second half of the sweeps take shorter steps.
    """
    a, b = body_a[first], body_b[first]
    nx, ny, nz = normal[first, 0], normal[first, 1], normal[first, 2]
    touching, n = np.empty(end - first, np.int64), 0
    for c in range(first, end):
        if -depth_now(c, a, b, normal, deep, at_a, at_b, start_center, center, turned) <= TOUCH:
            meet(
                c, a, b, row_a, row_b, shape, bound_radius, normal, offset_a, offset_b, deep, at_a, at_b, start_center,
                center, turned, detected_rotation, rotation, share,
            )  # fmt: skip
            touching[n], n = c, n + 1
    touching = touching[:n]
    ease, least, given, aside = np.empty(n), np.zeros(n), np.zeros((n, 4)), np.zeros(n)
    coupling, slips, start, way = np.zeros((n, n, 9)), np.empty((n, 3)), np.zeros((n, 4)), np.zeros((n, 4))
    for body, at in ((a, at_a), (b, at_b)):
        couple_points(
            body, touching, at, inverse_mass, inverse_inertia, principal, freedom, rotation, coupling
        )  # fmt: skip
    speed = 0.0
    for m in range(n):
        ease[m] = hardness(yields_at(m, nx, ny, nz, coupling), a, b, inverse_mass)
        slips[m, 0], slips[m, 1], slips[m, 2] = slip_of_pair(touching[m], a, b, at_a, at_b, linear, angular)
        if ease[m] > 0.0:
            speed = max(speed, -(nx * slips[m, 0] + ny * slips[m, 1] + nz * slips[m, 2]))
    if speed <= APPROACH:
        return 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, True
    i, o, to_i = (a, b, -1.0) if a >= 0 else (b, a, 1.0)
    c = touching[0]
    turning = coming_up(
        a, b, at_a[c, 0], at_a[c, 1], at_a[c, 2], at_b[c, 0], at_b[c, 1], at_b[c, 2], nx, ny, nz, linear, angular,
        inverse_mass,
    )  # fmt: skip
    bounce = bounce_of(
        restitution[first], speed, i, o, to_i * nx, to_i * ny, to_i * nz, h, struck_before, felt, acceleration, turning
    )  # fmt: skip
    movable, solved = movable_of(a, b, inverse_mass), SOLVED * max(1.0, speed)
    for restoring in (False, True):  # until no point closes, then with what the bodies give back
        if restoring:
            if bounce == 0.0:
                break
            for m in range(n):
                least[m] = (1.0 + bounce) * given[m, 0]
        for sweep in range(BLOW_SWEEPS):
            going = False
            for m in range(n):
                if ease[m] == 0.0:
                    continue
                c = touching[m]
                sx, sy, sz = slips[m, 0], slips[m, 1], slips[m, 2]
                before = given[m, 0]
                step = ease[m]
                if sweep >= BLOW_SWEEPS // 2:
                    step /= 1.0 + friction[first] * aside[m] * step
                given[m, 0] = max(least[m], before - step * (nx * sx + ny * sy + nz * sz))
                j = given[m, 0] - before
                going |= abs(j) > solved * ease[m]
                jx, jy, jz = j * nx, j * ny, j * nz
                if friction[first] > 0.0:
                    ux, uy, uz = parted(m, m, jx, jy, jz, coupling)
                    if sweep == 0 and j != 0.0:  # how fast it slips for a unit impulse along the normal
                        dx, dy, dz = cross(nx, ny, nz, ux, uy, uz)
                        aside[m] = sqrt(dx * dx + dy * dy + dz * dz) / abs(j)
                    fx, fy, fz, k = rub_point(
                        m, nx, ny, nz, sx + ux + surface[c, 0], sy + uy + surface[c, 1], sz + uz + surface[c, 2],
                        friction[first], movable, coupling, given,
                    )  # fmt: skip
                    going |= fx * fx + fy * fy + fz * fz > (solved * k) ** 2
                    jx, jy, jz = jx + fx, jy + fy, jz + fz
                part_points(m, jx, jy, jz, coupling, slips)
            if not going:
                break
            times = times_of_way(given, start, way)
            if sweep % LEAP_SWEEPS == LEAP_SWEEPS - 1 and times != 0.0 and sweep + LEAP_SWEEPS < BLOW_SWEEPS:
                leap(times, nx, ny, nz, friction[first], least, ease, way, coupling, given, start, slips)
    for m in range(n):
        j = given[m, 0]
        push_pair(
            touching[m], a, b, j * nx + given[m, 1], j * ny + given[m, 2], j * nz + given[m, 3], at_a, at_b,
            linear, angular, inverse_mass, inverse_inertia, principal, freedom, rotation,
        )  # fmt: skip
    if bounce == 0.0:  # what presses them is taken out of their arcs, as a contact force would
        if b >= 0:
            stop_pressing(b, a, nx, ny, nz, inverse_mass, freedom, acceleration)
        else:
            stop_pressing(a, b, -nx, -ny, -nz, inverse_mass, freedom, acceleration)
    total, px, py, pz, fx, fy, fz = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    for m in range(n):
        c, j = touching[m], given[m, 0]
        total += j
        at = at_a if a >= 0 else at_b
        px, py, pz = px + j * at[c, 0], py + j * at[c, 1], pz + j * at[c, 2]
        fx, fy, fz = fx + given[m, 1], fy + given[m, 2], fz + given[m, 3]
        impulse[c] += j
        for k in range(3):
            friction_impulse[c, k] += given[m, 1 + k]
    if total > 0.0:
        px, py, pz = px / total, py / total, pz / total
    return speed, total, px, py, pz, fx, fy, fz, bounce == 0.0


@inlined
def rub_point(m, nx, ny, nz, sx, sy, sz, friction, movable, coupling, given):
    """Change the friction ``given`` at point m, which slips at s, so that it holds, within Coulomb's cone.

    Return by how much, and which impulse changes by 1 m/s how fast it slips; 0 where it does not, or locks forbid it.
    """
    along = nx * sx + ny * sy + nz * sz
    sx, sy, sz = sx - along * nx, sy - along * ny, sz - along * nz
    squared = sx * sx + sy * sy + sz * sz
    yields = yields_at(m, sx, sy, sz, coupling)
    if squared <= SOLVED * SOLVED or yields <= IMMOVABLE * movable * squared:
        return 0.0, 0.0, 0.0, 0.0
    ease = squared / yields
    px, py, pz = given[m, 1], given[m, 2], given[m, 3]
    fx, fy, fz = px - ease * sx, py - ease * sy, pz - ease * sz
    size, most = fx * fx + fy * fy + fz * fz, friction * given[m, 0]
    if size > most * most:
        share = most / sqrt(size)
        fx, fy, fz = share * fx, share * fy, share * fz
    given[m, 1], given[m, 2], given[m, 3] = fx, fy, fz
    return fx - px, fy - py, fz - pz, ease


@inlined
def slip_of_pair(c, a, b, at_a, at_b, linear, angular):
    """Return the velocity of b against a at contact c."""
    ax, ay, az = surface_velocity(a, at_a[c, 0], at_a[c, 1], at_a[c, 2], linear, angular)
    bx, by, bz = surface_velocity(b, at_b[c, 0], at_b[c, 1], at_b[c, 2], linear, angular)
    return bx - ax, by - ay, bz - az


@inlined
def push_pair(
    c, a, b, jx, jy, jz, at_a, at_b,
    linear, angular, inverse_mass, inverse_inertia, principal, freedom, rotation,
):  # fmt: skip
    """Apply an impulse on b at contact c, and its reaction on a."""
    push_at(
        a, -1.0, jx, jy, jz, at_a[c, 0], at_a[c, 1], at_a[c, 2],
        linear, angular, inverse_mass, inverse_inertia, principal, freedom, rotation,
    )  # fmt: skip
    push_at(
        b, 1.0, jx, jy, jz, at_b[c, 0], at_b[c, 1], at_b[c, 2],
        linear, angular, inverse_mass, inverse_inertia, principal, freedom, rotation,
    )  # fmt: skip
