"""The resting stage: impulses that hold contacts, by soft steps over manifolds."""

from __future__ import annotations

from math import sqrt

# mypy: disable-error-code="no-untyped-def"
from carom.systems.constants import POINT_SWEEPS, PUSH_SPEED, RELAX_SWEEPS, ROLL_SWEEPS, ROLLED
from carom.systems.kernels.kernel import inlined, kernel, woven
from carom.systems.kernels.manifolds import (
    AWAY,
    GIVE,
    LEVER_A,
    LEVER_B,
    MASS,
    MIDDLE_A,
    MIDDLE_B,
    ROLL,
    SPIN,
    TANGENT,
    about,
)  # fmt: skip
from carom.systems.kernels.spatial import cross


@kernel("linear", "angular", "warm_normal", "warm_friction", "warm_rolling")
def press_contacts(
    count, h, start, soft, rigid, body_a, body_b, normal, depth, resting, friction, rolling, spinning, surface,
    inverse_mass, spread, known, known_point, linear, angular, warm_normal, warm_friction, warm_rolling,
):  # fmt: skip
    """Apply the impulses of the substep before, then solve every manifold once with its overlap pushed out.

    ``soft`` and ``rigid`` say how contacts of two moving bodies and of one yield (`press_manifold`). Those with
    something that cannot move come last, so that what is under a pile has the last word.
    """
    for m in range(count):
        first, end = start[m], start[m + 1]
        if not resting[first]:
            continue
        a, b = body_a[first], body_b[first]
        nx, ny, nz = normal[first, 0], normal[first, 1], normal[first, 2]
        fx, fy, fz, wx, wy, wz = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
        for c in range(first, end):
            press(c, warm_normal[c], a, b, nx, ny, nz, spread, known_point, linear, angular)
            fx, fy, fz = fx + warm_friction[c, 0], fy + warm_friction[c, 1], fz + warm_friction[c, 2]
            wx, wy, wz = wx + warm_rolling[c, 0], wy + warm_rolling[c, 1], wz + warm_rolling[c, 2]
        rub(m, fx, fy, fz, a, b, spread, known, linear, angular)
        twist(a, -wx, -wy, -wz, spread, angular)
        twist(b, wx, wy, wz, spread, angular)
    for last in (False, True):
        for m in range(count):
            first = start[m]
            a, b = body_a[first], body_b[first]
            if resting[first] and stands(a, b, inverse_mass) == last:
                rate, hardness, give_way = rigid if last else soft
                press_manifold(
                    m, first, start[m + 1], h, rate, hardness, give_way, a, b,
                    normal, depth, friction, rolling, spinning, surface,
                    spread, known, known_point, linear, angular,
                    warm_normal, warm_friction, warm_rolling,
                )  # fmt: skip


@kernel("linear", "angular", "impulse", "friction_impulse", "warm_normal", "warm_friction", "warm_rolling")
def relax_contacts(
    count, h, start, body_a, body_b, normal, depth, resting, friction, rolling, spinning, surface,
    inverse_mass, spread, known, known_point, linear, angular,
    impulse, friction_impulse, warm_normal, warm_friction, warm_rolling,
):  # fmt: skip
    """Take out of the velocities what pushed overlap out, and sum up the impulses."""
    for _ in range(RELAX_SWEEPS):
        for last in (False, True):
            for m in range(count):
                first = start[m]
                a, b = body_a[first], body_b[first]
                if resting[first] and stands(a, b, inverse_mass) == last:
                    press_manifold(
                        m, first, start[m + 1], h, 0.0, 1.0, 0.0, a, b,
                        normal, depth, friction, rolling, spinning, surface,
                        spread, known, known_point, linear, angular,
                        warm_normal, warm_friction, warm_rolling,
                    )  # fmt: skip
    for m in range(count):
        if resting[start[m]]:
            for c in range(start[m], start[m + 1]):
                impulse[c] += warm_normal[c]
                for k in range(3):
                    friction_impulse[c, k] += warm_friction[c, k]


@inlined
def stands(a, b, inverse_mass):
    """Tell whether one of two bodies cannot be moved."""
    return a < 0 or b < 0 or inverse_mass[a] == 0.0 or inverse_mass[b] == 0.0


