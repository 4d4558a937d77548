"""The ``carom`` command: one file per subcommand in `carom.tools.commands`, each imported by name."""

from __future__ import annotations

import os
import sys
from collections.abc import Sequence
from importlib import import_module

import carom
from carom.tools.arguments import Parser

COMMANDS = (
    "new",
    "run",
    "view",
    "replay",
    "diff",
    "bisect",
    "why",
    "fork",
    "shrink",
    "query",
    "salvage",
    "render",
    "check",
    "fmt",
    "upgrade",
    "test",
    "accept",
    "worlds",
    "gallery",
    "explain",
    "doctor",
    "bench",
    "schema",
    "warm",
    "decompose",
    "import",
)
DONE, FAILED, WRONG, INTERRUPTED = 0, 1, 2, 130


def main(words: Sequence[str] | None = None) -> int:
    """Run one command; return 0 when done, 1 when a check failed, 2 for wrong usage or input, 130 after Ctrl-C."""
    arguments = parser().parse_args(words)
    try:
        status = int(arguments.execute(arguments))
        sys.stdout.flush()
        return status
    except BrokenPipeError:
        # Who reads, as `head` does, has enough; Python would complain when it empties what is left at the end.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return DONE
    except KeyboardInterrupt:
        print("interrupted", file=sys.stderr)
        return INTERRUPTED
    except Exception as fault:
        from carom.ecs.errors import CaromError, NonFiniteError

        if not isinstance(fault, CaromError):
            raise
        print(fault, file=sys.stderr)
        return FAILED if isinstance(fault, NonFiniteError) else WRONG


def parser() -> Parser:
    """Return the parser of the whole command line."""
    whole = Parser(
        prog="carom",
        description="A 3D game engine whose world is a table.",
        epilog="exit status: 0 done, 1 a check failed, 2 wrong usage or input",
    )
    whole.add_argument("--version", action="version", version=f"carom {carom.__version__}")
    commands = whole.add_subparsers(metavar="COMMAND", required=True)
    for name in COMMANDS:
        module = import_module(f"carom.tools.commands.{name}")
        summary = str(module.__doc__).partition("\n")[0].partition(": ")[2].rstrip(".")
        single = commands.add_parser(name, help=summary, description=summary)
        single.add_argument("--json", action="store_true", help="print the result as JSON, for programs")
        module.declare(single)
        single.set_defaults(execute=module.execute, parser=single)
    return whole


if __name__ == "__main__":
    sys.exit(main())
