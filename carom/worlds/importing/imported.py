"""A model file to a world file and a report: the one way in for all formats."""

from __future__ import annotations

import tempfile
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

from carom.systems.shapes.model_files import ENDINGS
from carom.worlds.errors import Fault, WorldError
from carom.worlds.importing import gltf, mjcf, urdf
from carom.worlds.importing.convention import Convention
from carom.worlds.importing.document import Document
from carom.worlds.importing.elements import Element, Reading, read_xml
from carom.worlds.importing.files import ModelFiles
from carom.worlds.importing.meshes import Meshes
from carom.worlds.importing.report import Report
from carom.worlds.importing.writing import text_of

FORMATS = "<robot> of URDF or <mujoco> of MJCF"
SCENES = (".gltf", ".glb")
NAMED = (*ENDINGS, ".xml", ".mjcf", ".bin", ".png", ".jpg", ".jpeg")  # files that models name


@dataclass(frozen=True)
class Options:
    """How to read a model: None stands for what its format has.

    ``cut`` returns the files of the convex parts of a mesh, for ``meshes`` as parts.
    """

    up: str | None = None
    hand: str = "right"
    unit: float = 1.0
    root: Path | None = None
    base: str = "auto"
    meshes: str | None = None
    cut: Callable[[Path], list[Path]] | None = None


@dataclass
class Imported:
    """The text of a world file, files to be written beside it by their names there, and what became of the model."""

    text: str
    report: Report
    files: dict[Path, bytes] = field(default_factory=dict)

    def write_files(self, folder: Path) -> None:
        """Write the files that lie beside the world, which would lie in ``folder``."""
        for name, content in self.files.items():
            (folder / name).parent.mkdir(parents=True, exist_ok=True)
            (folder / name).write_bytes(content)


def import_model(path: Path, options: Options | None = None, *, folder: Path, stem: str = "model") -> Imported:
    """Return a model as a world file that would lie in ``folder``, with meshes that it needs in ``stem``-parts there.

    Raises WorldError with everything that is wrong with the file.
    """
    options = options or Options()
    reading, report = Reading(), Report()
    files = ModelFiles(path.parent, options.root or path.parent, NAMED, reading, report)
    with tempfile.TemporaryDirectory() as scratch:
        if path.suffix.lower() in SCENES:
            model, up, touching = gltf.read_gltf(path, files, reading, report, Path(scratch)), gltf.UP, "none"
        else:
            root = _root_of(path)
            touching = "hull"
            if root.tag == "robot":
                model, up = urdf.read_urdf(root, files, reading, report, options.base), urdf.UP
            else:
                model, up = mjcf.read_mjcf(root, files, reading, report), mjcf.UP
        convention = Convention(options.up or up, options.hand, options.unit)
        convention.model(model)
        meshes = Meshes(convention, folder, stem, Path(scratch))
        document = Document(model, meshes, options.meshes or touching, options.cut)
        length = "" if options.unit == 1.0 else f", in units of {options.unit:g} m"
        head = [f"From {path.name} by carom import; there {convention.up} is up, {convention.hand}-handed{length}."]
        return Imported(text_of(head, document.words, document.origins), report, meshes.written)


def _root_of(path: Path) -> Element:
    root = read_xml(path, str(path))
    if root.tag not in ("robot", "mujoco"):
        raise WorldError([Fault(root.file, root.line, root.column, "", "is no model", f"<{root.tag}>", FORMATS)])
    return root
