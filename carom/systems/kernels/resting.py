"""The resting stage: which contacts rest in this substep, and the impulses that hold them."""

from __future__ import annotations

from math import sqrt

import numpy as np

# mypy: disable-error-code="no-untyped-def"
from carom.systems.constants import APPROACH, PUSH_OUT, REST_SPEED_FACTOR, SLOP, SOLVED, SWEEPS, TOUCH
from carom.systems.kernels.balls import gap_of_ball
from carom.systems.kernels.bodies import push_at, surface_velocity, turn_at, yielding
from carom.systems.kernels.kernel import kernel
from carom.systems.kernels.spatial import cross, turn


@kernel(
    "normal", "depth", "point", "offset_a", "offset_b", "resting", "touching",
    "warm_normal", "warm_friction", "warm_rolling",
)  # fmt: skip
def sort_contacts(
    count, h, resting_stage, center, rotation, linear, angular, felt,
    kind, ball, other, sign, radius, extent, other_position, other_rotation, body_a, body_b,
    normal, depth, point, offset_a, offset_b, resting, touching, warm_normal, warm_friction, warm_rolling,
):  # fmt: skip
    """Say which contacts rest, from where their bodies are at the start of the substep, and mark those bodies.

    A ball's pair is measured anew. It rests when it touches, closes no faster than the rest speed and would not be clear
    of the other at the end of the substep. Any other shape's contact takes part once it would close within the substep.
    """
    for c in range(count):
        if kind[c] >= 0:
            i, o = ball[c], other[c]
            ox, oy, oz = other_position[c, 0], other_position[c, 1], other_position[c, 2]
            qx, qy, qz, qw = other_rotation[c, 0], other_rotation[c, 1], other_rotation[c, 2], other_rotation[c, 3]
            if o >= 0:
                ox, oy, oz = center[o, 0], center[o, 1], center[o, 2]
                qx, qy, qz, qw = rotation[o, 0], rotation[o, 1], rotation[o, 2], rotation[o, 3]
            gap, nx, ny, nz = gap_of_ball(
                kind[c], center[i, 0], center[i, 1], center[i, 2], radius[c], ox, oy, oz, qx, qy, qz, qw,
                extent[c, 0], extent[c, 1], extent[c, 2],
            )  # fmt: skip
            depth[c] = -gap
            lever = radius[c] + 0.5 * gap
            for k, n in enumerate((nx, ny, nz)):
                normal[c, k] = -sign[c] * n
                point[c, k] = center[i, k] - lever * n
                to_ball = -lever * n
                to_other = point[c, k] - (center[o, k] if o >= 0 else other_position[c, k])
                offset_a[c, k] = to_ball if sign[c] > 0.0 else to_other
                offset_b[c, k] = to_other if sign[c] > 0.0 else to_ball
        a, b = body_a[c], body_b[c]
        nx, ny, nz = normal[c, 0], normal[c, 1], normal[c, 2]
        ax, ay, az = surface_velocity(a, offset_a[c, 0], offset_a[c, 1], offset_a[c, 2], linear, angular)
        bx, by, bz = surface_velocity(b, offset_b[c, 0], offset_b[c, 1], offset_b[c, 2], linear, angular)
        parting = nx * (bx - ax) + ny * (by - ay) + nz * (bz - az)
        pulling = 0.0
        for k, n in enumerate((nx, ny, nz)):
            pulling += n * ((felt[b, k] if b >= 0 else 0.0) - (felt[a, k] if a >= 0 else 0.0))
        gap = -depth[c]
        after = gap + parting * h + 0.5 * pulling * h * h
        if kind[c] >= 0:
            rests = gap <= TOUCH and -parting <= max(APPROACH, REST_SPEED_FACTOR * -pulling * h) and after <= 0.0
        else:
            rests = gap <= SLOP and after <= SLOP or after <= 0.0
        resting[c] = rests and resting_stage
        if resting[c]:
            if a >= 0:
                touching[a] = True
            if b >= 0:
                touching[b] = True
        else:
            warm_normal[c] = 0.0
            for k in range(3):
                warm_friction[c, k] = 0.0
                warm_rolling[c, k] = 0.0


