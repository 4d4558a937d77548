"""Flight of particles: eight at a time along their arcs and off planes."""

from __future__ import annotations

# mypy: disable-error-code="no-untyped-def,no-untyped-call"
from carom.systems.constants import PARTICLE_REST, PARTICLE_SKIN
from carom.systems.kernels.kernel import kernel, woven
from carom.systems.kernels.lane_vectors import TINY
from carom.systems.kernels.lanes import WIDTH, address, choose, larger, load, root, smaller, some, spread, which
from carom.systems.kernels.lanes_single import load_single, store_single
from carom.systems.kernels.particle_arcs import ACCELERATION, CHUNK, FLOW, LEFT, TIME

GROUPS = CHUNK // WIDTH
NORMAL, OFFSET, RESTITUTION, FRICTION = 0, 3, 4, 5  # columns of planes, normals unit and world frame
PLANE_COLUMNS = 6
ALL_LANES = 2**WIDTH - 1


@woven
def slowed(ux, uy, uz, left, h, half_pace):
    """Return a velocity through the medium after half of a time h: e^-t of linear drag, 1 / (1 + k |u|) of quadratic.

    Both are exact by themselves.
    """
    if half_pace == 0.0:
        return ux * left, uy * left, uz * left
    part = left / (1.0 + half_pace * h * root(ux * ux + uy * uy + uz * uz))
    return ux * part, uy * part, uz * part


@woven
def pushed(push, friction, vx, vy, vz, nx, ny, nz):
    """Return a velocity after a push along a normal (m/s), and after the friction that goes with it."""
    along = nx * vx + ny * vy + nz * vz
    tx, ty, tz = vx - along * nx, vy - along * ny, vz - along * nz
    square, most, part = tx * tx + ty * ty + tz * tz, friction * push, spread(1.0)
    slips = square - most * most
    if some(slips):
        part = choose(slips, most / larger(root(square), spread(TINY)), part)
    return vx + push * nx - part * tx, vy + push * ny - part * ty, vz + push * nz - part * tz


@woven
def bounced(h, ax, ay, az, px, py, pz, vx, vy, vz, nx, ny, nz, offset, restitution, friction):
    """Return where particles below a plane are, and their velocities, had they bounced off when they came there.

    The time since solves d - v t + a t^2 / 2 = 0 on the arc they came by. Who is below again comes to lie.
    """
    none = spread(0.0)
    depth, speed = nx * px + ny * py + nz * pz - offset, nx * vx + ny * vy + nz * vz
    pull = nx * ax + ny * ay + nz * az
    inside = speed * speed - 2.0 * pull * depth
    since = -2.0 * depth / larger(root(larger(inside, none)) - speed, spread(TINY))
    since = choose(-speed, choose(inside, smaller(h, since), h), h)
    vx, vy, vz = vx - since * ax, vy - since * ay, vz - since * az
    square = 0.5 * since * since
    px, py, pz = px - since * vx - square * ax, py - since * vy - square * ay, pz - since * vz - square * az
    closing = nx * vx + ny * vy + nz * vz
    vx, vy, vz = pushed(larger(none, -(1.0 + restitution) * closing), friction, vx, vy, vz, nx, ny, nz)
    px, py, pz = px + since * vx + square * ax, py + since * vy + square * ay, pz + since * vz + square * az
    vx, vy, vz = vx + since * ax, vy + since * ay, vz + since * az
    depth = nx * px + ny * py + nz * pz - offset
    if some(-depth):
        sunk = smaller(none, depth)
        px, py, pz = px - sunk * nx, py - sunk * ny, pz - sunk * nz
        push = choose(-depth, larger(none, -(nx * vx + ny * vy + nz * vz)), none)
        vx, vy, vz = pushed(push, friction, vx, vy, vz, nx, ny, nz)
    return px, py, pz, vx, vy, vz


@woven
def slid(half, x0, y0, z0, v0, v1, v2, vx, vy, vz, nx, ny, nz, offset, friction):
    """Return where particles are that lie on a plane, and how fast, given both at the start and the velocity pressed.

    Friction acts all the time, so that the mean of both velocities is theirs, and who is held stays.
    """
    push = larger(spread(0.0), -(nx * vx + ny * vy + nz * vz))
    vx, vy, vz = pushed(push, friction, vx, vy, vz, nx, ny, nz)
    px, py, pz = x0 + half * (v0 + vx), y0 + half * (v1 + vy), z0 + half * (v2 + vz)
    depth = nx * px + ny * py + nz * pz - offset
    return px - depth * nx, py - depth * ny, pz - depth * nz, vx, vy, vz


