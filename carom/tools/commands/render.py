"""Render: photograph a world at a moment."""

from __future__ import annotations

import argparse
from pathlib import Path

from carom.tools.commands.options import declare_overrides, overrides, print_json, seconds


def declare(parser: argparse.ArgumentParser) -> None:
    """Declare the world, the moment, the camera and where the picture goes."""
    parser.add_argument("world", metavar="WORLD", help="a world file, or the name of a library world")
    parser.add_argument(
        "--at", default="0 s", metavar="TIME", help="simulated time, such as 2.5s; the start by default"
    )
    parser.add_argument("--camera", metavar="NAME", help="a camera of the world; 'main' by default")
    parser.add_argument("--out", type=Path, required=True, metavar="FILE", help="the picture (.png)")
    declare_overrides(parser)


def execute(arguments: argparse.Namespace) -> int:
    """Step to the moment and write the picture."""
    from carom.tools.filming import photograph, shot_of
    from carom.tools.outputs import prepare_outputs
    from carom.tools.session import run
    from carom.worlds.builder import load_world
    from carom.worlds.run import frames_of

    moment = seconds("--at", arguments.at, least=0.0)
    loaded = load_world(arguments.world, **overrides(arguments))
    shot = shot_of(loaded, arguments.camera)
    prepare_outputs([arguments.out])
    frames = frames_of(moment, loaded.simulation.settings.dt)
    run(loaded, frames=frames)
    photograph(shot, loaded.simulation.world, arguments.out)
    result = {"picture": str(arguments.out), "frame": frames, "time": loaded.simulation.time}
    if arguments.json:
        print_json(result)
    else:
        print(f"{arguments.out}: frame {frames}, {loaded.simulation.time:g} s")
    return 0
