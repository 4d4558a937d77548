"""Meshes: the triangles of a world's meshes and the trees over them in flat arrays, as kernels read them."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from carom.ecs.column import Floats, Integers
from carom.systems.detection.mesh_links import Surface, linked
from carom.systems.detection.packed import Packed
from carom.systems.kernels.mesh_tree import TRIANGLE, build_tree
from carom.systems.shapes.geometry import Geometry
from carom.systems.shapes.height_field import HeightField
from carom.systems.shapes.mesh import Mesh


class Meshes(NamedTuple):
    """Triangles in the order of their trees; all indices run through the whole world.

    The tree of geometry g has the nodes from ``root[g]`` on, in preorder, -1 where g is no mesh's.
    """

    root: Integers
    bounds: Floats  # 6 per node: lower and upper corner
    nodes: Integers  # 3 per node: the next one that is not below it, its first triangle, how many; 0 unless a leaf
    triangles: Floats  # 15 per triangle: its corners, its unit normal, one over the length of each edge
    links: Integers  # 8 per triangle: corners, the neighbours' corners across its edges, active edges, source face
    vertices: Floats  # 3 per corner
    fan_start: Integers
    fan: Integers


class PackedMeshes(Packed[Meshes, Meshes]):
    """The trees of a world's meshes and height fields."""

    shapes = (Mesh, HeightField)

    def make(self, geometry: Geometry) -> Meshes:
        """Return the tree over a surface."""
        return tree_of(geometry)

    def pack(self, made: dict[int, Meshes]) -> Meshes:
        """Return all of them as one."""
        return joined(made)


def tree_of(geometry: Geometry) -> Meshes:
    """Return the triangles of one geometry and the tree over them."""
    surface = linked(geometry)
    corners = surface.vertices[surface.faces]
    lower, upper = corners.min(axis=1), corners.max(axis=1)
    order = np.arange(len(corners))
    bounds, nodes = np.empty(12 * len(corners)), np.empty(6 * len(corners), np.int64)
    count = build_tree(lower, upper, lower + upper, order, bounds, nodes)
    return _packed(surface, order, bounds[: 6 * count].copy(), nodes[: 3 * count].copy())


def _packed(surface: Surface, order: Integers, bounds: Floats, nodes: Integers) -> Meshes:
    """Return a surface's arrays with its triangles in the order of the tree."""
    corners = surface.vertices[surface.faces]
    along = corners[:, [1, 2, 0]] - corners
    per_length = 1.0 / np.sqrt(along[:, :, 0] ** 2 + along[:, :, 1] ** 2 + along[:, :, 2] ** 2)
    triangles = np.concatenate([corners.reshape(-1, 9), surface.normals, per_length], axis=1)[order]
    links = [surface.faces, surface.across, surface.active[:, None], surface.source[:, None]]
    return Meshes(
        np.zeros(1, np.int64), bounds, nodes, triangles.ravel(), np.concatenate(links, axis=1)[order].ravel(),
        surface.vertices.ravel(), surface.fan_start, surface.fan,
    )  # fmt: skip


def joined(trees: dict[int, Meshes]) -> Meshes:
    """Return the trees of several geometries as one, with indices that run through all."""
    root = np.full(1 + max(trees, default=-1), -1)
    fans = [np.zeros(1, np.int64)]
    parts: list[Meshes] = []
    node = triangle = corner = edge = 0
    for number in sorted(trees):
        tree = trees[number]
        links = tree.links.reshape(-1, 8).copy()
        links[:, :6] += np.where(links[:, :6] >= 0, corner, 0)
        parts.append(
            tree._replace(
                nodes=(tree.nodes.reshape(-1, 3) + np.array([node, triangle, 0])).ravel(),
                links=links.ravel(),
                fan=tree.fan + corner,
            )
        )
        fans.append(tree.fan_start[1:] + edge)
        root[number] = node
        node, triangle = node + len(tree.bounds) // 6, triangle + len(tree.triangles) // TRIANGLE
        corner, edge = corner + len(tree.vertices) // 3, edge + len(tree.fan)

    def joint(column: str, kind: type) -> Any:
        return np.concatenate([np.empty(0, kind), *(getattr(part, column) for part in parts)])

    return Meshes(
        root, joint("bounds", np.float64), joint("nodes", np.int64), joint("triangles", np.float64),
        joint("links", np.int64), joint("vertices", np.float64), np.concatenate(fans), joint("fan", np.int64),
    )  # fmt: skip