@kernel(
    "linear", "angular", "blow", "impulse", "friction_impulse", "warm_normal", "warm_friction", "warm_rolling",
)  # fmt: skip
def hold_contacts(
    count, h, rest_pull, body_a, body_b, normal, depth, offset_a, offset_b, kind, resting,
    friction, restitution, rolling, spinning,
    inverse_mass, inverse_inertia, principal, rotation, start_linear, start_angular,
    linear, angular, blow, impulse, friction_impulse, warm_normal, warm_friction, warm_rolling,
):  # fmt: skip
    """Find impulses by which resting contacts do not close, stick or slide within the cone, and roll with resistance.

    Projected Gauss-Seidel over accumulated impulses with warm starts (Catto, Iterative Dynamics with Temporal Coherence,
    2005); friction is a disc, not a pyramid. Shapes without exact impacts bounce here: the part of the velocity at the
    start of the substep that closes faster than the rest speed is given back times the restitution.
    """
    members = np.nonzero(resting[:count])[0]
    n = len(members)
    tangent = np.empty((n, 6))
    give = np.empty((n, 5))  # 1/K of the normal, K of the two tangents (3), wanted parting speed
    for m in range(n):
        c = members[m]
        a, b = body_a[c], body_b[c]
        nx, ny, nz = normal[c, 0], normal[c, 1], normal[c, 2]
        rax, ray, raz = offset_a[c, 0], offset_a[c, 1], offset_a[c, 2]
        rbx, rby, rbz = offset_b[c, 0], offset_b[c, 1], offset_b[c, 2]
        if abs(nx) < 0.6:
            tx, ty, tz = cross(nx, ny, nz, 1.0, 0.0, 0.0)
        else:
            tx, ty, tz = cross(nx, ny, nz, 0.0, 1.0, 0.0)
        inverse = 1.0 / sqrt(tx * tx + ty * ty + tz * tz)
        tx, ty, tz = tx * inverse, ty * inverse, tz * inverse
        ux, uy, uz = cross(nx, ny, nz, tx, ty, tz)
        tangent[m, 0], tangent[m, 1], tangent[m, 2] = tx, ty, tz
        tangent[m, 3], tangent[m, 4], tangent[m, 5] = ux, uy, uz
        knn, ktt, ktu, kuu = 0.0, 0.0, 0.0, 0.0
        for body, rx, ry, rz in ((a, rax, ray, raz), (b, rbx, rby, rbz)):
            knn += yielding(
                body, nx, ny, nz, nx, ny, nz, rx, ry, rz, inverse_mass, inverse_inertia, principal, rotation
            )
            ktt += yielding(
                body, tx, ty, tz, tx, ty, tz, rx, ry, rz, inverse_mass, inverse_inertia, principal, rotation
            )
            ktu += yielding(
                body, tx, ty, tz, ux, uy, uz, rx, ry, rz, inverse_mass, inverse_inertia, principal, rotation
            )
            kuu += yielding(
                body, ux, uy, uz, ux, uy, uz, rx, ry, rz, inverse_mass, inverse_inertia, principal, rotation
            )
        determinant = ktt * kuu - ktu * ktu
        give[m, 0] = 1.0 / knn if knn > 0.0 else 0.0
        give[m, 1], give[m, 2], give[m, 3] = kuu / determinant, -ktu / determinant, ktt / determinant
        wanted = depth[c] / h if depth[c] < 0.0 else 0.0
        blow[c] = 0.0
        if kind[c] < 0:
            ax, ay, az = surface_velocity(a, rax, ray, raz, start_linear, start_angular)
            bx, by, bz = surface_velocity(b, rbx, rby, rbz, start_linear, start_angular)
            closing = -(nx * (bx - ax) + ny * (by - ay) + nz * (bz - az))
            if closing > REST_SPEED_FACTOR * rest_pull * h + APPROACH:
                blow[c] = closing
                if restitution[c] > 0.0:
                    wanted = restitution[c] * closing
        give[m, 4] = wanted
        j = warm_normal[c]
        jx, jy, jz = j * nx + warm_friction[c, 0], j * ny + warm_friction[c, 1], j * nz + warm_friction[c, 2]
        push_at(a, -1.0, jx, jy, jz, rax, ray, raz, linear, angular, inverse_mass, inverse_inertia, principal, rotation)
        push_at(b, 1.0, jx, jy, jz, rbx, rby, rbz, linear, angular, inverse_mass, inverse_inertia, principal, rotation)
        wx, wy, wz = warm_rolling[c, 0], warm_rolling[c, 1], warm_rolling[c, 2]
        turn_at(a, -1.0, wx, wy, wz, angular, inverse_inertia, principal, rotation)
        turn_at(b, 1.0, wx, wy, wz, angular, inverse_inertia, principal, rotation)

    for _ in range(SWEEPS):
        change = 0.0
        for m in range(n):
            c = members[m]
            a, b = body_a[c], body_b[c]
            nx, ny, nz = normal[c, 0], normal[c, 1], normal[c, 2]
            rax, ray, raz = offset_a[c, 0], offset_a[c, 1], offset_a[c, 2]
            rbx, rby, rbz = offset_b[c, 0], offset_b[c, 1], offset_b[c, 2]
            ax, ay, az = surface_velocity(a, rax, ray, raz, linear, angular)
            bx, by, bz = surface_velocity(b, rbx, rby, rbz, linear, angular)
            off = nx * (bx - ax) + ny * (by - ay) + nz * (bz - az) - give[m, 4]
            before = warm_normal[c]
            warm_normal[c] = max(0.0, before - give[m, 0] * off)
            j = warm_normal[c] - before
            if give[m, 0] > 0.0:
                change = max(change, abs(j) / give[m, 0])
            jx, jy, jz = j * nx, j * ny, j * nz
            push_at(
                a, -1.0, jx, jy, jz, rax, ray, raz, linear, angular, inverse_mass, inverse_inertia, principal, rotation
            )
            push_at(
                b, 1.0, jx, jy, jz, rbx, rby, rbz, linear, angular, inverse_mass, inverse_inertia, principal, rotation
            )
            most = friction[c] * warm_normal[c]
            slides = True
            if friction[c] > 0.0:
                ax, ay, az = surface_velocity(a, rax, ray, raz, linear, angular)
                bx, by, bz = surface_velocity(b, rbx, rby, rbz, linear, angular)
                sx, sy, sz = bx - ax, by - ay, bz - az
                tx, ty, tz = tangent[m, 0], tangent[m, 1], tangent[m, 2]
                ux, uy, uz = tangent[m, 3], tangent[m, 4], tangent[m, 5]
                vt, vu = tx * sx + ty * sy + tz * sz, ux * sx + uy * sy + uz * sz
                px, py, pz = warm_friction[c, 0], warm_friction[c, 1], warm_friction[c, 2]
                ft = tx * px + ty * py + tz * pz - (give[m, 1] * vt + give[m, 2] * vu)
                fu = ux * px + uy * py + uz * pz - (give[m, 2] * vt + give[m, 3] * vu)
                size = sqrt(ft * ft + fu * fu)
                slides = size > most
                if slides:
                    ft, fu = ft * (most / size), fu * (most / size)
                fx, fy, fz = ft * tx + fu * ux, ft * ty + fu * uy, ft * tz + fu * uz
                jx, jy, jz = fx - px, fy - py, fz - pz
                warm_friction[c, 0], warm_friction[c, 1], warm_friction[c, 2] = fx, fy, fz
                change = max(change, sqrt(jx * jx + jy * jy + jz * jz) / max(give[m, 1], give[m, 3]))
                push_at(
                    a, -1.0, jx, jy, jz, rax, ray, raz,
                    linear, angular, inverse_mass, inverse_inertia, principal, rotation,
                )  # fmt: skip
                push_at(
                    b, 1.0, jx, jy, jz, rbx, rby, rbz,
                    linear, angular, inverse_mass, inverse_inertia, principal, rotation,
                )  # fmt: skip
            if rolling[c] > 0.0 or spinning[c] > 0.0:
                sx, sy, sz = 0.0, 0.0, 0.0
                ease, lever = 0.0, 0.0
                for body, sense, rx, ry, rz in ((a, -1.0, rax, ray, raz), (b, 1.0, rbx, rby, rbz)):
                    if body >= 0:
                        sx, sy, sz = (
                            sx + sense * angular[body, 0],
                            sy + sense * angular[body, 1],
                            sz + sense * angular[body, 2],
                        )
                        ease += max(inverse_inertia[body, 0], inverse_inertia[body, 1], inverse_inertia[body, 2])
                        lever += rx * rx + ry * ry + rz * rz
                px, py, pz = warm_rolling[c, 0], warm_rolling[c, 1], warm_rolling[c, 2]
                jx, jy, jz = px - sx / ease, py - sy / ease, pz - sz / ease
                along = nx * jx + ny * jy + nz * jz
                jx, jy, jz = jx - along * nx, jy - along * ny, jz - along * nz
                size = sqrt(jx * jx + jy * jy + jz * jz)
                most = 0.0 if slides else rolling[c] * warm_normal[c]  # what slides does not roll
                if size > most:
                    jx, jy, jz = jx * (most / size), jy * (most / size), jz * (most / size)
                most = spinning[c] * warm_normal[c]
                along = min(max(along, -most), most)
                jx, jy, jz = jx + along * nx, jy + along * ny, jz + along * nz
                warm_rolling[c, 0], warm_rolling[c, 1], warm_rolling[c, 2] = jx, jy, jz
                jx, jy, jz = jx - px, jy - py, jz - pz
                change = max(change, sqrt((jx * jx + jy * jy + jz * jz) * lever) * ease)
                turn_at(a, -1.0, jx, jy, jz, angular, inverse_inertia, principal, rotation)
                turn_at(b, 1.0, jx, jy, jz, angular, inverse_inertia, principal, rotation)
        if change <= SOLVED:
            break
    for m in range(n):
        c = members[m]
        impulse[c] += warm_normal[c]
        for k in range(3):
            friction_impulse[c, k] += warm_friction[c, k]


