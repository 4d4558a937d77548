"""Model files: OBJ, STL, PLY and glTF read through trimesh into geometries."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any, Literal

import numpy as np
import numpy.typing as npt

from carom.ecs.column import Floats, Integers
from carom.ecs.errors import DeclarationError
from carom.systems.constants import MOST_TRIANGLES
from carom.systems.shapes.geometry import Geometry, hull_of
from carom.systems.shapes.orientation import along_y
from carom.systems.shapes.welding import is_collapsed, is_sliver, seams, weld

ENDINGS = (".obj", ".stl", ".ply", ".glb", ".gltf")
UNITS = {"m": 1.0, "cm": 0.01, "mm": 0.001, "km": 1000.0, "in": 0.0254, "ft": 0.3048}  # m
Unit = Literal["m", "cm", "mm", "km", "in", "ft"]
Axis = Literal["y", "z"]


def load_mesh(file: str | Path, *, scale: float = 1.0, unit: Unit = "m", up: Axis = "y") -> Geometry:
    """Read a closed mesh, ``scale`` times as large as in the file, whose lengths are in ``unit``.

    The meshes of a scene are joined; with ``up`` z the file's z becomes carom's y. Triangles without area are left out,
    which the notes of the geometry tell. Raises DeclarationError when the file is missing or unreadable, holds no
    triangles or too many, is not finite, open or inverted, or faces of it are turned both ways.
    """
    source = f"mesh file {file}"
    return closed_surface(*_read(Path(file), scale, unit, up), source, str(file))


def closed_surface(vertices: Floats, faces: Integers, source: str, name: str) -> Geometry:
    """Return triangles made one closed surface, as `load_mesh` says; raise DeclarationError where they are none."""
    if not len(faces):
        raise DeclarationError(f"{source} holds no triangles")
    if len(faces) > MOST_TRIANGLES:
        raise DeclarationError(
            f"{source} holds {len(faces):,} triangles, more than the {MOST_TRIANGLES:,} a mesh may have, "
            "since each million takes some 20 s to load; simplify it, or use convex"
        )
    total = len(faces)
    vertices, faces = weld(vertices, faces)
    faces = faces[~is_collapsed(faces)]
    found = seams(faces, len(vertices))
    faces = faces[~is_sliver(vertices, faces)]  # only now: a sliver closes the gap it stands in
    if not len(faces):
        raise DeclarationError(f"{source} holds {total} triangles, none of which has an area")
    if found.loose:
        raise DeclarationError(
            f"{source} is open: {found.loose} edges do not join two faces; close its holes, or use convex"
        )
    if found.twisted:
        raise DeclarationError(
            f"{source} is turned both ways: {found.twisted} edges join faces that look to opposite sides; "
            "turn its faces outward"
        )
    if (volume := _volume(vertices, faces)) <= 0.0:
        raise DeclarationError(f"{source} is inverted: its volume is {volume:.6g} m3; turn its faces outward")
    lost = total - len(faces)
    verbs = ("have", "are") if lost > 1 else ("has", "is")
    notes = (f"{source}: {lost} of {total} triangles {verbs[0]} no area and {verbs[1]} left out",) if lost else ()
    return Geometry(vertices, faces, name, notes)


def load_hull(file: str | Path, *, scale: float = 1.0, unit: Unit = "m", up: Axis = "y") -> Geometry:
    """Return the hull of the vertices of a file as `load_mesh` reads it; it may be open, or points alone.

    Raises DeclarationError when the file is missing or unreadable, or its vertices span no volume.
    """
    vertices, _ = _read(Path(file), scale, unit, up)
    return hull_of(vertices, f"mesh file {file}")


def _read(path: Path, scale: float, unit: str, up: str) -> tuple[Floats, Integers]:
    """Return finite vertices in m, y up, and the faces of a file."""
    source = f"mesh file {path}"
    refuse_numbers(source, scale, unit, up)
    return vertices_and_faces(source, read_scene(path), scale, unit, up)


def refuse_numbers(source: str, scale: float, unit: str, up: str) -> None:
    """Raise DeclarationError for a scale, unit or axis that cannot be."""
    for word, value, choices in (("unit", unit, tuple(UNITS)), ("up", up, ("y", "z"))):
        if value not in choices:
            raise DeclarationError(f"{source}: {word} must be one of {', '.join(choices)}, received {value!r}")
    if not (isinstance(scale, (int, float)) and math.isfinite(scale) and scale > 0.0):
        raise DeclarationError(f"{source}: scale must be finite and above 0, received {scale!r}")


def vertices_and_faces(source: str, scene: Any, scale: float, unit: str, up: str) -> tuple[Floats, Integers]:
    """Return finite vertices in m, y up, and the faces of what `read_scene` has read; raise DeclarationError."""
    vertices = np.array(scene.vertices, np.float64).reshape(-1, 3) * (scale * UNITS[unit])
    faces = np.array(getattr(scene, "faces", ()), np.int64).reshape(-1, 3)
    refuse_triangles(source, vertices, faces)
    return (along_y(vertices) if up == "z" else vertices), faces


def triangles(source: str, vertices: npt.ArrayLike, faces: npt.ArrayLike) -> tuple[Floats, Integers]:
    """Return stated vertices (v, 3), m, and faces (f, 3) as arrays; raise DeclarationError where they are none."""
    found = np.asarray(vertices, np.float64).reshape(-1, 3), np.asarray(faces, np.int64).reshape(-1, 3)
    refuse_triangles(source, *found)
    return found


def refuse_triangles(source: str, vertices: Floats, faces: Integers) -> None:
    """Raise DeclarationError for vertices that are not finite, and for faces of vertices that are not there."""
    if not np.isfinite(vertices).all():
        bad = int(np.argmin(np.isfinite(vertices).all(axis=1)))
        raise DeclarationError(f"{source}: vertices must be finite, received {vertices[bad].tolist()} as vertex {bad}")
    if len(faces) and not 0 <= faces.min() <= faces.max() < len(vertices):
        raise DeclarationError(f"{source}: a face names vertex {faces.max()}, but there are {len(vertices)}")


def read_scene(path: Path) -> Any:
    """Return everything in a file as one trimesh, or its points."""
    import trimesh

    parts = read_parts(path)
    return parts[0] if len(parts) == 1 else trimesh.util.concatenate(parts)


def read_parts(path: Path) -> list[Any]:
    """Return the meshes in a file where the file puts them, or else all its points as one; raise DeclarationError."""
    import trimesh

    source = f"mesh file {path}"
    if path.suffix.lower() not in ENDINGS:
        formats = f"OBJ, STL, PLY or glTF ({', '.join(ENDINGS)})"
        raise DeclarationError(f"{source} is of an unknown format {path.suffix!r}; write {formats}")
    if not path.is_file():
        raise DeclarationError(f"{source} does not exist")
    options = {"skip_materials": True} if path.suffix.lower() == ".obj" else {}
    try:
        scene = trimesh.load_scene(path, process=False, **options)
        parts = scene.dump()
    except Exception as fault:
        raise DeclarationError(f"{source} cannot be read: {fault}") from None
    meshes = [part for part in parts if isinstance(part, trimesh.Trimesh)]
    if not meshes:
        points = [part.vertices for part in parts if isinstance(part, trimesh.PointCloud)]
        return [trimesh.PointCloud(np.concatenate([np.zeros((0, 3)), *points]))]
    return meshes


def _volume(vertices: Floats, faces: Integers) -> float:
    a, b, c = (vertices[faces[:, k]] - vertices[0] for k in range(3))
    return float((a * np.cross(b, c)).sum() / 6.0)