@woven
def fly_eight(at, apart, group, arcs, half_pace, planes, x, y, z, velocity_x, velocity_y, velocity_z):
    """Fly eight particles, and let those that come below a plane bounce off it; return 0 where they are somewhere.

    They are at place ``at`` of the first column, and ``apart`` farther on in each that follows.
    """
    h, left = load(arcs, TIME * GROUPS + group), load(arcs, LEFT * GROUPS + group)
    ax, ay = load(arcs, ACCELERATION * GROUPS + group), load(arcs, (ACCELERATION + 1) * GROUPS + group)
    az, fx = load(arcs, (ACCELERATION + 2) * GROUPS + group), load(arcs, FLOW * GROUPS + group)
    fy, fz = load(arcs, (FLOW + 1) * GROUPS + group), load(arcs, (FLOW + 2) * GROUPS + group)
    x0, y0, z0 = load_single(x, at), load_single(y, at + apart), load_single(z, at + 2 * apart)
    v0, v1, v2 = (
        load_single(velocity_x, at + 3 * apart),
        load_single(velocity_y, at + 4 * apart),
        load_single(velocity_z, at + 5 * apart),
    )
    ux, uy, uz = slowed(v0 - fx, v1 - fy, v2 - fz, left, h, half_pace)
    half = 0.5 * h
    px = x0 + h * (fx + ux + half * ax)
    py = y0 + h * (fy + uy + half * ay)
    pz = z0 + h * (fz + uz + half * az)
    ux, uy, uz = slowed(ux + h * ax, uy + h * ay, uz + h * az, left, h, half_pace)
    vx, vy, vz, none = fx + ux, fy + uy, fz + uz, spread(0.0)
    for p in range(len(planes)):
        nx, ny, nz, offset = planes[p, NORMAL], planes[p, NORMAL + 1], planes[p, NORMAL + 2], planes[p, OFFSET]
        depth = offset - (nx * px + ny * py + nz * pz)
        if not some(depth):
            continue
        friction, speed = planes[p, FRICTION], nx * v0 + ny * v1 + nz * v2
        lies = choose(
            PARTICLE_REST * PARTICLE_REST - speed * speed, nx * x0 + ny * y0 + nz * z0 - offset + PARTICLE_SKIN, none
        )
        lies = choose(depth, lies, none)
        if some(lies):
            bx, by, bz, wx, wy, wz = slid(half, x0, y0, z0, v0, v1, v2, vx, vy, vz, nx, ny, nz, offset, friction)
            px, py, pz = choose(lies, bx, px), choose(lies, by, py), choose(lies, bz, pz)
            vx, vy, vz = choose(lies, wx, vx), choose(lies, wy, vy), choose(lies, wz, vz)
            depth = choose(lies, none, depth)
        if some(depth):  # others than those who lay on it before
            ux, uy, uz = vx - fx, vy - fy, vz - fz
            drag = 2.0 * (1.0 - left) / larger(h, spread(TINY))  # what it feels at the end, as an acceleration
            if half_pace > 0.0:
                drag = drag + 2.0 * half_pace * root(ux * ux + uy * uy + uz * uz)
            bx, by, bz, wx, wy, wz = bounced(
                h, ax - drag * ux, ay - drag * uy, az - drag * uz, px, py, pz, vx, vy, vz, nx, ny, nz, offset,
                planes[p, RESTITUTION], friction,
            )  # fmt: skip
            px, py, pz = choose(depth, bx, px), choose(depth, by, py), choose(depth, bz, pz)
            vx, vy, vz = choose(depth, wx, vx), choose(depth, wy, vy), choose(depth, wz, vz)
    store_single(x, at, px)
    store_single(y, at + apart, py)
    store_single(z, at + 2 * apart, pz)
    store_single(velocity_x, at + 3 * apart, vx)
    store_single(velocity_y, at + 4 * apart, vy)
    store_single(velocity_z, at + 5 * apart, vz)
    total = px + py + pz + vx + vy + vz
    return total - total  # no number where any of these is none


@kernel("room", "x", "y", "z", "velocity_x", "velocity_y", "velocity_z")
def fly(first, count, arcs, half_pace, planes, room, x, y, z, velocity_x, velocity_y, velocity_z):
    """Fly ``count`` particles from row ``first`` on along arcs, which begin anew after each chunk.

    Half of the drag goes before the acceleration and half after it (Strang), as with bodies. ``half_pace`` (1/m) is
    half of the quadratic drag by mass. Fewer than eight fly in ``room`` (48,), where nobody is beside them.
    Return whether all are at a place that is a number.
    """
    where = address(arcs)
    columns = address(x), address(y), address(z), address(velocity_x), address(velocity_y), address(velocity_z)
    whole, sound = count // WIDTH, spread(1.0)
    for group in range(whole):
        sound = sound + fly_eight(first + group * WIDTH, 0, group % GROUPS, where, half_pace, planes, *columns)
    rest, last = count - whole * WIDTH, first + whole * WIDTH
    if rest:
        for k in range(rest):
            i = last + k
            room[k], room[WIDTH + k], room[2 * WIDTH + k] = x[i], y[i], z[i]
            room[3 * WIDTH + k], room[4 * WIDTH + k] = velocity_x[i], velocity_y[i]
            room[5 * WIDTH + k] = velocity_z[i]
        alone = address(room)
        fly_eight(0, WIDTH, whole % GROUPS, where, half_pace, planes, alone, alone, alone, alone, alone, alone)
        for k in range(rest):
            i = last + k
            x[i], y[i], z[i] = room[k], room[WIDTH + k], room[2 * WIDTH + k]
            velocity_x[i], velocity_y[i] = room[3 * WIDTH + k], room[4 * WIDTH + k]
            velocity_z[i] = room[5 * WIDTH + k]
            total = x[i] + y[i] + z[i] + velocity_x[i] + velocity_y[i] + velocity_z[i]
            if total - total != 0.0:
                return False
    return which(sound) == ALL_LANES
