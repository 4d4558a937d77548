"""Bisect: the system in which two runs part, among all that run in that frame."""

from __future__ import annotations

import argparse

from carom.tools.commands import diff
from carom.tools.commands.options import print_json


def declare(parser: argparse.ArgumentParser) -> None:
    """Declare both runs."""
    for name, help_text in diff.SIDES.items():
        parser.add_argument(name, metavar=name.upper(), help=help_text)


def execute(arguments: argparse.Namespace) -> int:
    """Print the system with what it touches, and the one before it; 1 when they part."""
    from carom.tools.both import blame
    from carom.tools.differing import compare
    from carom.tools.side import Side

    a, b = Side(arguments.a), Side(arguments.b)
    found = compare(a, b)
    told = blame(found, a, b)
    if arguments.json:
        print_json(found.values() | {"system": told.system, "before": told.before, "touches": told.touches})
    else:
        print(told.text)
    return 0 if found.same else 1
