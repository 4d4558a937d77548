"""Salvage: mend a recording that was cut off, by a kill or a full disk."""

from __future__ import annotations

import argparse
from pathlib import Path

from carom.tools.commands.options import ending, print_json


def declare(parser: argparse.ArgumentParser) -> None:
    """Declare the recording and where the mended one goes."""
    parser.add_argument("file", type=Path, metavar="FILE", help="a recording (.rrd)")
    parser.add_argument("--out", type=ending(".rrd"), required=True, metavar="FILE", help="write the whole one (.rrd)")


def execute(arguments: argparse.Namespace) -> int:
    """Write what is whole of it, and tell how much that is."""
    from carom.tools.outputs import prepare_outputs
    from carom.tools.recording import refuse_missing
    from carom.tools.salvage import salvage

    broken, out = arguments.file, arguments.out
    refuse_missing(broken)
    prepare_outputs([out])
    salvaged = salvage(broken, out)
    if arguments.json:
        print_json({"out": str(out), **salvaged._asdict()})
        return 0
    if salvaged.whole:
        did = f"{broken} was whole already, and is copied"
    elif salvaged.dropped:
        did = f"kept {salvaged.kept:,} bytes, dropped {salvaged.dropped:,} of a message that was cut off"
    else:
        did = f"kept all {salvaged.kept:,} bytes, and finished them"
    print(f"{out}: {salvaged.frames} frames, {salvaged.seconds:.3f} s; {did}")
    return 0
