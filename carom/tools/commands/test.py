"""Test: run worlds to their end and hold what they expect."""

from __future__ import annotations

import argparse
import dataclasses
from typing import Any

from carom.tools.commands.options import declare_overrides, overrides, print_json, stated_overrides


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
    results = []
    for world in worlds:
        result, lines = _result(world, arguments)
        results.append(result)
        if not arguments.json:
            held = result["expectations"] - len(result["failures"])
            verdict = "FAILED" if result["failures"] else "ok"
            print(f"{verdict:<7}{world}: {held} of {result['expectations']} expectations held")
            print("".join(f"       {line}\n" for line in lines), end="")
    if arguments.json:
        print_json(results)
    return 1 if any(result["failures"] for result in results) else 0


def _result(world: str, arguments: argparse.Namespace) -> tuple[dict[str, Any], list[str]]:
    """Return what became of a world for programs, and the lines of what failed for people."""
    from carom.ecs.errors import NonFiniteError
    from carom.tools.opening import Opening
    from carom.tools.session import run
    from carom.worlds.builder import load_world

    loaded = load_world(world, **overrides(arguments))
    opening = Opening(loaded, world, stated_overrides(arguments))
    result: dict[str, Any] = {"path": world, "expectations": len(loaded.expectations)}
    try:
        summary = run(loaded)
    except NonFiniteError as fault:
        told = {"text": str(fault), "frame": fault.frame, "command": opening.of_no_number()}
        return result | {"failures": [told]}, [str(fault), f"  open it with: {told['command']}"]
    lines = [line for failed in summary.failures for line in opening.lines(failed)]
    failures = list(map(opening.told, summary.failures))
    return result | dataclasses.asdict(summary) | {"failures": failures}, lines
