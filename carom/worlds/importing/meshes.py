"""Meshes of a model as words of a world file: named where they lie, or written anew where no words turn them."""

from __future__ import annotations

import os
import re
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np

from carom.ecs.errors import DeclarationError
from carom.systems.shapes.finish import load_seen
from carom.systems.shapes.model_files import load_hull, load_mesh, read_parts
from carom.worlds.importing.convention import Convention
from carom.worlds.importing.model import Piece

AS_MESH, AS_HULL, AS_SEEN = "mesh", "convex", "seen"
LOADERS = {AS_MESH: load_mesh, AS_HULL: load_hull, AS_SEEN: load_seen}
UNNAMED = re.compile(r"[^\w-]+")


class Meshes:
    """Meshes for a world file in ``folder``; ``written`` are those to be written beside it, as glTF.

    Those that lie in ``scratch`` do not stay there, so they are written as well.
    """

    def __init__(self, convention: Convention, folder: Path, stem: str, scratch: Path) -> None:
        self.convention, self.folder, self.scratch = convention, folder, scratch
        self.beside = Path(f"{stem}-parts")
        self.written: dict[Path, bytes] = {}
        self.known: dict[tuple[Path, tuple[float, ...]], str] = {}

    def words(self, piece: Piece) -> dict[str, Any]:
        """Return the words that read the mesh of a piece in carom's axes and units."""
        assert piece.file is not None
        first, alike = piece.scale[0], len(set(piece.scale)) == 1
        stays = not piece.file.is_relative_to(self.scratch)
        if stays and alike and first > 0.0 and self.convention.hand == "right" and self.convention.up != "x":
            scale = first * self.convention.unit
            words: dict[str, Any] = {"file": self.named(piece.file)}
            words |= {"scale": scale} if scale != 1.0 else {}
            return words | ({"up": "z"} if self.convention.up == "z" else {})
        key = (piece.file, piece.scale)
        if key not in self.known:
            turn = np.eye(4)
            turn[:3, :3] = self.convention.unit * self.convention.matrix @ np.diag(piece.scale)
            self.known[key] = self.write(
                piece.file.stem, [part.copy().apply_transform(turn) for part in parts_of(piece.file)]
            )
        return {"file": self.known[key]}

    def named(self, path: Path) -> str:
        """Return the word of the world for a file."""
        return Path(os.path.relpath(path, self.folder)).as_posix()

    def image(self, piece: Piece) -> str | None:
        """Return the word for an image of heights over x and y; None where z does not become up so that they fit."""
        fits = self.convention.up == "z" and self.convention.hand == "right"
        return self.named(piece.file) if fits and piece.file is not None else None

    def write(self, name: str, parts: list[Any]) -> str:
        """Return the word of the world for a file that will hold these trimeshes."""
        import trimesh

        stem, number = UNNAMED.sub("-", name).strip("-") or "mesh", 0
        path = self.beside / f"{stem}.glb"
        while path in self.written:
            number += 1
            path = self.beside / f"{stem}-{number}.glb"
        self.written[path] = trimesh.Scene(parts).export(file_type="glb")
        return path.as_posix()

    def fault(self, piece: Piece, use: str) -> str:
        """Return why the mesh of a piece cannot be used so; nothing where it can."""
        assert piece.file is not None
        return _fault(piece.file, use)


def parts_of(path: Path) -> list[Any]:
    """Return the trimeshes of a file; raise DeclarationError."""
    return read_parts(path)


@cache
def _fault(path: Path, use: str) -> str:
    try:
        LOADERS[use](path)
    except DeclarationError as fault:
        return str(fault)
    return ""
