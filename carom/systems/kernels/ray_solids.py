"""Where a line runs within a solid: from where it enters to where it leaves, in the frame of the solid.

Lines are x + s d with d of unit length and s in m, x near the middle of the solid, so that nothing cancels however far
away a ray begins. A line that misses enters at FAR and leaves at -FAR. Solids are closed: they hold their surface.
"""

from __future__ import annotations

from math import sqrt

# mypy: disable-error-code="no-untyped-def"
from carom.systems.kernels.kernel import inlined

FAR = 1e300
SIDE, BOTTOM, TOP = 0, 1, 2  # faces of cylinders and cones


@inlined
def through_ball(radius, x, y, z, dx, dy, dz):
    """Return (enter, leave) of a ball about the origin."""
    s = -(x * dx + y * dy + z * dz)
    x, y, z = x + s * dx, y + s * dy, z + s * dz
    rest = radius * radius - (x * x + y * y + z * z)
    if rest < 0.0:
        return FAR, -FAR
    return s - sqrt(rest), s + sqrt(rest)


@inlined
def through_slab(half, x, dx):
    """Return (enter, leave) of all that is no farther than ``half`` from 0 along one axis."""
    if dx == 0.0:
        return (-FAR, FAR) if abs(x) <= half else (FAR, -FAR)
    one, other = (-half - x) / dx, (half - x) / dx
    return min(one, other), max(one, other)


@inlined
def through_box(hx, hy, hz, x, y, z, dx, dy, dz):
    """Return (enter, leave, face) of a box; faces are -x, +x, -y, +y, -z, +z."""
    enter, leave = through_slab(hx, x, dx)
    face = 1 if dx < 0.0 else 0
    first, last = through_slab(hy, y, dy)
    if first > enter:
        enter, face = first, 3 if dy < 0.0 else 2
    leave = min(leave, last)
    first, last = through_slab(hz, z, dz)
    if first > enter:
        enter, face = first, 5 if dz < 0.0 else 4
    return enter, min(leave, last), face


@inlined
def through_tube(radius, x, z, dx, dz):
    """Return (enter, leave) of an endless cylinder about y."""
    a = dx * dx + dz * dz
    if a == 0.0:
        return (-FAR, FAR) if x * x + z * z <= radius * radius else (FAR, -FAR)
    s = -(x * dx + z * dz) / a
    x, z = x + s * dx, z + s * dz
    rest = radius * radius - (x * x + z * z)
    if rest < 0.0:
        return FAR, -FAR
    half = sqrt(rest / a)
    return s - half, s + half


@inlined
def through_cylinder(radius, half, x, y, z, dx, dy, dz):
    """Return (enter, leave, face) of a cylinder."""
    enter, leave = through_tube(radius, x, z, dx, dz)
    first, last = through_slab(half, y, dy)
    if first > enter:
        return first, min(leave, last), TOP if dy < 0.0 else BOTTOM
    return enter, min(leave, last), SIDE


@inlined
def through_capsule(radius, half, x, y, z, dx, dy, dz):
    """Return (enter, leave) of a capsule: of its cylinder and the balls at its ends, which lie along a line as one."""
    enter, leave, _ = through_cylinder(radius, half, x, y, z, dx, dy, dz)
    if enter > leave:
        enter, leave = FAR, -FAR
    for end in (-half, half):
        first, last = through_ball(radius, x, y - end, z, dx, dy, dz)
        enter, leave = min(enter, first), max(leave, last)
    return enter, leave


@inlined
def through_cone(radius, half, x, y, z, dx, dy, dz):
    """Return (enter, leave, face) of a cone, apex up.

    Both halves of the double cone are where a s^2 + 2 b s + c is at most 0; the slab between base and apex holds no
    part of the other half. Roots come without cancellation (Press et al., Numerical Recipes, 5.6).
    """
    slope = radius / (2.0 * half)
    up, rise = slope * (half - y), -slope * dy
    a = dx * dx + dz * dz - rise * rise
    b = x * dx + z * dz - up * rise
    c = x * x + z * z - up * up
    rest = b * b - a * c
    first, last = through_slab(half, y, dy)
    face = TOP if dy < 0.0 else BOTTOM
    enter, leave = -FAR, FAR
    if a == 0.0:
        if b == 0.0:
            enter, leave = (-FAR, FAR) if c <= 0.0 else (FAR, -FAR)
        elif b > 0.0:
            leave = -0.5 * c / b
        else:
            enter = -0.5 * c / b
    elif a > 0.0 and rest < 0.0:
        return FAR, -FAR, SIDE
    else:
        q = -(b + sqrt(max(rest, 0.0))) if b > 0.0 else sqrt(max(rest, 0.0)) - b
        one, other = q / a, c / q if q != 0.0 else 0.0
        if a > 0.0:
            enter, leave = min(one, other), max(one, other)
        elif dy > 0.0:
            leave = min(one, other)
        else:
            enter = max(one, other)
    if first > enter:
        return first, min(leave, last), face
    return enter, min(leave, last), SIDE


@inlined
def through_ellipsoid(a, b, c, x, y, z, dx, dy, dz):
    """Return (enter, leave) of an ellipsoid: the unit ball's in the frame in which it is one."""
    x, y, z, dx, dy, dz = x / a, y / b, z / c, dx / a, dy / b, dz / c
    stretch = sqrt(dx * dx + dy * dy + dz * dz)
    enter, leave = through_ball(1.0, x, y, z, dx / stretch, dy / stretch, dz / stretch)
    if enter > leave:
        return FAR, -FAR
    return enter / stretch, leave / stretch


@inlined
def through_half_space(nx, ny, nz, offset, x, y, z, dx, dy, dz):
    """Return (enter, leave) of a half space."""
    height, rise = nx * x + ny * y + nz * z - offset, nx * dx + ny * dy + nz * dz
    if rise == 0.0:
        return (-FAR, FAR) if height <= 0.0 else (FAR, -FAR)
    return (-height / rise, FAR) if rise < 0.0 else (-FAR, -height / rise)
