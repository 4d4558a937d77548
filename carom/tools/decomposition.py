"""Decomposition: a model cut into convex parts, which together are its collider; slow, so done once per content."""

from __future__ import annotations

import os
import re
import shutil
import tempfile
from hashlib import blake2b
from importlib.metadata import version
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from carom.ecs.errors import CaromError
from carom.systems.shapes.geometry import Geometry

UNNAMED = re.compile(r"[^\w-]+")


class Decomposition(NamedTuple):
    """The files of the parts, and whether they were known before."""

    parts: list[Path]
    known: bool


def decompose(model: Geometry, stem: str, folder: Path, *, parts: int | None, concavity: float) -> Decomposition:
    """Write the convex parts of a model as PLY files called after ``stem``, from the cache when they are known.

    ``concavity`` is how far a part may be from convex, as a share of the model's size; ``parts`` are the most there may
    be. Method: Wei et al., Approximate Convex Decomposition for 3D Meshes with Collision-Aware Concavity and Tree
    Search, 2022. Raises CaromError when coacd is not installed.
    """
    coacd = _coacd()
    settings = f"{version('coacd')} {parts} {concavity!r}".encode()
    kept = cache_folder() / blake2b(model.content() + settings, digest_size=16).hexdigest()
    known = kept.is_dir()
    if not known:
        coacd.set_log_level("error")
        mesh = coacd.Mesh(np.array(model.vertices), np.array(model.faces, np.int32))
        found = coacd.run_coacd(mesh, threshold=concavity, max_convex_hull=parts or -1, seed=0)
        _keep(found, kept)
    files = []
    for number, part in enumerate(sorted(kept.iterdir())):
        files.append(folder / f"{stem}-{number}.ply")
        shutil.copyfile(part, files[-1])
    return Decomposition(files, known)


def compound(model: Path, words: dict[str, str], decomposition: Decomposition) -> str:
    """Return the entities of a world file that are the model, with ``words`` on how to read it, carrying its parts."""
    name = name_of(model)
    read = "".join(f", {key}: {value}" for key, value in words.items())
    lines = [f"- {{name: {name}, body: {{}}, visual: {{mesh: {{file: {model.as_posix()}{read}}}}}}}"]
    lines += [
        f"- {{name: {part.stem}, parent: {{entity: {name}}}, collider: {{convex: {{file: {part.as_posix()}}}}}, "
        "visual: false}"
        for part in decomposition.parts
    ]
    return "\n".join(["entities:", *(f"  {line}" for line in lines)])


def name_of(model: Path) -> str:
    """Return the name of the file as that of an entity."""
    return UNNAMED.sub("-", model.stem).lstrip("-0123456789") or "model"


def cache_folder() -> Path:
    """Return where parts are kept: ``carom/parts`` in the user's cache."""
    home = os.environ.get("XDG_CACHE_HOME")
    return (Path(home) if home else Path.home() / ".cache") / "carom" / "parts"


def _keep(found: list[Any], kept: Path) -> None:
    """Write the parts all at once: a decomposition that was interrupted is not there."""
    import trimesh

    kept.parent.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(dir=kept.parent) as folder:
        made = Path(folder) / "parts"
        made.mkdir()
        for number, (vertices, faces) in enumerate(found):
            trimesh.Trimesh(vertices, faces, process=False).export(made / f"{number:06}.ply")
        made.rename(kept)


def _coacd() -> Any:
    try:
        import coacd
    except ImportError:
        raise CaromError("decompose needs coacd, which is not installed: pip install 'carom[authoring]'") from None
    return coacd
