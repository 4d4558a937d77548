"""Upgrade: bring a world file of an earlier version of the format to today's; comments stay."""

from __future__ import annotations

import argparse
from pathlib import Path

from carom.tools.commands.options import print_json


def declare(parser: argparse.ArgumentParser) -> None:
    """Declare the file."""
    parser.add_argument("file", type=Path, metavar="FILE", help="world file")


def execute(arguments: argparse.Namespace) -> int:
    """Write the file where it is of an earlier version, and say so."""
    from carom.worlds import library
    from carom.worlds.header import VERSION
    from carom.worlds.upgrading import upgraded

    path = arguments.file
    text, before = upgraded(library.read_text(path, str(path)), str(path))
    if before != VERSION:
        path.write_text(text, encoding="utf-8", newline="\n")
    if arguments.json:
        print_json({"file": str(path), "from": before, "to": VERSION})
    elif before == VERSION:
        print(f"{path} is of version {VERSION}, the current one")
    else:
        print(f"{path} was of version {before} and is now of version {VERSION}")
    return 0
