"""Vectors and quaternions as loose numbers, for loops that go point by point; kernels compile these as they stand."""

Vector = tuple[float, float, float]


def cross(ax: float, ay: float, az: float, bx: float, by: float, bz: float) -> Vector:
    """Return a x b."""
    return ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx


def turn(qx: float, qy: float, qz: float, qw: float, x: float, y: float, z: float) -> Vector:
    """Return the vector turned by the quaternion."""
    tx, ty, tz = 2.0 * (qy * z - qz * y), 2.0 * (qz * x - qx * z), 2.0 * (qx * y - qy * x)
    return x + qw * tx + qy * tz - qz * ty, y + qw * ty + qz * tx - qx * tz, z + qw * tz + qx * ty - qy * tx


def product(
    ax: float, ay: float, az: float, aw: float, bx: float, by: float, bz: float, bw: float
) -> tuple[float, float, float, float]:
    """Return the quaternion of the rotation b followed by a."""
    return (
        aw * bx + ax * bw + ay * bz - az * by,
        aw * by - ax * bz + ay * bw + az * bx,
        aw * bz + ax * by - ay * bx + az * bw,
        aw * bw - ax * bx - ay * by - az * bz,
    )