@kernel("linear", "angular", "acceleration", "angular_acceleration", "touching")
def bend_arcs(
    count, h, body_a, body_b, normal, kind, resting, touching, start_linear, start_angular,
    linear, angular, acceleration, angular_acceleration,
):  # fmt: skip
    """Let balls that only rest on others fly the substep at constant acceleration instead of at their last velocity.

    What friction and rolling resistance took is spread over the substep, which makes sliding and rolling exact between
    changes of state, and speeds right at impacts in between. Along the contact normals the velocity stays the last one.
    """
    for c in range(count):
        if resting[c] and kind[c] < 0:
            for body in (body_a[c], body_b[c]):
                if body >= 0:
                    touching[body] = False
    for c in range(count):
        if not resting[c]:
            continue
        for body in (body_a[c], body_b[c]):
            if body >= 0 and touching[body]:
                for k in range(3):
                    acceleration[body, k] = (linear[body, k] - start_linear[body, k]) / h
                    angular_acceleration[body, k] = (angular[body, k] - start_angular[body, k]) / h
    for c in range(count):
        if not resting[c]:
            continue
        for body in (body_a[c], body_b[c]):
            if body >= 0 and touching[body]:
                along = 0.0
                for k in range(3):
                    along += normal[c, k] * acceleration[body, k]
                for k in range(3):
                    acceleration[body, k] -= along * normal[c, k]
    for c in range(count):
        if not resting[c]:
            continue
        for body in (body_a[c], body_b[c]):
            if body >= 0 and touching[body]:
                touching[body] = False  # each body once
                for k in range(3):
                    linear[body, k] -= h * acceleration[body, k]
                    angular[body, k] -= h * angular_acceleration[body, k]


