"""Bench: measure what carom promises, with every bound and whether it holds."""

from __future__ import annotations

import argparse
import dataclasses
import sys

from carom.tools.bench import BENCHES
from carom.tools.commands.options import print_json


def declare(parser: argparse.ArgumentParser) -> None:
    """Declare the name, and parts of it."""
    parser.add_argument("name", choices=BENCHES, metavar="NAME", help=", ".join(BENCHES))
    parser.add_argument("parts", nargs="*", metavar="PART", help="parts of benches such as detect; all unless stated")


def execute(arguments: argparse.Namespace) -> int:
    """Measure and print; 1 when a bound does not hold, or when what the bench compares with is not installed."""
    from carom.tools.bench.measure import PeerMissingError, machine, measure

    figures = []
    if not arguments.json:
        print(machine(), flush=True)
    try:
        for figure in measure(arguments.name, arguments.parts):
            figures.append(figure)
            if not arguments.json:
                print(figure, flush=True)
    except PeerMissingError as fault:
        print(fault, file=sys.stderr)
        return 1
    if arguments.json:
        rows = [{**dataclasses.asdict(figure), "holds": figure.holds} for figure in figures]
        print_json({"bench": arguments.name, "machine": machine(), "figures": rows})
    return 0 if all(figure.holds for figure in figures) else 1
