"""Fork: what if, from a frame of a recording on: branches beside what was."""

from __future__ import annotations

import argparse
from pathlib import Path

from carom.tools.commands.options import ending, print_json, seconds, whole_number


def declare(parser: argparse.ArgumentParser) -> None:
    """Declare the recording, the frame, what is changed there, and how long it is followed."""
    parser.add_argument("file", type=Path, metavar="FILE", help="a recording (.rrd)")
    parser.add_argument("--frame", type=whole_number, required=True, metavar="N", help="frame in which they part")
    parser.add_argument(
        "--set",
        dest="sets",
        action="append",
        default=[],
        metavar="ASSIGNMENT",
        help="change of a branch: 'crate.material.friction *= 0.5', 'gravity.y = -1.62'; all of them are one branch",
    )
    parser.add_argument(
        "--branch",
        dest="branches",
        action="append",
        default=[],
        metavar="ASSIGNMENTS",
        help="a branch of its own, its assignments parted by ';'; may be stated several times",
    )
    parser.add_argument(
        "--until", metavar="TIME", help="follow them until then; to the end of the recording by default"
    )
    parser.add_argument("--out", type=ending(".rrd"), metavar="FILE", help="record all, branches as ghosts (.rrd)")


def execute(arguments: argparse.Namespace) -> int:
    """Run the branches and print where they part and what becomes of them; 1 when the recording is not reproduced."""
    from carom.ecs.errors import CaromError
    from carom.tools.forking import fork
    from carom.tools.outputs import prepare_outputs
    from carom.tools.replay import Replay

    branches = [arguments.sets] if arguments.sets else []
    branches += [[text.strip() for text in stated.split(";")] for stated in arguments.branches]
    if not branches:
        raise CaromError("--set: states what is changed, such as --set 'crate.material.friction *= 0.5'")
    if arguments.out and arguments.out.resolve() == arguments.file.resolve():
        raise CaromError(f"{arguments.out} is the recording itself; write another file")
    until = seconds("--until", arguments.until, least=0.0) if arguments.until else None
    replay = Replay(arguments.file)
    prepare_outputs([arguments.out])
    forks = fork(replay, arguments.frame, branches, until=until, out=arguments.out)
    if arguments.json:
        print_json(forks.values())
    else:
        print(forks.text())
    return 0 if forks.verdict.same else 1
