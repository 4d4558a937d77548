"""Check: read world files, and tell everything that is wrong in them and what they can hardly mean."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from carom.tools.commands.options import print_json, print_warnings


def declare(parser: argparse.ArgumentParser) -> None:
    """Declare the worlds."""
    parser.add_argument("worlds", nargs="+", metavar="WORLD", help="world files or names of library worlds")
    parser.add_argument("--fix", action="store_true", help="first mend what can be mended without guessing, in form")


def execute(arguments: argparse.Namespace) -> int:
    """Print a line for each good world, every fault of each bad one; 2 when any is bad."""
    from carom.ecs.errors import CaromError
    from carom.tools.look import look_of
    from carom.worlds.builder import load_world
    from carom.worlds.lint import lint

    results = []
    for world in arguments.worlds:
        fixed: list[str] = []
        try:
            fixed = _fix(Path(world)) if arguments.fix else []
            if not arguments.json:
                print("".join(f"fixed  {world}: {line}\n" for line in fixed), end="")
            loaded = load_world(world)
            look_of(loaded)
            entities = int(loaded.simulation.world.slots.alive.sum())
            warnings = lint(loaded)
        except CaromError as fault:
            results.append({"world": world, "fixed": fixed, "faults": str(fault).splitlines()})
            if not arguments.json:
                print(fault, file=sys.stderr)
            continue
        counts = {"entities": entities, "expectations": len(loaded.expectations)}
        results.append({"world": world, "fixed": fixed, "faults": [], **counts, "warnings": warnings})
        print_warnings(warnings)
        if not arguments.json:
            print(f"ok     {world}: {entities} entities, {len(loaded.expectations)} expectations")
    if arguments.json:
        print_json(results)
    return 2 if any(result["faults"] for result in results) else 0


def _fix(path: Path) -> list[str]:
    """Mend a file; return what was done."""
    from carom.ecs.errors import CaromError
    from carom.worlds import library
    from carom.worlds.mending import mended

    if not path.is_file():
        raise CaromError(f"{path}: is no file; --fix writes files, so state one")
    text, done = mended(library.read_text(path, str(path)), str(path), path.parent)
    if done:
        path.write_text(text, encoding="utf-8", newline="\n")
    return done