@woven
def press_manifold(
    m, first, end, h, rate, hardness, give_way, a, b, normal, depth, friction, rolling, spinning, surface,
    spread, known, known_point, linear, angular, warm_normal, warm_friction, warm_rolling,
):  # fmt: skip
    """Solve one manifold once: its points one after the other, then friction, spinning and rolling of all together.

    Overlap leaves at ``rate`` (1/s) times itself. A soft contact is a spring and a damper, stepped implicitly, of which
    ``hardness`` (part of the mass) and ``give_way`` (part of the impulse given up) remain: Catto, Soft Constraints, GDC
    2011, and Solver2D, 2024 (soft step). A gap may close until the end of the substep. Friction that slides twists the
    less: both share one cone (Goyal, Ruina and Papadopoulos, Wear 143, 307, 1991, as an ellipsoid).
    """
    nx, ny, nz = normal[first, 0], normal[first, 1], normal[first, 2]
    for _ in range(POINT_SWEEPS if end - first > 1 else 1):
        for c in range(first, end):
            off = 0.0
            if a >= 0:
                off -= nx * linear[a, 0] + ny * linear[a, 1] + nz * linear[a, 2]
                for k in range(3):
                    off -= known_point[c, LEVER_A + k] * angular[a, k]
            if b >= 0:
                off += nx * linear[b, 0] + ny * linear[b, 1] + nz * linear[b, 2]
                for k in range(3):
                    off += known_point[c, LEVER_B + k] * angular[b, k]
            before, hard, yielding = warm_normal[c], 1.0, 0.0
            if depth[c] < 0.0:
                off -= depth[c] / h
            elif rate > 0.0:
                off -= min(rate * depth[c], PUSH_SPEED)
                hard, yielding = hardness, give_way
            warm_normal[c] = max(0.0, before - hard * known_point[c, MASS] * off - yielding * before)
            press(c, warm_normal[c] - before, a, b, nx, ny, nz, spread, known_point, linear, angular)
    total, twisting = 0.0, 0.0
    px, py, pz, qx, qy, qz = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    for c in range(first, end):
        total += warm_normal[c]
        twisting += warm_normal[c] * known_point[c, AWAY]
        px, py, pz = px + warm_friction[c, 0], py + warm_friction[c, 1], pz + warm_friction[c, 2]
        qx, qy, qz = qx + warm_rolling[c, 0], qy + warm_rolling[c, 1], qz + warm_rolling[c, 2]
    if friction[first] == 0.0 and spinning[first] == 0.0:
        return
    tx, ty, tz = known[m, TANGENT], known[m, TANGENT + 1], known[m, TANGENT + 2]
    ux, uy, uz = known[m, TANGENT + 3], known[m, TANGENT + 4], known[m, TANGENT + 5]
    most = friction[first] * total
    most_twist = friction[first] * twisting
    for _ in range(ROLL_SWEEPS if rolling[first] > 0.0 else 1):
        sx, sy, sz = slip(m, first, a, b, surface, known, linear, angular)
        vt, vu = tx * sx + ty * sy + tz * sz, ux * sx + uy * sy + uz * sz
        ft = tx * px + ty * py + tz * pz - (known[m, GIVE] * vt + known[m, GIVE + 1] * vu)
        fu = ux * px + uy * py + uz * pz - (known[m, GIVE + 1] * vt + known[m, GIVE + 2] * vu)
        size, most_spin = sqrt(ft * ft + fu * fu), spinning[first] * total
        if most_twist > 0.0:
            spin = spin_of_pair(a, b, nx, ny, nz, angular)
            wanted = abs(nx * qx + ny * qy + nz * qz - known[m, SPIN] * spin)
            size = sqrt(size * size + (wanted * most / most_twist) ** 2)
            most_spin += min(most_twist, wanted * most / size) if size > most else most_twist
        slides = size > most
        if slides:
            ft, fu = ft * (most / size), fu * (most / size)
        fx, fy, fz = ft * tx + fu * ux, ft * ty + fu * uy, ft * tz + fu * uz
        rub(m, fx - px, fy - py, fz - pz, a, b, spread, known, linear, angular)
        rubbed = (fx - px) ** 2 + (fy - py) ** 2 + (fz - pz) ** 2
        px, py, pz = fx, fy, fz
        if most_spin == 0.0 and rolling[first] == 0.0:
            break
        sx, sy, sz = 0.0, 0.0, 0.0
        if a >= 0:
            sx, sy, sz = -angular[a, 0], -angular[a, 1], -angular[a, 2]
        if b >= 0:
            sx, sy, sz = sx + angular[b, 0], sy + angular[b, 1], sz + angular[b, 2]
        spin = nx * sx + ny * sy + nz * sz
        along = nx * qx + ny * qy + nz * qz
        wx = qx - along * nx - known[m, ROLL] * (sx - spin * nx)
        wy = qy - along * ny - known[m, ROLL] * (sy - spin * ny)
        wz = qz - along * nz - known[m, ROLL] * (sz - spin * nz)
        size = sqrt(wx * wx + wy * wy + wz * wz)
        most_roll = 0.0 if slides else rolling[first] * total  # what slides does not roll
        if size > most_roll:
            wx, wy, wz = wx * (most_roll / size), wy * (most_roll / size), wz * (most_roll / size)
        along = min(max(along - known[m, SPIN] * spin, -most_spin), most_spin)
        wx, wy, wz = wx + along * nx, wy + along * ny, wz + along * nz
        twist(a, qx - wx, qy - wy, qz - wz, spread, angular)
        twist(b, wx - qx, wy - qy, wz - qz, spread, angular)
        rolled = (wx - qx) ** 2 + (wy - qy) ** 2 + (wz - qz) ** 2
        qx, qy, qz = wx, wy, wz
        if rubbed <= ROLLED * most * most and rolled <= ROLLED * most_roll * most_roll:
            break
    share = 1.0 / (end - first)
    for c in range(first, end):
        warm_friction[c, 0], warm_friction[c, 1], warm_friction[c, 2] = px * share, py * share, pz * share
        warm_rolling[c, 0], warm_rolling[c, 1], warm_rolling[c, 2] = qx * share, qy * share, qz * share


