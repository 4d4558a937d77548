"""Test: run worlds to their end and hold what they expect."""

from __future__ import annotations

import argparse
import dataclasses
from typing import Any

from carom.tools.commands.options import declare_overrides, overrides, print_json


def declare(parser: argparse.ArgumentParser) -> None:
    """Declare the worlds and what to override."""
    parser.add_argument("worlds", nargs="*", metavar="WORLD", help="world files or names of library worlds")
    parser.add_argument("--all", action="store_true", help="every world of the library")
    declare_overrides(parser)


def execute(arguments: argparse.Namespace) -> int:
    """Run each world and print a line for it; 1 when an expectation of any failed."""
    from carom.ecs.errors import CaromError
    from carom.worlds import library

    worlds = [*arguments.worlds, *(library.names() if arguments.all else [])]
    if not worlds:
        raise CaromError("no world to test; accepted: world files, names of library worlds, or --all")
    results = [_result(world, overrides(arguments)) for world in worlds]
    if arguments.json:
        print_json(results)
    for result in results if not arguments.json else ():
        held = result["expectations"] - len(result["failures"])
        verdict = "FAILED" if result["failures"] else "ok"
        print(f"{verdict:<7}{result['path']}: {held} of {result['expectations']} expectations held")
        for failure in result["failures"]:
            print(f"       {failure}")
    return 1 if any(result["failures"] for result in results) else 0


def _result(world: str, options: dict[str, Any]) -> dict[str, Any]:
    from carom.ecs.errors import NonFiniteError
    from carom.tools.session import run
    from carom.worlds.builder import load_world

    loaded = load_world(world, **options)
    try:
        return {"path": world, **dataclasses.asdict(run(loaded))}
    except NonFiniteError as fault:
        return {"path": world, "expectations": len(loaded.expectations), "failures": [str(fault)]}
