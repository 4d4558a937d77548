"""glTF: a scene as entities that stand where its nodes are, each with its mesh (registry.khronos.org/glTF, 2.0)."""

from __future__ import annotations

import io
from pathlib import Path
from typing import Any

import numpy as np

from carom.ecs.column import Floats
from carom.ecs.spatial import quaternion
from carom.worlds.errors import WorldError
from carom.worlds.importing.elements import Element, Reading
from carom.worlds.importing.files import ModelFiles
from carom.worlds.importing.gltf_file import read_gltf_file, refusal, single_mesh
from carom.worlds.importing.model import Link, Model, Piece, Pose
from carom.worlds.importing.report import Report

UP = "y"
ROUNDING = 1e-9  # of what a node stretches, below which it does not
LEFT_OUT = ("animations", "skins")


def read_gltf(path: Path, files: ModelFiles, reading: Reading, report: Report, scratch: Path) -> Model:
    """Return the model of a scene; its meshes are written to the folder ``scratch``, stretched as their nodes are."""
    try:
        data, content = read_gltf_file(path, files)
    except WorldError:
        reading.refuse_if_faulty()  # which says more
        raise
    reading.refuse_if_faulty()
    try:
        return _Scene(path, data, content, report, scratch).model()
    except (KeyError, IndexError, TypeError, ValueError, AttributeError) as fault:
        raise refusal(path, f"{type(fault).__name__} {fault}") from None


class _Scene:
    """A scene while it is read."""

    def __init__(self, path: Path, data: dict[str, Any], content: bytes, report: Report, scratch: Path) -> None:
        self.path, self.data, self.content, self.report, self.scratch = path, data, content, report, scratch
        self.made = Model(path.stem, report)
        self.files: dict[tuple[int, bytes], Path | None] = {}

    def model(self) -> Model:
        """Return all nodes of the scene that is shown first, none twice."""
        data, whole = self.data, Element("glTF", {}, str(self.path), 0)
        for key in LEFT_OUT:
            for item in data.get(key, []):
                self.report.drop(whole, key, str(item.get("name", "")))
        for name in data.get("extensionsUsed", []):
            self.report.drop(whole, f"extension {name}")
        scenes = data.get("scenes", [])
        waiting = [(node, np.eye(4)) for node in scenes[data.get("scene", 0)]["nodes"]] if scenes else []
        seen: set[int] = set()
        while waiting:
            number, around = waiting.pop(0)
            if number in seen:
                raise ValueError(f"node {number} hangs in two places")
            seen.add(number)
            node = data["nodes"][number]
            place = around @ matrix_of(node)
            self.node(number, node, place)
            waiting = [*((child, place) for child in node.get("children", [])), *waiting]
        return self.made

    def node(self, number: int, node: dict[str, Any], place: Floats) -> None:
        """Add what stands at a node."""
        name = str(node.get("name") or f"node-{number}")
        element = Element("node", {"name": name}, str(self.path), 0)
        if not np.isfinite(place).all():
            raise ValueError(f"node {number} is at no place")
        turn, stretch = turned(place[:3, :3])
        pose = Pose(place[:3, 3], turn)
        if "camera" in node:
            self.camera(name, element, self.data["cameras"][node["camera"]], pose)
        if "mesh" in node:
            file = self.mesh(node["mesh"], stretch, element)
            if file is not None:
                piece = Piece(element, "mesh", {}, file=file)
                self.made.links.append(Link(element, name, pose, pieces=[piece], static=True, lone=True))
                self.report.keep("node")

    def mesh(self, number: int, stretch: Floats, element: Element) -> Path | None:
        """Return the file of a mesh alone, stretched; each is written once."""
        import trimesh

        key = (number, stretch.tobytes())
        if key not in self.files:
            mesh = self.data["meshes"][number]
            name = str(mesh.get("name") or f"mesh-{number}")
            if any("targets" in primitive for primitive in mesh["primitives"]):
                self.report.drop(element, "morph targets", name)
            self.files[key] = None
            try:
                moved = stretched(single_mesh(self.data, number, self.content), stretch)
                content = trimesh.Scene(moved).export(file_type="glb") if moved else b""
            except Exception as fault:  # whatever trimesh makes of such bytes
                self.report.drop(element, f"a mesh that cannot be read: {fault}", name)
                return None
            if not moved:
                self.report.drop(element, "a mesh of points or lines", name)
                return None
            path = self.scratch / f"{len(self.files)}" / f"{name.replace('/', '_')[:64]}.glb"
            path.parent.mkdir()
            path.write_bytes(content)
            self.files[key] = path
        return self.files[key]

    def camera(self, name: str, element: Element, stated: dict[str, Any], pose: Pose) -> None:
        """Add a camera."""
        forward, up = (quaternion.rotate(pose.rotation, axis) for axis in ((0.0, 0.0, -1.0), (0.0, 1.0, 0.0)))
        words: dict[str, Any] = {"position": pose.position, "target": pose.position + forward, "up": up}
        if stated["type"] == "perspective":
            words["fov"] = float(stated["perspective"]["yfov"])
        else:
            words["height"] = 2.0 * float(stated["orthographic"]["ymag"])
        self.made.cameras[name] = words
        self.report.keep("camera")


def stretched(content: bytes, stretch: Floats) -> list[Any]:
    """Return the triangles of a ``.glb`` as trimeshes, stretched by a matrix (3, 3)."""
    import trimesh

    scene = trimesh.load_scene(io.BytesIO(content), file_type="glb", process=False)
    parts = [part for part in scene.dump() if len(getattr(part, "faces", ()))]
    if np.array_equal(stretch, np.eye(3)):
        return parts
    transform = np.eye(4)
    transform[:3, :3] = stretch
    return [part.apply_transform(transform) for part in parts]


def matrix_of(node: dict[str, Any]) -> Floats:
    """Return where a node is in the one around it, as a matrix (4, 4)."""
    if "matrix" in node:
        return np.array(node["matrix"], np.float64).reshape(4, 4).T
    place = np.eye(4)
    rotation = np.array(node.get("rotation", quaternion.IDENTITY), np.float64)
    if rotation.shape != (4,) or not rotation.any():
        raise ValueError("a rotation is no quaternion")
    scale = np.array(node.get("scale", (1.0, 1.0, 1.0)), np.float64)
    place[:3, :3] = quaternion.matrix(quaternion.normalise(rotation)) * scale
    place[:3, 3] = node.get("translation", (0.0, 0.0, 0.0))
    return place


def turned(linear: Floats) -> tuple[Floats, Floats]:
    """Return a matrix as a rotation after a stretch, which may also mirror (polar decomposition)."""
    left, _, right = np.linalg.svd(linear)
    rotation = left @ right
    if np.linalg.det(rotation) < 0.0:
        rotation = -rotation
    stretch = rotation.T @ linear
    if np.abs(stretch - np.eye(3)).max() < ROUNDING:
        stretch = np.eye(3)
    return quaternion.from_matrix(rotation), np.round(stretch, 12) + 0.0
