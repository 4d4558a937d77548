"""The resting stage: the impulses that hold resting contacts, and the arcs that follow from them."""

from __future__ import annotations

from math import sqrt

import numpy as np

# mypy: disable-error-code="no-untyped-def"
from carom.systems.constants import APPROACH, REST_SPEED_FACTOR, SOLVED, SWEEPS
from carom.systems.kernels.bodies import push_at, surface_velocity, turn_at, yielding
from carom.systems.kernels.kernel import inlined, kernel
from carom.systems.kernels.spatial import cross


@kernel(
    "linear", "angular", "acceleration", "angular_acceleration", "touching",
    "blow", "impulse", "friction_impulse", "warm_normal", "warm_friction", "warm_rolling",
)  # fmt: skip
def hold_contacts(
    count, h, rest_pull, bends, body_a, body_b, normal, depth, offset_a, offset_b, kind, resting,
    friction, restitution, rolling, spinning,
    inverse_mass, inverse_inertia, principal, rotation, start_linear, start_angular,
    linear, angular, acceleration, angular_acceleration, touching,
    blow, impulse, friction_impulse, warm_normal, warm_friction, warm_rolling,
):  # fmt: skip
    """Find impulses by which resting contacts do not close, stick or slide within the cone, and roll with resistance.

    Projected Gauss-Seidel over accumulated impulses with warm starts (Catto, Iterative Dynamics with Temporal
    Coherence, 2005); friction is a disc, not a pyramid. Shapes without exact impacts bounce here: what closes faster
    than the rest speed at the start of the substep is given back times the restitution. Returns how many did. With
    ``bends`` the arcs of balls follow (`bend_arcs`).
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
    blows = 0
    for m in range(n):
        c = members[m]
        impulse[c] += warm_normal[c]
        for k in range(3):
            friction_impulse[c, k] += warm_friction[c, k]
        if warm_normal[c] == 0.0:
            blow[c] = 0.0
        elif blow[c] > 0.0:
            blows += 1
    if bends:
        bend_arcs(
            count, h, body_a, body_b, normal, kind, resting, touching, start_linear, start_angular,
            linear, angular, acceleration, angular_acceleration,
        )  # fmt: skip
    return blows


@inlined
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
