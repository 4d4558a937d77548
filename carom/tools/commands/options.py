"""Options: those several commands share."""

from __future__ import annotations

import argparse
import json
import re
import sys
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from carom.worlds.builder import LoadedWorld


def declare_overrides(parser: argparse.ArgumentParser) -> None:
    """Declare the options that set aside what a world file states."""
    parser.add_argument("--collision", choices=("auto", "fcl"), help="fcl: no kernel stands in for FCL, but on meshes")
    parser.add_argument("--dt", metavar="TIME", help="time step, such as 1/240 or 0.5ms")
    parser.add_argument("--integrator", choices=("euler", "semi_implicit", "verlet"))
    parser.add_argument("--seed", type=int, metavar="N")


def overrides(arguments: argparse.Namespace) -> dict[str, Any]:
    """Return the overrides stated on the command line, by name of the setting; raise CaromError for a wrong dt."""
    names = ("collision", "integrator", "seed")
    found = {name: value for name in names if (value := getattr(arguments, name)) is not None}
    return found if arguments.dt is None else found | {"dt": seconds("--dt", arguments.dt, above=0.0)}


def stated_overrides(arguments: argparse.Namespace) -> list[str]:
    """Return the words by which the overrides were stated."""
    stated = {option: getattr(arguments, option) for option in ("collision", "dt", "integrator", "seed")}
    return [word for option, value in stated.items() if value is not None for word in (f"--{option}", str(value))]


def declare_detail(parser: argparse.ArgumentParser) -> None:
    """Declare how much a recording holds."""
    parser.add_argument(
        "--detail", choices=("light", "full", "solver"), help="how much the recording holds; as the world file says"
    )


def detail(arguments: argparse.Namespace, stated: str, recorded: bool, how: str) -> str:
    """Return the detail of the command line or else that of the world; raise CaromError where nothing is recorded."""
    from carom.ecs.errors import CaromError

    if arguments.detail and not recorded:
        raise CaromError(f"--detail: goes with {how}, the recording it is of")
    return arguments.detail or stated


def named(option: str, patterns: list[str] | None, loaded: LoadedWorld) -> list[int] | None:
    """Return the entities that patterns of names mean, None for none stated; raise CaromError, naming the option."""
    from carom.ecs.errors import CaromError
    from carom.worlds.errors import WordError
    from carom.worlds.names import matching

    if patterns is None:
        return None
    world = loaded.simulation.world
    try:
        return [world.find(name) for pattern in patterns for name in matching(pattern, world.names())]
    except WordError as fault:
        raise CaromError(fault.line(option)) from None


def seconds(option: str, text: str, **bounds: float) -> float:
    """Return a time (s) as world files write it; raise CaromError, naming the option, for anything else."""
    return quantity(option, text, "s", **bounds)


def factor(option: str, text: str) -> float:
    """Return a factor such as ``0.25x``; raise CaromError, naming the option, for anything else."""
    return quantity(option, text.removesuffix("x"), "1", above=0.0)


def quantity(option: str, text: str, unit: str, **bounds: float) -> float:
    """Return a value in ``unit`` as world files write it; raise CaromError, naming the option, for anything else."""
    from carom.ecs.errors import CaromError
    from carom.worlds.errors import WordError
    from carom.worlds.units import read_quantity

    try:
        return read_quantity(text, unit, **bounds)
    except WordError as fault:
        raise CaromError(fault.line(option)) from None


def whole_number(text: str, least: int = 0) -> int:
    """Return a whole number from ``least`` on; raise ArgumentTypeError for anything else."""
    if not text.isdecimal() or int(text) < least:
        raise argparse.ArgumentTypeError(f"must be a whole number from {least} on, received {text!r}")
    return int(text)


def ending(*suffixes: str) -> Callable[[str], Path]:
    """Return what reads the path of a file; it raises ArgumentTypeError for another suffix than these."""

    def read(text: str) -> Path:
        path = Path(text)
        if path.suffix.lower() not in suffixes:
            raise argparse.ArgumentTypeError(f"must end in {' or '.join(suffixes)}, received {text!r}")
        return path

    return read


def picture_size(text: str) -> tuple[int, int]:
    """Return the width and height (px) of pictures; raise ArgumentTypeError for anything else."""
    found = re.fullmatch(r"([1-9]\d{0,4})x([1-9]\d{0,4})", text)
    if found is None:
        raise argparse.ArgumentTypeError(f"must be a width and a height in px such as 1280x720, received {text!r}")
    return int(found[1]), int(found[2])


def print_warnings(warnings: list[str]) -> None:
    """Print what a user should know although all went on, so that it does not mix with the result."""
    for warning in warnings:
        print(f"warning: {warning}", file=sys.stderr)


def print_json(value: Any) -> None:
    """Print a result for programs."""
    print(json.dumps(value, indent=2))
