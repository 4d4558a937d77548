"""Births of particles: random numbers by counting, and where and how fast each begins."""

from __future__ import annotations

from math import pi, sqrt

# mypy: disable-error-code="no-untyped-def,no-untyped-call"
from carom.ecs.components.emitter import Source
from carom.systems.kernels.kernel import inlined, kernel
from carom.systems.kernels.spatial import across, cross, sine_cosine, turn

WORD = 0xFFFFFFFF
SPHERE, BOX, DISC = int(Source.SPHERE), int(Source.BOX), int(Source.DISC)


@inlined
def mixed(number):
    """Return 32 bits in which each bit of ``number`` (32 bits) has a part: C. Wellons, lowbias32, 2018."""
    number = int(number) & WORD
    number ^= number >> 16
    number = (number * 0x7FEB352D) & WORD
    number ^= number >> 15
    number = (number * 0x846CA68B) & WORD
    return number ^ (number >> 16)


@inlined
def draw(key, number, which):
    """Return the number in (0, 1) that is the draw ``which`` of particle ``number``: the same whenever it is asked."""
    return (mixed(mixed(key ^ mixed(number)) + which) + 0.5) / 4294967296.0


@inlined
def birthplace(source, ex, ey, ez, dx, dy, dz, key, number):
    """Return a place evenly distributed in the source, frame of the emitter."""
    a, b, c = draw(key, number, 0), draw(key, number, 1), draw(key, number, 2)
    if source == BOX:
        return (a - 0.5) * ex, (b - 0.5) * ey, (c - 0.5) * ez
    if source == SPHERE:  # the largest of three numbers is distributed as the radius is, that of two as in a disc
        radius = ex * max(draw(key, number, 3), draw(key, number, 4), c)
        return on_cap(0.0, 1.0, 0.0, -1.0, a, b, radius)
    if source == DISC:
        radius = ex * max(draw(key, number, 3), draw(key, number, 4))
        return on_cap(dx, dy, dz, 0.0, 1.0, b, radius)
    return 0.0, 0.0, 0.0


@inlined
def on_cap(dx, dy, dz, least, share, turned, size):
    """Return the vector of a size whose cosine to a direction is ``share`` of the way from 1 to ``least``."""
    cosine = 1.0 - share * (1.0 - least)
    sine = sqrt(max(0.0, 1.0 - cosine * cosine))
    s, c = sine_cosine(2.0 * pi * turned)
    ux, uy, uz, wx, wy, wz = across(dx, dy, dz)
    c, s, cosine = size * sine * c, size * sine * s, size * cosine
    return cosine * dx + c * ux + s * wx, cosine * dy + c * uy + s * wy, cosine * dz + c * uz + s * wz


@inlined
def between(pair, i, share):
    """Return the number that is ``share`` of the way from a least to a greatest."""
    return pair[i, 0] + share * (pair[i, 1] - pair[i, 0])


@kernel("emitter", "number", "dies", "life", "x", "y", "z", "velocity_x", "velocity_y", "velocity_z")
def bear(
    first, times, begin, dt, seed, handle, born, i,
    source, extent, direction, cosine, speed, lives, inherit,
    start_position, start_rotation, start_linear, start_angular, position, rotation, linear, angular,
    emitter, number, dies, life, x, y, z, velocity_x, velocity_y, velocity_z,
):  # fmt: skip
    """Write a particle of the emitter in row ``i`` for each time (s) into rows from ``first`` on.

    The emitter goes straight and turns evenly from where it was at the start of the step to where it is at the end,
    ``linear`` and ``angular`` (3,) being its velocities there.
    """
    key = mixed(mixed(seed) ^ mixed(handle >> 32) ^ handle)  # by which one emitter's numbers differ from another's
    dx, dy, dz = direction[i, 0], direction[i, 1], direction[i, 2]
    size = sqrt(dx * dx + dy * dy + dz * dz)
    dx, dy, dz = dx / size, dy / size, dz / size
    for n in range(len(times)):
        row, serial, share = first + n, born + n, (times[n] - begin) / dt
        qx = start_rotation[i, 0] + share * (rotation[i, 0] - start_rotation[i, 0])
        qy = start_rotation[i, 1] + share * (rotation[i, 1] - start_rotation[i, 1])
        qz = start_rotation[i, 2] + share * (rotation[i, 2] - start_rotation[i, 2])
        qw = start_rotation[i, 3] + share * (rotation[i, 3] - start_rotation[i, 3])
        length = sqrt(qx * qx + qy * qy + qz * qz + qw * qw)
        qx, qy, qz, qw = qx / length, qy / length, qz / length, qw / length
        bx, by, bz = birthplace(source[i], extent[i, 0], extent[i, 1], extent[i, 2], dx, dy, dz, key, serial)
        rx, ry, rz = turn(qx, qy, qz, qw, bx, by, bz)
        pace = between(speed, i, draw(key, serial, 7))
        ux, uy, uz = on_cap(dx, dy, dz, cosine, draw(key, serial, 5), draw(key, serial, 6), pace)
        ux, uy, uz = turn(qx, qy, qz, qw, ux, uy, uz)
        wx = start_angular[i, 0] + share * (angular[0] - start_angular[i, 0])
        wy = start_angular[i, 1] + share * (angular[1] - start_angular[i, 1])
        wz = start_angular[i, 2] + share * (angular[2] - start_angular[i, 2])
        tx, ty, tz = cross(wx, wy, wz, rx, ry, rz)
        vx = start_linear[i, 0] + share * (linear[0] - start_linear[i, 0])
        vy = start_linear[i, 1] + share * (linear[1] - start_linear[i, 1])
        vz = start_linear[i, 2] + share * (linear[2] - start_linear[i, 2])
        emitter[row], number[row] = handle, serial
        life[row] = between(lives, i, draw(key, serial, 8))
        dies[row] = times[n] + float(life[row])
        x[row] = rx + start_position[i, 0] + share * (position[i, 0] - start_position[i, 0])
        y[row] = ry + start_position[i, 1] + share * (position[i, 1] - start_position[i, 1])
        z[row] = rz + start_position[i, 2] + share * (position[i, 2] - start_position[i, 2])
        velocity_x[row] = ux + inherit[i] * (vx + tx)
        velocity_y[row] = uy + inherit[i] * (vy + ty)
        velocity_z[row] = uz + inherit[i] * (vz + tz)
