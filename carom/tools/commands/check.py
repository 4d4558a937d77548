"""Check: read world files, and tell everything that is wrong in them and what they can hardly mean."""

from __future__ import annotations

import argparse
import sys

from carom.tools.commands.options import print_json, print_warnings


def declare(parser: argparse.ArgumentParser) -> None:
    """Declare the worlds."""
    parser.add_argument("worlds", nargs="+", metavar="WORLD", help="world files or names of library worlds")


def execute(arguments: argparse.Namespace) -> int:
    """Print a line for each good world, every fault of each bad one; 2 when any is bad."""
    from carom.ecs.errors import CaromError
    from carom.tools.look import look_of
    from carom.worlds.builder import load_world
    from carom.worlds.lint import lint

    results = []
    for world in arguments.worlds:
        try:
            loaded = load_world(world)
            look_of(loaded)
            entities = int(loaded.simulation.world.slots.alive.sum())
            warnings = lint(loaded)
        except CaromError as fault:
            results.append({"world": world, "faults": str(fault).splitlines()})
            if not arguments.json:
                print(fault, file=sys.stderr)
            continue
        counts = {"entities": entities, "expectations": len(loaded.expectations)}
        results.append({"world": world, "faults": [], **counts, "warnings": warnings})
        print_warnings(warnings)
        if not arguments.json:
            print(f"ok     {world}: {entities} entities, {len(loaded.expectations)} expectations")
    if arguments.json:
        print_json(results)
    return 2 if any(result["faults"] for result in results) else 0
