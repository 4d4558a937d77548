"""Worlds: list the worlds that come with carom, group by group."""

from __future__ import annotations

import argparse
from itertools import groupby

from carom.tools.commands.options import print_json


def declare(parser: argparse.ArgumentParser) -> None:
    """Declare no arguments."""


def execute(arguments: argparse.Namespace) -> int:
    """Print a line for each world of the library, group by group."""
    from carom.worlds import library
    from carom.worlds.reader import read

    listed = []
    for group, names in library.groups().items():
        for name in names:
            words = read(library.read_text(library.find(name), name), name).data
            listed.append({"name": name, "group": group, "title": words["name"], "description": words["description"]})
    if arguments.json:
        print_json(listed)
        return 0
    for group, worlds in groupby(listed, key=lambda world: world["group"]):
        print(group)
        for world in worlds:
            print(f"  {world['name']:<18} {world['description']}")
    return 0
