"""Motion: the options by which films, sheets and stroboscopic pictures are asked for."""

from __future__ import annotations

import argparse
import math
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from carom.tools.commands.options import ending, factor, named, quantity, seconds, whole_number

if TYPE_CHECKING:
    from carom.systems.observer import Observer
    from carom.tools.filming import Shot
    from carom.worlds.builder import LoadedWorld

KINDS = ("film", "sheet", "strobe")
PARTS = {"fps": "film", "speed": "film", "count": "sheet", "every": "strobe", "strobe_of": "strobe"}
SPAN = {"start": "--from", "to": "--to", "duration": "--duration"}
SHEET_COUNT, SHEET_WIDTH = 9, 320  # pictures, and how wide each is (px) unless a size is stated
STROBE_INTERVAL = "0.1 s"


def declare_motion(parser: argparse.ArgumentParser) -> None:
    """Declare what shows a motion, and which part of it."""
    option = parser.add_argument
    option("--film", type=Path, metavar="FILE", help="write a film (.mp4, .webp or .gif)")
    option("--fps", metavar="RATE", help="pictures per second of film; the world's by default")
    option("--speed", metavar="X", help="how fast the film plays, such as 0.25x for slow motion")
    option("--sheet", type=ending(".png"), metavar="FILE", help="write a sheet of pictures with their times (.png)")
    option(
        "--count", type=partial(whole_number, least=1), metavar="N", help=f"pictures of it; {SHEET_COUNT} by default"
    )
    option("--strobe", type=ending(".png"), metavar="FILE", help="write one picture of the whole motion (.png)")
    option("--every", metavar="TIME", help=f"time between the instants of it; {STROBE_INTERVAL} by default")
    option("--strobe-of", nargs="+", metavar="NAME", help="bodies that it shows in motion; all by default")
    option("--from", dest="start", metavar="TIME", help="begin film, sheet or strobe then; at 0 s by default")
    option("--to", metavar="TIME", help="end them then; with the world's run by default")
    option("--duration", metavar="TIME", help="how long they take, instead of --to")


def idle(arguments: argparse.Namespace) -> list[str]:
    """Return what is wrong with the options together: what belongs to something that is not asked for."""
    stated = {name for name, value in vars(arguments).items() if value is not None}
    lone = [(name, kind) for name, kind in PARTS.items() if name in stated and kind not in stated]
    faults = [f"--{name.replace('_', '-')}: goes with --{kind}" for name, kind in lone]
    if not stated & set(KINDS):
        faults += [f"{word}: goes with --film, --sheet or --strobe" for name, word in SPAN.items() if name in stated]
    if {"to", "duration"} <= stated:
        faults.append("--to and --duration: state one of them")
    return faults


def motion(arguments: argparse.Namespace, loaded: LoadedWorld, shot: Shot) -> tuple[list[Observer], float]:
    """Return the observers that show what was asked for, and until when (s); raise CaromError.

    Infinity is the end of the world's run.
    """
    from carom.tools.filming import Filming
    from carom.tools.moments import every
    from carom.tools.sheet import Sheet, spread
    from carom.tools.strobe import Strobe

    if not any(getattr(arguments, kind) for kind in KINDS):
        return [], 0.0
    start, end = span(arguments, loaded)
    found: list[Observer] = []
    if arguments.film:
        fps = shot.fps if arguments.fps is None else quantity("--fps", arguments.fps, "Hz", above=0.0)
        speed = factor("--speed", arguments.speed or "1x")
        found.append(Filming(replace(shot, fps=fps), arguments.film, every(speed / fps, start, end)))
    if arguments.sheet:
        small = replace(shot, width=SHEET_WIDTH, height=round(SHEET_WIDTH * shot.height / shot.width))
        times = spread(start, end, arguments.count or SHEET_COUNT)
        found.append(Sheet(shot if arguments.size else small, arguments.sheet, times))
    if arguments.strobe:
        interval = seconds("--every", arguments.every or STROBE_INTERVAL, above=0.0)
        entities = named("--strobe-of", arguments.strobe_of, loaded)
        found.append(Strobe(shot, arguments.strobe, every(interval, start, end), entities))
    return found, end


def span(arguments: argparse.Namespace, loaded: LoadedWorld) -> tuple[float, float]:
    """Return from when to when (s) to look, infinity being the end of the world's run."""
    from carom.ecs.errors import CaromError

    start = seconds("--from", arguments.start or "0 s", least=0.0)
    if arguments.duration is not None:
        return start, start + seconds("--duration", arguments.duration, above=0.0)
    end = length(arguments, loaded) if arguments.to is None else seconds("--to", arguments.to)
    if not start < end:
        option = "the world's run ends" if arguments.to is None else "--to is"
        raise CaromError(f"--from: must come before the end; received {start:g} s, and {option} at {end:g} s")
    return start, end


def length(arguments: argparse.Namespace, loaded: LoadedWorld) -> float:
    """Return how long (s) a world runs, infinity for until it rests; for a sheet it is run to find out."""
    from carom.tools.commands.options import overrides
    from carom.tools.session import run
    from carom.worlds.builder import load_world

    if loaded.run.rest_speed is None:
        return loaded.run.frames * loaded.simulation.settings.dt
    if not arguments.sheet:
        return math.inf
    return run(load_world(arguments.world, **overrides(arguments))).simulated_seconds
