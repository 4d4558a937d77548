"""Where balls touch each other, in the contact table: the resting stage knows it in lanes only."""

from __future__ import annotations

from math import sqrt

# mypy: disable-error-code="no-untyped-def"
from carom.systems.kernels.balls import BALL
from carom.systems.kernels.crew import part_of, shared


@shared("normal", "depth", "point", "offset_a", "offset_b")
def write_touches(
    crew, count, kind, sign, radius, extent, body_a, body_b, inverse_mass, center,
    normal, depth, point, offset_a, offset_b,
):  # fmt: skip
    """Measure the contacts of balls that both can move where they are now, as `measure_balls_in_lanes` does."""
    begin, end = part_of(crew, count)
    for c in range(begin, end):
        a, b = body_a[c], body_b[c]
        if kind[c] != BALL or a < 0 or b < 0 or inverse_mass[a] == 0.0 or inverse_mass[b] == 0.0:
            continue
        of_a, of_b = (radius[c], extent[c, 0]) if sign[c] > 0.0 else (extent[c, 0], radius[c])
        x, y, z = center[b, 0] - center[a, 0], center[b, 1] - center[a, 1], center[b, 2] - center[a, 2]
        distance = sqrt(x * x + y * y + z * z)
        if distance > 0.0:
            inverse = 1.0 / distance
            x, y, z = x * inverse, y * inverse, z * inverse
        else:
            x, y, z = 0.0, -1.0, 0.0  # concentric: any direction parts them
        depth[c] = of_a + of_b - distance
        to_middle = of_a - 0.5 * depth[c]
        normal[c, 0], normal[c, 1], normal[c, 2] = x, y, z
        offset_a[c, 0], offset_a[c, 1], offset_a[c, 2] = of_a * x, of_a * y, of_a * z
        offset_b[c, 0], offset_b[c, 1], offset_b[c, 2] = -of_b * x, -of_b * y, -of_b * z
        point[c, 0] = center[a, 0] + to_middle * x
        point[c, 1] = center[a, 1] + to_middle * y
        point[c, 2] = center[a, 2] + to_middle * z
