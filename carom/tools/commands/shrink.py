"""Shrink: the smallest world file in which the same expectation fails."""

from __future__ import annotations

import argparse
import dataclasses
from functools import partial
from pathlib import Path

from carom.tools.commands.options import ending, print_json, whole_number

TRIALS = 1000


def declare(parser: argparse.ArgumentParser) -> None:
    """Declare the world, the smaller one, and which expectation is meant."""
    parser.add_argument("world", metavar="WORLD", help="a world file, or the name of a library world, that fails")
    parser.add_argument(
        "-o", "--out", type=ending(".yaml", ".yml"), metavar="FILE", help="the smaller world; WORLD_small.yaml"
    )
    parser.add_argument(
        "--expect",
        type=partial(whole_number, least=1),
        metavar="N",
        help="which expectation, from 1; by default the one that fails first",
    )
    parser.add_argument(
        "--trials",
        type=partial(whole_number, least=1),
        default=TRIALS,
        metavar="N",
        help=f"at most so many worlds are simulated; {TRIALS} by default",
    )


def execute(arguments: argparse.Namespace) -> int:
    """Write the smaller world, and print how small it is and the command that shows the failure."""
    from carom.tools.outputs import prepare_outputs
    from carom.tools.shrinking.shrink import shrink

    path = Path(arguments.world)
    out = arguments.out or (path.parent if path.is_file() else Path()) / f"{path.stem}_small.yaml"
    prepare_outputs([out])
    shrunk = shrink(arguments.world, out, expect=arguments.expect, trials=arguments.trials)
    out.write_text(shrunk.text, encoding="utf-8")
    if arguments.json:
        print_json(dataclasses.asdict(shrunk) | {"command": shrunk.command})
    else:
        print(shrunk.told())
    return 0