@kernel("linear", "angular", "position", "center", "depth")
def finish_drift(
    rows, count, h, ended, center_of_mass, inverse_mass, decay, angular_decay, flow, rotation,
    body_a, body_b, normal, offset_a, offset_b, kind, resting, start_center,
    linear, angular, position, center, depth,
):  # fmt: skip
    """End the substep: the second half of drag, overlap pushed out without adding velocity, and the origins placed."""
    for c in range(count):
        a, b = body_a[c], body_b[c]
        if kind[c] < 0:
            ax, ay, az, bx, by, bz = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
            if a >= 0:
                ax, ay, az = cross(
                    angular[a, 0], angular[a, 1], angular[a, 2], offset_a[c, 0], offset_a[c, 1], offset_a[c, 2]
                )
                ax += (center[a, 0] - start_center[a, 0]) / h
                ay += (center[a, 1] - start_center[a, 1]) / h
                az += (center[a, 2] - start_center[a, 2]) / h
            if b >= 0:
                bx, by, bz = cross(
                    angular[b, 0], angular[b, 1], angular[b, 2], offset_b[c, 0], offset_b[c, 1], offset_b[c, 2]
                )
                bx += (center[b, 0] - start_center[b, 0]) / h
                by += (center[b, 1] - start_center[b, 1]) / h
                bz += (center[b, 2] - start_center[b, 2]) / h
            depth[c] -= h * (normal[c, 0] * (bx - ax) + normal[c, 1] * (by - ay) + normal[c, 2] * (bz - az))
    for c in range(count):
        if resting[c] and depth[c] > SLOP:
            a, b = body_a[c], body_b[c]
            total = (inverse_mass[a] if a >= 0 else 0.0) + (inverse_mass[b] if b >= 0 else 0.0)
            if total > 0.0:
                share = PUSH_OUT * (depth[c] - SLOP) / total
                for k in range(3):
                    if a >= 0:
                        center[a, k] -= share * inverse_mass[a] * normal[c, k]
                    if b >= 0:
                        center[b, k] += share * inverse_mass[b] * normal[c, k]
                depth[c] -= PUSH_OUT * (depth[c] - SLOP)
    for i in rows:
        qx, qy, qz, qw = rotation[i, 0], rotation[i, 1], rotation[i, 2], rotation[i, 3]
        cx, cy, cz = center_of_mass[i, 0], center_of_mass[i, 1], center_of_mass[i, 2]
        x, y, z = turn(qx, qy, qz, qw, cx, cy, cz)
        position[i, 0], position[i, 1], position[i, 2] = center[i, 0] - x, center[i, 1] - y, center[i, 2] - z
        for k in range(3):
            if ended and decay[i] != 1.0:
                linear[i, k] = flow[i, k] + (linear[i, k] - flow[i, k]) * decay[i]
            if ended:
                angular[i, k] *= angular_decay[i]
