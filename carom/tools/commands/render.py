"""Render: photograph a world at a moment, film it, or show its motion in one picture."""

from __future__ import annotations

import argparse
import math
from collections.abc import Mapping
from dataclasses import replace

from carom.tools.commands.look import declare_look, look
from carom.tools.commands.motion import KINDS, declare_motion, idle, motion
from carom.tools.commands.options import (
    declare_overrides,
    ending,
    overrides,
    picture_size,
    print_json,
    print_warnings,
    seconds,
)


def declare(parser: argparse.ArgumentParser) -> None:
    """Declare the world, what to show of it, from where, and where that goes."""
    parser.add_argument("world", metavar="WORLD", help="a world file, or the name of a library world")
    parser.add_argument("--out", type=ending(".png"), metavar="FILE", help="write a picture of one moment (.png)")
    parser.add_argument(
        "--depth",
        type=ending(".npy", ".png"),
        metavar="FILE",
        help="write its depths: metres (.npy) or millimetres (.png)",
    )
    parser.add_argument(
        "--ids", type=ending(".npy"), metavar="FILE", help="write whose each of its pixels is, by row (.npy)"
    )
    parser.add_argument("--at", metavar="TIME", help="its simulated time, such as 2.5s; the start by default")
    declare_motion(parser)
    parser.add_argument(
        "--camera", metavar="NAME[,...]", help="cameras of the world, each with files of its own; 'main' by default"
    )
    parser.add_argument("--size", type=picture_size, metavar="WxH", help="of each picture, px; the world's by default")
    declare_look(parser)
    declare_overrides(parser)


def execute(arguments: argparse.Namespace) -> int:
    """Step to the moment or through the motion, and write what was asked for."""
    from carom.ecs.errors import CaromError
    from carom.tools.filming import shot_of
    from carom.tools.outputs import prepare_outputs
    from carom.tools.painter import Painter
    from carom.tools.renderer import Renderer
    from carom.tools.session import run
    from carom.tools.stills import Stills
    from carom.tools.vantage import vantage_warnings
    from carom.worlds.builder import load_world
    from carom.worlds.run import frames_of

    motions = {kind: [path] for kind in KINDS if (path := getattr(arguments, kind))}
    stills = Stills(arguments.out, arguments.depth, arguments.ids)
    names = (arguments.camera or "").split(",")
    taken = stills.paths(names)
    if faults := [*idle(arguments), *useless(arguments, motions, taken)]:
        raise CaromError("\n".join(faults))
    moment = seconds("--at", arguments.at or "0 s", least=0.0)
    loaded = load_world(arguments.world, **overrides(arguments))
    shots = {name: shot_of(loaded, name or None, look(arguments, loaded)) for name in names}
    if arguments.size:
        width, height = arguments.size
        shots = {name: replace(shot, width=width, height=height) for name, shot in shots.items()}
    dt = loaded.simulation.settings.dt
    print_warnings(loaded.warnings)
    observers, end = motion(arguments, loaded, shots[names[0]])
    written = taken | motions
    if motions:
        print_warnings(vantage_warnings(shots[names[0]], loaded.simulation))
    prepare_outputs(path for paths in written.values() for path in paths)
    if observers:
        run(loaded, observers, frames=None if math.isinf(end) else frames_of(end, dt))
    if taken:
        loaded = load_world(arguments.world, **overrides(arguments)) if observers else loaded
        shot = shots[names[0]]
        with Renderer(shot.width, shot.height) as renderer:  # before the run, since a size may be refused
            painter = Painter(loaded.simulation, shot.look)
            run(loaded, [painter], frames=frames_of(moment, dt))
            print_warnings([line for shot in shots.values() for line in vantage_warnings(shot, loaded.simulation)])
            stills.save(renderer, shots, loaded.simulation, painter)
    simulation = loaded.simulation
    if arguments.json:
        files = {kind: [*map(str, paths)] if len(paths) > 1 else str(paths[0]) for kind, paths in written.items()}
        print_json({**files, "frame": simulation.frame, "time": simulation.time})
    else:
        listed = ", ".join(str(path) for paths in written.values() for path in paths)
        print(f"{listed}: frame {simulation.frame}, {simulation.time:g} s")
    return 0


def useless(arguments: argparse.Namespace, motions: Mapping[str, object], taken: Mapping[str, object]) -> list[str]:
    """Return what is wrong with what is to be written."""
    faults = []
    if arguments.at is not None and not taken:
        faults.append("--at: goes with --out, --depth or --ids")
    if not motions and not taken:
        faults.append("nothing to write; accepted: --out, --depth, --ids, --film, --sheet, --strobe")
    if motions and "," in (arguments.camera or ""):
        faults.append(f"--camera: several go with --out, --depth and --ids, and one with --{next(iter(motions))}")
    return faults
