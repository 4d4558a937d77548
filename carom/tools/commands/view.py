"""View: open a recording in the Rerun viewer."""

from __future__ import annotations

import argparse
import os
import subprocess
import sys
from pathlib import Path

from carom.tools.commands.options import print_json

DISPLAYS = ("DISPLAY", "WAYLAND_DISPLAY")
WEB = ("--serve-web", "--bind", "127.0.0.1")


def declare(parser: argparse.ArgumentParser) -> None:
    """Declare the recording and how to show it."""
    parser.add_argument("file", type=Path, metavar="FILE", help="a recording (.rrd)")
    parser.add_argument("--web", action="store_true", help="serve it to a browser instead of opening a window")


def execute(arguments: argparse.Namespace) -> int:
    """Hand the recording to Rerun and wait until the viewer is closed."""
    from carom.ecs.errors import CaromError
    from carom.tools.viewer import viewer_binary

    if not arguments.file.is_file():
        raise CaromError(
            f"no recording at {arguments.file}; make one with: carom run billiards --record {arguments.file}"
        )
    if sys.platform == "linux" and not arguments.web and not any(map(os.environ.get, DISPLAYS)):
        raise CaromError(f"no display to open a window on; serve it instead: carom view --web {arguments.file}")
    command = [str(viewer_binary()), str(arguments.file), *(WEB if arguments.web else [])]
    if arguments.json:
        print_json({"command": command})
        return 0
    return subprocess.run(command, check=False).returncode
