"""How deep two cores overlap: a polytope within their difference grows where its surface is nearest to the origin."""

from __future__ import annotations

# mypy: disable-error-code="no-untyped-def"
from carom.systems.constants import BRACKET, CURVED_ALIKE, CURVED_FROM, ONE_PLANE, SEEN
from carom.systems.kernels.cores import most_overlap
from carom.systems.kernels.kernel import inlined
from carom.systems.kernels.polytope import CORNER, MOST_CORNERS, MOST_FACES, NONE, add_corner, add_face, begin
from carom.systems.kernels.smooth import is_round, settle
from carom.systems.kernels.spatial import cross


@inlined
def expand(core, place, vertices, x, y, z, corner, face, plane, rim):
    """Return (overlap, unit direction from first to second, point of the first) of the least overlap of two cores.

    The overlap is negative where the two are apart along the direction. x is where to begin: the nearer to the answer,
    the sooner it is found. Expanding polytope algorithm (van den Bergen, Collision Detection in Interactive 3D
    Environments, 2003, 4.3.8). The plane of the face nearest to the origin is a lower bound of the overlap, and the
    overlap along its normal an upper one; it ends when they are BRACKET apart.
    """
    faces = begin(core, place, vertices, x, y, z, corner, face, plane)
    nx, ny, nz = x, y, z
    least, curved = 1e300, is_round(core)
    px, py, pz = corner[3], corner[4], corner[5]
    for count in range(4, MOST_CORNERS):
        nearest, low = NONE - 1, 1e300
        for f in range(faces):
            if plane[4 * f + 3] < low:
                nearest, low = f, plane[4 * f + 3]
        if nearest < 0:
            break
        mx, my, mz = plane[4 * nearest], plane[4 * nearest + 1], plane[4 * nearest + 2]
        w = CORNER * count
        add_corner(core, place, vertices, mx, my, mz, corner, w)
        overlap = mx * corner[w] + my * corner[w + 1] + mz * corner[w + 2]
        if overlap < least:
            least, nx, ny, nz = overlap, mx, my, mz
            px, py, pz = corner[w + 3], corner[w + 4], corner[w + 5]
        if overlap - low <= BRACKET:
            nx, ny, nz, beside = mx, my, mz, 1e300
            for f in range(faces):  # of several in one plane the origin is seen through one only
                alike = mx * plane[4 * f] + my * plane[4 * f + 1] + mz * plane[4 * f + 2]
                if plane[4 * f + 3] <= low + BRACKET and alike >= ONE_PLANE:
                    out, ax, ay, az = point_within(corner, face, plane, f)
                    if out < beside:
                        beside, px, py, pz = out, ax, ay, az
            break
        if curved and overlap - low <= CURVED_FROM:
            curved = False
            found, sx, sy, sz = settle(core, place, vertices, mx, my, mz)
            if found:
                ax, ay, az, qx, qy, qz = most_overlap(core, place, vertices, sx, sy, sz)
                overlap = ax * sx + ay * sy + az * sz
                if alone_below(plane, faces, overlap - BRACKET, sx, sy, sz):
                    return overlap, sx, sy, sz, qx, qy, qz
        edges, f = 0, 0
        while f < faces:
            above = plane[4 * f] * corner[w] + plane[4 * f + 1] * corner[w + 1] + plane[4 * f + 2] * corner[w + 2]
            if above <= plane[4 * f + 3] + SEEN:
                f += 1
                continue
            for side in range(3):
                i, j = face[3 * f + side], face[3 * f + (side + 1) % 3]
                known = False
                for e in range(edges):
                    if rim[2 * e] == j and rim[2 * e + 1] == i:
                        edges -= 1
                        rim[2 * e], rim[2 * e + 1] = rim[2 * edges], rim[2 * edges + 1]
                        known = True
                        break
                if not known:
                    rim[2 * edges], rim[2 * edges + 1] = i, j
                    edges += 1
            faces -= 1
            for d in range(4):
                plane[4 * f + d] = plane[4 * faces + d]
            for d in range(3):
                face[3 * f + d] = face[3 * faces + d]
        if faces + edges > MOST_FACES:
            break
        for e in range(edges):
            faces = add_face(corner, rim[2 * e], rim[2 * e + 1], count, face, plane, faces)
    ax, ay, az, _, _, _ = most_overlap(core, place, vertices, nx, ny, nz)  # without the lean
    return nx * ax + ny * ay + nz * az, nx, ny, nz, px, py, pz


@inlined
def alone_below(plane, faces, overlap, x, y, z):
    """Tell whether all faces nearer than an overlap are turned to a direction, so that no other can be less."""
    for f in range(faces):
        alike = plane[4 * f] * x + plane[4 * f + 1] * y + plane[4 * f + 2] * z
        if plane[4 * f + 3] < overlap and alike < CURVED_ALIKE:
            return False
    return True


@inlined
def point_within(corner, face, plane, f):
    """Return (how far outside, point of the first core) where the origin is seen through a face, along its normal.

    Outside counts in parts of the face, 0 or less within it.
    """
    a, b, c = CORNER * face[3 * f], CORNER * face[3 * f + 1], CORNER * face[3 * f + 2]
    nx, ny, nz, offset = plane[4 * f], plane[4 * f + 1], plane[4 * f + 2], plane[4 * f + 3]
    ox, oy, oz = offset * nx - corner[a], offset * ny - corner[a + 1], offset * nz - corner[a + 2]
    ux, uy, uz = corner[b] - corner[a], corner[b + 1] - corner[a + 1], corner[b + 2] - corner[a + 2]
    vx, vy, vz = corner[c] - corner[a], corner[c + 1] - corner[a + 1], corner[c + 2] - corner[a + 2]
    x, y, z = cross(ux, uy, uz, vx, vy, vz)
    whole = nx * x + ny * y + nz * z
    x, y, z = cross(ox, oy, oz, vx, vy, vz)
    s = (nx * x + ny * y + nz * z) / whole
    x, y, z = cross(ux, uy, uz, ox, oy, oz)
    t = (nx * x + ny * y + nz * z) / whole
    out = max(-s, -t, s + t - 1.0)
    s, t = min(max(s, 0.0), 1.0), min(max(t, 0.0), 1.0)
    if s + t > 1.0:
        s, t = s / (s + t), t / (s + t)
    r = 1.0 - s - t
    return (
        out,
        r * corner[a + 3] + s * corner[b + 3] + t * corner[c + 3],
        r * corner[a + 4] + s * corner[b + 4] + t * corner[c + 4],
        r * corner[a + 5] + s * corner[b + 5] + t * corner[c + 5],
    )
