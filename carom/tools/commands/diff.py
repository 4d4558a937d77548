"""Diff: where two runs part: frame, system, entity, column, and whether that grew or comes in again."""

from __future__ import annotations

import argparse

from carom.tools.commands.options import ending, print_json

SIDES = {"a": "a recording (.rrd), a world file, or the name of a library world", "b": "what it is compared with"}


def declare(parser: argparse.ArgumentParser) -> None:
    """Declare both runs, and a recording of where they part."""
    for name, help_text in SIDES.items():
        parser.add_argument(name, metavar=name.upper(), help=help_text)
    parser.add_argument(
        "--out", type=ending(".rrd"), metavar="FILE", help="record both from where they are last the same (.rrd)"
    )


def execute(arguments: argparse.Namespace) -> int:
    """Print where they part; 1 when they do."""
    from carom.tools.both import record_both
    from carom.tools.differing import compare
    from carom.tools.outputs import prepare_outputs
    from carom.tools.side import Side

    a, b = Side(arguments.a), Side(arguments.b)
    prepare_outputs([arguments.out])
    found = compare(a, b)
    written = record_both(found, a, b, arguments.out) if arguments.out else ""
    if arguments.json:
        print_json(found.values() | ({"out": str(arguments.out)} if written.startswith("open") else {}))
    else:
        print("\n".join(filter(None, (found.text(), written))))
    return 0 if found.same else 1
