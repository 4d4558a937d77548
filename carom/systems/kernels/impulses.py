"""Impulses: what they do to the velocities of both bodies of each manifold, a group at a time."""

from __future__ import annotations

# mypy: disable-error-code="no-untyped-def,no-untyped-call"
from carom.systems.kernels import groups as of
from carom.systems.kernels.kernel import woven
from carom.systems.kernels.lane_vectors import about, plus, spanned, three, times
from carom.systems.kernels.lanes import gather
from carom.systems.kernels.levers import frame_of
from carom.systems.kernels.packing import INVERSE


@woven
def pushed(v, mass, x, y, z):
    """Return velocities after an impulse at the centre; ``mass`` is the inverse along the axes."""
    return v[0] + mass[0] * x, v[1] + mass[1] * y, v[2] + mass[2] * z, v[3], v[4], v[5], v[6], v[7]


@woven
def turned(v, x, y, z):
    """Return velocities after a turn."""
    return v[0], v[1], v[2], v[3], v[4] + x, v[5] + y, v[6] + z, v[7]


@woven
def twisted(v, lanes, turn, t, u, n):
    """Return velocities of a body, whose rows begin with ``turn``, after twists about the axes of the frame."""
    tx, ty, tz = three(lanes, turn)
    ux, uy, uz = three(lanes, turn + 3)
    nx, ny, nz = three(lanes, turn + 6)
    return turned(v, t * tx + u * ux + n * nx, t * ty + u * uy + n * ny, t * tz + u * uz + n * nz)


@woven
def pressed(r, lanes, a, b, j, by_t, by_u):
    """Return velocities of both bodies after an impulse along the normal at the middle, and twists across it."""
    nx, ny, nz = three(lanes, r + of.NORMAL)
    x, y, z = j * nx, j * ny, j * nz
    a, b = pushed(a, three(lanes, r + of.MASS_A), -x, -y, -z), pushed(b, three(lanes, r + of.MASS_B), x, y, z)
    (s_a, q_a, _), (s_b, q_b, _) = three(lanes, r + of.MIDDLE_A), three(lanes, r + of.MIDDLE_B)
    a = turned_across(a, lanes, r + of.TURN_A, -(q_a * j + by_t), s_a * j - by_u)
    return a, turned_across(b, lanes, r + of.TURN_B, q_b * j + by_t, by_u - s_b * j)


@woven
def turned_across(v, lanes, turn, t, u):
    """Return velocities of a body, whose rows begin with ``turn``, after twists about the tangents."""
    tx, ty, tz = three(lanes, turn)
    ux, uy, uz = three(lanes, turn + 3)
    return turned(v, t * tx + u * ux, t * ty + u * uy, t * tz + u * uz)


@woven
def struck(r, lanes, a, b, along, across, j, by_t, by_u, by_n):
    """Return velocities of both bodies after impulses along the axes of the frame at the middle, and twists."""
    t, u, n = frame_of(r, lanes)
    x, y, z = plus(spanned(along, t, across, u), times(j, n))
    a, b = pushed(a, three(lanes, r + of.MASS_A), -x, -y, -z), pushed(b, three(lanes, r + of.MASS_B), x, y, z)
    (s_a, q_a, z_a), (s_b, q_b, z_b) = three(lanes, r + of.MIDDLE_A), three(lanes, r + of.MIDDLE_B)
    a = twisted(
        a, lanes, r + of.TURN_A,
        z_a * across - q_a * j - by_t, s_a * j - z_a * along - by_u, q_a * along - s_a * across - by_n,
    )  # fmt: skip
    return a, twisted(
        b, lanes, r + of.TURN_B,
        q_b * j - z_b * across + by_t, z_b * along - s_b * j + by_u, s_b * across - q_b * along + by_n,
    )  # fmt: skip


@woven
def rolled(g, index_a, index_b, bodies, a, b, x, y, z):
    """Return velocities of both bodies after a twist on b and its opposite on a."""
    ax, ay, az = about(gather(bodies[INVERSE], index_a, g), x, y, z)
    bx, by, bz = about(gather(bodies[INVERSE], index_b, g), x, y, z)
    return turned(a, -ax, -ay, -az), turned(b, bx, by, bz)
