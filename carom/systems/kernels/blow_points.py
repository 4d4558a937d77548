"""Where the points of a manifold are as its bodies go on and turn, and how deep."""

from __future__ import annotations

# mypy: disable-error-code="no-untyped-def"
from carom.systems.kernels.cores import CONE_SHAPE, CYLINDER_SHAPE, ELLIPSOID_SHAPE
from carom.systems.kernels.frames import turned as out_of_frame
from carom.systems.kernels.frames import turned_back
from carom.systems.kernels.kernel import inlined, woven
from carom.systems.kernels.shares import shows_face
from carom.systems.kernels.spatial import cross


@inlined
def place_points(
    first, end, a, b, row_a, row_b, shape, bound_radius, normal, depth, point, offset_a, offset_b, share,
    start_center, rotation, turned, detected_rotation, at_a, at_b, deep,
):  # fmt: skip
    """Write where the points of a manifold were at the start of the substep from the centres of both bodies, how deep.

    They have turned with these since they were found (``offset``); one of what stands has stayed where it was.
    """
    for c in range(first, end):
        for i, other, row, outward, offset, at in (
            (a, b, row_a[c], 1.0, offset_a, at_a), (b, a, row_b[c], -1.0, offset_b, at_b),
        ):  # fmt: skip
            x, y, z = offset[c, 0], offset[c, 1], offset[c, 2]
            if i < 0:
                pass
            elif other < 0 and shows_face(c, outward, share):  # a corner of what stands
                x, y, z = aside(
                    c, normal, x, y, z, point[c, 0] - start_center[i, 0] - x, point[c, 1] - start_center[i, 1] - y,
                    point[c, 2] - start_center[i, 2] - z,
                )  # fmt: skip
            elif not is_smooth(row, shape) or shows_face(c, outward, share):
                rx, ry, rz = round_of(c, row, outward, normal, bound_radius)
                x, y, z = on_core(c, i, offset, rx, ry, rz, detected_rotation, rotation)
                tx, ty, tz = cross(turned[i, 0], turned[i, 1], turned[i, 2], x, y, z)
                x, y, z = x - tx + rx, y - ty + ry, z - tz + rz
            at[c, 0], at[c, 1], at[c, 2] = x, y, z
        deep[c] = depth[c]


@inlined
def on_core(c, i, offset, rx, ry, rz, detected_rotation, rotation):
    """Return where contact c is on the core of body i from its centre, by r within the surface: it turns with that."""
    x, y, z = turned_back(detected_rotation, i, offset[c, 0] - rx, offset[c, 1] - ry, offset[c, 2] - rz)
    return out_of_frame(rotation, i, x, y, z)


@woven
def is_smooth(row, shape):
    """Tell whether a collider turns beneath the points at which it touches."""
    return shape[row] == CYLINDER_SHAPE or shape[row] == CONE_SHAPE or shape[row] == ELLIPSOID_SHAPE


@woven
def round_of(c, row, outward, normal, bound_radius):
    """Return the way from the core of a collider, which turns, out to contact c."""
    around = outward * bound_radius[row]
    return around * normal[c, 0], around * normal[c, 1], around * normal[c, 2]


@woven
def aside(c, normal, x, y, z, dx, dy, dz):
    """Return a place moved by d, but for what is along the normal of contact c."""
    along = normal[c, 0] * dx + normal[c, 1] * dy + normal[c, 2] * dz
    return x + dx - along * normal[c, 0], y + dy - along * normal[c, 1], z + dz - along * normal[c, 2]


@inlined
def depth_now(c, a, b, normal, deep, at_a, at_b, start_center, center, turned):
    """Return the depth of contact c where its bodies are now; ``deep`` is that at the start of the substep.

    Its point goes with both bodies, to first order of their turn: what a corner rises by in turning is the second.
    """
    moved = 0.0
    if a >= 0:
        x, y, z = cross(turned[a, 0], turned[a, 1], turned[a, 2], at_a[c, 0], at_a[c, 1], at_a[c, 2])
        for k, turn in enumerate((x, y, z)):
            moved += normal[c, k] * (center[a, k] - start_center[a, k] + turn)
    if b >= 0:
        x, y, z = cross(turned[b, 0], turned[b, 1], turned[b, 2], at_b[c, 0], at_b[c, 1], at_b[c, 2])
        for k, turn in enumerate((x, y, z)):
            moved -= normal[c, k] * (center[b, k] - start_center[b, k] + turn)
    return deep[c] + moved


@inlined
def meet(
    c, a, b, row_a, row_b, shape, bound_radius, normal, offset_a, offset_b, deep, at_a, at_b, start_center, center,
    turned, detected_rotation, rotation, share,
):  # fmt: skip
    """Bring the point of a contact of two bodies to where it is now, so that both are struck at one place.

    A corner carries it along the face it glides over, an edge that crosses another half the way of each.
    """
    before = depth_now(c, a, b, normal, deep, at_a, at_b, start_center, center, turned)
    ax, ay, az = carried(
        c, a, b, row_a[c], 1.0, shape, bound_radius, normal, offset_a, at_a, start_center, center, detected_rotation,
        rotation, share,
    )  # fmt: skip
    bx, by, bz = carried(
        c, b, a, row_b[c], -1.0, shape, bound_radius, normal, offset_b, at_b, start_center, center, detected_rotation,
        rotation, share,
    )  # fmt: skip
    part = share[c] if a >= 0 and b >= 0 else 1.0 if a < 0 else 0.0
    x, y, z = ax + part * (bx - ax), ay + part * (by - ay), az + part * (bz - az)
    for i, at in ((a, at_a), (b, at_b)):
        for k, place in enumerate((x, y, z)):
            at[c, k] = place - (center[i, k] if i >= 0 else 0.0)
    deep[c] += before - depth_now(c, a, b, normal, deep, at_a, at_b, start_center, center, turned)


@inlined
def carried(
    c, i, other, row, outward, shape, bound_radius, normal, offset, at, start_center, center, detected_rotation,
    rotation, share,
):  # fmt: skip
    """Return where the point of contact c is that goes with body i; what stands keeps its own."""
    x, y, z = at[c, 0], at[c, 1], at[c, 2]
    if i < 0:
        return x, y, z
    if other < 0 and shows_face(c, outward, share):  # a corner of what stands
        x, y, z = aside(
            c, normal, x, y, z, start_center[i, 0] - center[i, 0], start_center[i, 1] - center[i, 1],
            start_center[i, 2] - center[i, 2],
        )  # fmt: skip
    elif not is_smooth(row, shape) or shows_face(c, outward, share):
        rx, ry, rz = round_of(c, row, outward, normal, bound_radius)
        x, y, z = on_core(c, i, offset, rx, ry, rz, detected_rotation, rotation)
        x, y, z = x + rx, y + ry, z + rz
    return x + center[i, 0], y + center[i, 1], z + center[i, 2]
