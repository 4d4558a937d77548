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
    from carom.worlds.builder import load_world

    listed = []
    for group, names in library.groups().items():
        for name in names:
            loaded = load_world(name)
            listed.append({"name": name, "group": group, "title": loaded.name, "description": loaded.description})
    if arguments.json:
        print_json(listed)
        return 0
    for group, worlds in groupby(listed, key=lambda world: world["group"]):
        print(group)
        for world in worlds:
            print(f"  {world['name']:<18} {world['description'] or world['title']}")
    return 0
