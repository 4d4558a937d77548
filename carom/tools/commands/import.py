"""Import: write a model of another program as a world file, and tell what became of it."""

from __future__ import annotations

import argparse
from pathlib import Path

from carom.tools.commands.options import ending, print_json, quantity

CONCAVITY = 0.05  # how far from convex parts of meshes may be, as of carom decompose


def declare(parser: argparse.ArgumentParser) -> None:
    """Declare the model, what its axes and units are, and where the world goes."""
    parser.add_argument("model", type=Path, metavar="MODEL", help="URDF, MJCF or glTF")
    parser.add_argument(
        "-o", "--out", type=ending(".yaml", ".yml"), metavar="WORLD", help="the world file; MODEL.yaml here by default"
    )
    parser.add_argument(
        "--up", choices=("x", "y", "z"), help="axis of the model that points up, by default its format's"
    )
    parser.add_argument("--handedness", choices=("right", "left"), default="right", help="of the model's axes; right")
    parser.add_argument("--units", default="1", metavar="X", help="length of the model's unit, such as 0.01 or '1 cm'")
    parser.add_argument(
        "--root", type=Path, metavar="FOLDER", help="files it names lie below; its own folder by default"
    )
    parser.add_argument(
        "--base", choices=("auto", "fixed", "free"), default="auto",
        help="whether the first link of a URDF stands still; auto: where it has no mass",
    )  # fmt: skip
    parser.add_argument(
        "--meshes", choices=("hull", "parts", "none"), help="how meshes touch: URDF and MJCF hull, glTF none by default"
    )
    parser.add_argument("--strict", action="store_true", help="exit with 1 when anything was not kept as it is")


def execute(arguments: argparse.Namespace) -> int:
    """Write the world and print the report; 1 with --strict when anything was approximated or dropped."""
    from carom.ecs.errors import CaromError
    from carom.systems.shapes.model_files import load_mesh
    from carom.tools.decomposition import decompose, name_of
    from carom.tools.outputs import prepare_outputs
    from carom.worlds.builder import load_world
    from carom.worlds.importing import Options, import_model

    out = arguments.out or Path(arguments.model.stem + ".yaml")
    if arguments.root is not None and not arguments.root.is_dir():
        raise CaromError(f"--root: is no folder; received {str(arguments.root)!r}")
    unit = quantity("--units", arguments.units, "m", above=0.0)
    beside = out.parent / f"{out.stem}-parts"

    def cut(mesh: Path) -> list[Path]:
        model = load_mesh(mesh)
        return decompose(model, name_of(mesh), beside, parts=None, concavity=CONCAVITY).parts

    options = Options(arguments.up, arguments.handedness, unit, arguments.root, arguments.base, arguments.meshes, cut)
    made = import_model(arguments.model, options, folder=out.parent, stem=out.stem)
    files = [out.parent / name for name in made.files]
    prepare_outputs([out, *files])
    made.write_files(out.parent)
    out.write_text(made.text, encoding="utf-8")
    load_world(out)
    if arguments.json:
        print_json({"world": str(out), "files": [str(path) for path in files], **made.report.as_data()})
    else:
        print("\n".join([*made.report.lines(), f"written to    {out}"]))
    return int(arguments.strict and not made.report.exact)
