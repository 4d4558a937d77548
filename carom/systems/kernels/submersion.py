"""Submersion: volume and centre of what of a shape lies below a plane, many shapes of one kind at once."""

from __future__ import annotations

from math import pi, sqrt

import numpy as np

# mypy: disable-error-code="no-untyped-def"
from carom.systems.kernels.kernel import inlined, kernel

#: What is found of each shape: the volume below the plane (m3), the centre of that (m, shape frame), all of the volume.
VOLUME, CENTER, WHOLE, FOUND = 0, 1, 4, 5


@kernel("found")
def submerge_balls(radii, normal, depth, found):
    """Write what is below the planes ``normal . x = depth`` (m) of balls stretched to half axes ``radii`` (n, 3).

    Stretching keeps planes planes and shares of volumes: so it is the cap of a ball of radius 1, of height h,
    pi h^2 (3 - h) / 3, whose centre is 3 (2 - h)^2 / (4 (3 - h)) from that of the ball (Harris and Stocker, Handbook of
    Mathematics and Computational Science, 1998, 4.8.4).
    """
    for m in range(len(depth)):
        size = 0.0
        for k in range(3):
            size += (radii[m, k] * normal[m, k]) ** 2
        size = sqrt(size)
        h = min(max(1.0 + depth[m] / size, 0.0), 2.0)
        away = 3.0 * (2.0 - h) * (2.0 - h) / (4.0 * (3.0 - h))
        scale = radii[m, 0] * radii[m, 1] * radii[m, 2]
        found[m, VOLUME] = scale * pi * h * h * (3.0 - h) / 3.0
        found[m, WHOLE] = scale * 4.0 * pi / 3.0
        for k in range(3):
            found[m, CENTER + k] = -away * radii[m, k] * radii[m, k] * normal[m, k] / size


@kernel("found", makes_arrays=True)
def submerge_polyhedra(vertices, lifted, faces, halves, stretch, lift, normal, depth, found):
    """Write what is below planes of polyhedra with outward ``faces`` (f, 3), exact but for rounding.

    Their vertices (v, 3) are stretched along the axes by ``stretch`` (n, 3) and moved along y by ``lift`` (n,) times
    ``lifted`` (v,). With ``halves`` each is the half, where z is not below 0, of what stands for a solid of revolution
    about y: its x axis turns to where the plane rises, so that the other half is its mirror image.
    """
    corners, height = np.empty((len(vertices), 3)), np.empty(len(vertices))
    for m in range(len(depth)):
        nx, ny, nz = normal[m, 0], normal[m, 1], normal[m, 2]
        c, s = 1.0, 0.0
        level = sqrt(nx * nx + nz * nz)
        if halves and level > 0.0:
            c, s = nx / level, nz / level
            nx, nz = level, 0.0
        below = False
        above = False
        for k in range(len(vertices)):
            for a in range(3):
                corners[k, a] = vertices[k, a] * stretch[m, a]
            corners[k, 1] += lifted[k] * lift[m]
            height[k] = nx * corners[k, 0] + ny * corners[k, 1] + nz * corners[k, 2] - depth[m]
            below |= height[k] < 0.0
            above |= height[k] >= 0.0
        apex = depth[m] if below and above else 0.0  # on the plane, so that what the plane cuts open adds nothing
        volume, x, y, z, whole = parts(corners, height, faces, below, apex * nx, apex * ny, apex * nz)
        if halves:
            volume, whole, z = 2.0 * volume, 2.0 * whole, 0.0
        found[m, VOLUME], found[m, WHOLE] = volume, whole
        found[m, CENTER], found[m, CENTER + 1], found[m, CENTER + 2] = c * x - s * z, y, s * x + c * z


@inlined
def parts(corners, height, faces, below, ox, oy, oz):
    """Return volume and centre of what has negative ``height``, and the whole volume, as signed tetrahedra from o.

    E. Catto, Exact Buoyancy for Polyhedra, Game Programming Gems 6, 2006, 2.5.
    """
    volume, mx, my, mz, whole = 0.0, 0.0, 0.0, 0.0, 0.0
    for f in range(len(faces)):
        i, j, k = faces[f, 0], faces[f, 1], faces[f, 2]
        under = int(height[i] < 0.0) + int(height[j] < 0.0) + int(height[k] < 0.0)
        while under % 3 and (height[i] < 0.0) != (under == 1):  # i is the corner that is alone on its side
            i, j, k = j, k, i
        ax, ay, az = corners[i, 0] - ox, corners[i, 1] - oy, corners[i, 2] - oz
        bx, by, bz = corners[j, 0] - ox, corners[j, 1] - oy, corners[j, 2] - oz
        cx, cy, cz = corners[k, 0] - ox, corners[k, 1] - oy, corners[k, 2] - oz
        six = ax * (by * cz - bz * cy) + ay * (bz * cx - bx * cz) + az * (bx * cy - by * cx)
        whole += six / 6.0
        if under == 0 or not below:
            continue
        if under < 3:
            # Cut at shares p of ab and q of ac: tetrahedra of one base are as their triangles, and centres are means.
            p, q = height[i] / (height[i] - height[j]), height[i] / (height[i] - height[k])
            px, py, pz = ax + p * (bx - ax), ay + p * (by - ay), az + p * (bz - az)
            qx, qy, qz = ax + q * (cx - ax), ay + q * (cy - ay), az + q * (cz - az)
            tip = p * q * six
            tx, ty, tz = tip * (ax + px + qx), tip * (ay + py + qy), tip * (az + pz + qz)
            if under == 1:
                volume, mx, my, mz = volume + tip, mx + tx, my + ty, mz + tz
                continue
            volume -= tip
            mx, my, mz = mx - tx, my - ty, mz - tz
        volume += six
        mx, my, mz = mx + six * (ax + bx + cx), my + six * (ay + by + cy), mz + six * (az + bz + cz)
    if volume <= 0.0:
        return 0.0, ox, oy, oz, whole
    share = 0.25 / volume
    return volume / 6.0, ox + share * mx, oy + share * my, oz + share * mz, whole
