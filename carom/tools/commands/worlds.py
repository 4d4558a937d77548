"""Worlds: list the worlds that come with carom."""

from __future__ import annotations

import argparse

from carom.tools.commands.options import print_json


def declare(parser: argparse.ArgumentParser) -> None:
    """Declare no arguments."""


def execute(arguments: argparse.Namespace) -> int:
    """Print a line for each world of the library."""
    from carom.worlds import library
    from carom.worlds.builder import load_world

    listed = []
    for name in library.names():
        loaded = load_world(name)
        listed.append({"name": name, "title": loaded.name, "description": loaded.description})
    if arguments.json:
        print_json(listed)
    for world in listed if not arguments.json else ():
        print(f"{world['name']:<16} {world['title']}")
    return 0
