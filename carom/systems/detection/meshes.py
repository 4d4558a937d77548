"""Meshes: the triangles of a world's meshes and the trees over them in flat arrays, as kernels read them."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from carom.ecs.column import Floats, Integers
from carom.ecs.spatial.vector import dot
from carom.systems.detection.mesh_links import Surface, linked
from carom.systems.detection.packed import Packed
from carom.systems.kernels.mesh_tree import TRIANGLE, build_tree
from carom.systems.shapes.geometry import Geometry
from carom.systems.shapes.height_field import HeightField
from carom.systems.shapes.mesh import Mesh

Singles = npt.NDArray[np.float32]
Indices = npt.NDArray[np.int32]


class Meshes(NamedTuple):
    """Triangles in the order of their trees; all indices run through the whole world.

    What a step reads of a mesh is seldom in the processor's cache, so bounds and indices take half of the usual room.
    The tree of geometry g has the nodes from ``root[g]`` on, in preorder, -1 where g is no mesh's.
    """

    root: Integers
    bounds: Singles  # 6 per node: lower and upper corner
    nodes: Indices  # 3 per node: the next one that is not below it, its first triangle, how many; 0 unless a leaf
    triangles: Floats  # 15 per triangle: its corners, its unit normal, one over the length of each edge
    links: Indices  # 8 per triangle: corners, the neighbours' corners across its edges, active edges, source face
    vertices: Floats  # 3 per corner
    fan_start: Indices
    fan: Indices  # twice a neighbouring corner, and 1 where the edge to it is active


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
    a, b, c = (surface.vertices[surface.faces[:, k]] for k in range(3))
    lower, upper = np.minimum(np.minimum(a, b), c), np.maximum(np.maximum(a, b), c)
    order = np.arange(len(a))
    bounds, nodes = np.empty(12 * len(a)), np.empty(6 * len(a), np.int64)
    count = build_tree(lower, upper, lower + upper, order, bounds, nodes)
    return _packed(surface, order, outward(bounds[: 6 * count]), nodes[: 3 * count].astype(np.int32))


def outward(bounds: Floats) -> Singles:
    """Return lower and upper corners in half the memory, moved outward where rounding moves them."""
    exact = bounds.reshape(-1, 2, 3)
    rounded = exact.astype(np.float32)
    ends = np.array([-np.inf, np.inf], np.float32)[:, None]
    inside = np.stack([rounded[:, 0] > exact[:, 0], rounded[:, 1] < exact[:, 1]], axis=1)
    return np.where(inside, np.nextafter(rounded, ends), rounded).ravel()


def _packed(surface: Surface, order: Integers, bounds: Singles, nodes: Indices) -> Meshes:
    """Return a surface's arrays with its triangles in the order of the tree."""
    faces = surface.faces[order]
    triangles, links = np.empty((len(faces), TRIANGLE)), np.empty((len(faces), 8), np.int32)
    corners = surface.vertices[faces]
    triangles[:, :9], triangles[:, 9:12] = corners.reshape(-1, 9), surface.normals[order]
    for k in range(3):
        along = corners[:, (k + 1) % 3] - corners[:, k]
        triangles[:, 12 + k] = 1.0 / np.sqrt(dot(along, along))
    links[:, :3], links[:, 3:6] = faces, surface.across[order]
    links[:, 6], links[:, 7] = surface.active[order], surface.source[order]
    return Meshes(
        np.zeros(1, np.int64), bounds, nodes, triangles.ravel(), links.ravel(),
        surface.vertices.ravel(), surface.fan_start.astype(np.int32), surface.fan.astype(np.int32),
    )  # fmt: skip


def joined(trees: dict[int, Meshes]) -> Meshes:
    """Return the trees of several geometries as one, with indices that run through all."""
    root = np.full(1 + max(trees, default=-1), -1)
    fans = [np.zeros(1, np.int32)]
    parts: list[Meshes] = []
    node = triangle = corner = edge = 0
    for number in sorted(trees):
        tree = trees[number]
        links = tree.links.reshape(-1, 8).copy()
        links[:, :6] += np.where(links[:, :6] >= 0, np.int32(corner), np.int32(0))
        parts.append(
            tree._replace(
                nodes=(tree.nodes.reshape(-1, 3) + np.array([node, triangle, 0], np.int32)).ravel(),
                links=links.ravel(),
                fan=tree.fan + np.int32(2 * corner),
            )
        )
        fans.append(tree.fan_start[1:] + np.int32(edge))
        root[number] = node
        node, triangle = node + len(tree.bounds) // 6, triangle + len(tree.triangles) // TRIANGLE
        corner, edge = corner + len(tree.vertices) // 3, edge + len(tree.fan)

    def joint(column: str, kind: type) -> Any:
        columns = [getattr(part, column) for part in parts]
        return columns[0] if len(columns) == 1 else np.concatenate([np.empty(0, kind), *columns])

    return Meshes(
        root, joint("bounds", np.float32), joint("nodes", np.int32), joint("triangles", np.float64),
        joint("links", np.int32), joint("vertices", np.float64), np.concatenate(fans), joint("fan", np.int32),
    )  # fmt: skip
