"""Accept: make what snapshots were in a failed run their goldens."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from carom.tools.commands.options import print_json


def declare(parser: argparse.ArgumentParser) -> None:
    """Declare the report."""
    parser.add_argument("report", type=Path, metavar="REPORT", help="the folder carom-report of a run, or a zip of it")
    parser.add_argument("--yes", action="store_true", help="write without asking")


def execute(arguments: argparse.Namespace) -> int:
    """Show what would change, ask, and write; 1 when nothing was written."""
    from carom.tools.snapshot_kit.accept import accept, changes, read_report

    made = changes(read_report(arguments.report), Path.cwd())
    print("goldens to change:", *made, sep="\n", file=sys.stderr if arguments.json else sys.stdout, flush=True)
    agreed = arguments.yes or _asked(len(made))
    if agreed:
        accept(made)
    if arguments.json:
        rows = [{"golden": one.case.golden, "kind": one.case.kind, "overtaken": one.overtaken} for one in made]
        print_json({"written": agreed, "goldens": rows})
    elif not agreed:
        print("nothing was written; --yes writes without asking")
    return 0 if agreed else 1


def _asked(count: int) -> bool:
    if not sys.stdin.isatty():
        return False
    return input(f"write {'this golden' if count == 1 else f'these {count} goldens'}? [y/N] ").strip().lower() == "y"