@inlined
def press(c, j, a, b, nx, ny, nz, spread, known_point, linear, angular):
    """Press the bodies of contact c apart along its normal by the impulse j."""
    if a >= 0:
        move(a, -j * nx, -j * ny, -j * nz, spread, linear)
        x, y, z = known_point[c, LEVER_A], known_point[c, LEVER_A + 1], known_point[c, LEVER_A + 2]
        twist(a, -j * x, -j * y, -j * z, spread, angular)
    if b >= 0:
        move(b, j * nx, j * ny, j * nz, spread, linear)
        x, y, z = known_point[c, LEVER_B], known_point[c, LEVER_B + 1], known_point[c, LEVER_B + 2]
        twist(b, j * x, j * y, j * z, spread, angular)


@inlined
def rub(m, jx, jy, jz, a, b, spread, known, linear, angular):
    """Apply an impulse on b, and its reaction on a, at the middle of a manifold."""
    if a >= 0:
        move(a, -jx, -jy, -jz, spread, linear)
        x, y, z = cross(known[m, MIDDLE_A], known[m, MIDDLE_A + 1], known[m, MIDDLE_A + 2], jx, jy, jz)
        twist(a, -x, -y, -z, spread, angular)
    if b >= 0:
        move(b, jx, jy, jz, spread, linear)
        x, y, z = cross(known[m, MIDDLE_B], known[m, MIDDLE_B + 1], known[m, MIDDLE_B + 2], jx, jy, jz)
        twist(b, x, y, z, spread, angular)


@inlined
def slip(m, first, a, b, surface, known, linear, angular):
    """Return the velocity of b's surface against a's at the middle of a manifold."""
    sx, sy, sz = surface[first, 0], surface[first, 1], surface[first, 2]
    if a >= 0:
        x, y, z = cross(
            angular[a, 0], angular[a, 1], angular[a, 2],
            known[m, MIDDLE_A], known[m, MIDDLE_A + 1], known[m, MIDDLE_A + 2],
        )  # fmt: skip
        sx, sy, sz = sx - linear[a, 0] - x, sy - linear[a, 1] - y, sz - linear[a, 2] - z
    if b >= 0:
        x, y, z = cross(
            angular[b, 0], angular[b, 1], angular[b, 2],
            known[m, MIDDLE_B], known[m, MIDDLE_B + 1], known[m, MIDDLE_B + 2],
        )  # fmt: skip
        sx, sy, sz = sx + linear[b, 0] + x, sy + linear[b, 1] + y, sz + linear[b, 2] + z
    return sx, sy, sz


@inlined
def spin_of_pair(a, b, nx, ny, nz, angular):
    """Return how fast b turns against a about the normal."""
    spin = 0.0
    if a >= 0:
        spin -= nx * angular[a, 0] + ny * angular[a, 1] + nz * angular[a, 2]
    if b >= 0:
        spin += nx * angular[b, 0] + ny * angular[b, 1] + nz * angular[b, 2]
    return spin


@inlined
def move(i, jx, jy, jz, spread, linear):
    """Apply an impulse to the centre of body i."""
    linear[i, 0] += spread[i, 0] * jx
    linear[i, 1] += spread[i, 1] * jy
    linear[i, 2] += spread[i, 2] * jz


@inlined
def twist(i, tx, ty, tz, spread, angular):
    """Apply an angular impulse to body i, if it is one."""
    if i >= 0:
        wx, wy, wz = about(i, tx, ty, tz, spread)
        angular[i, 0] += wx
        angular[i, 1] += wy
        angular[i, 2] += wz
