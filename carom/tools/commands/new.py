"""New: make a small project, a world with a system in Python and tests that pass."""

from __future__ import annotations

import argparse
import json
import keyword
import re
import sys
from importlib.resources import files
from importlib.resources.abc import Traversable
from pathlib import Path
from string import Template

from carom.tools.commands.options import print_json

NAME = re.compile(r"[a-z][a-z0-9_]*")
PACKAGE = "package"  # the folder that is called like the project
TAKEN = ("tests", "worlds", "carom", "pytest")


def declare(parser: argparse.ArgumentParser) -> None:
    """Declare the name."""
    parser.add_argument("name", type=_name, metavar="NAME", help="of the project, its folder and its package")


def _name(text: str) -> str:
    known = text in TAKEN or keyword.iskeyword(text) or text in sys.stdlib_module_names
    if not NAME.fullmatch(text) or known:
        why = "is taken" if known else "is no name of a package"
        raise argparse.ArgumentTypeError(f"{text!r} {why}; state a small letter, then small letters, digits or _")
    return text


def execute(arguments: argparse.Namespace) -> int:
    """Write the project into a folder of its name, and print how to go on; 2 when there is one."""
    from carom.ecs.errors import CaromError
    from carom.worlds.layout.form import SCHEMA_FILE
    from carom.worlds.schema import json_schema

    folder = Path(arguments.name)
    if folder.exists():
        raise CaromError(f"{folder} is there already; state another name, or remove it")
    written = _write(files("carom.tools").joinpath("project"), folder, arguments.name)
    schema = folder / "worlds" / SCHEMA_FILE  # beside the world, so that editors need no network
    schema.write_text(json.dumps(json_schema(), indent=2) + "\n", encoding="utf-8")
    written.append(schema)
    if arguments.json:
        print_json({"folder": str(folder), "files": [str(path) for path in written]})
        return 0
    print("\n".join(f"  {path}" for path in written))
    print(f"next: cd {folder}; pytest; carom run worlds/first.yaml --film out/first.mp4")
    return 0


def _write(template: Traversable, folder: Path, name: str) -> list[Path]:
    """Write a folder of templates, each without its last suffix; return the paths of the files."""
    folder.mkdir()
    written: list[Path] = []
    for item in sorted(template.iterdir(), key=lambda item: item.name):
        if item.is_dir():
            written += _write(item, folder / (name if item.name == PACKAGE else item.name), name)
        else:
            path = folder / item.name.removesuffix(".txt")
            path.write_text(Template(item.read_text(encoding="utf-8")).substitute(name=name), encoding="utf-8")
            written.append(path)
    return written
