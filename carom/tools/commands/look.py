"""Look: the options on how pictures are drawn."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from carom.tools.look import Look
    from carom.worlds.builder import LoadedWorld


def declare_look(parser: argparse.ArgumentParser) -> None:
    """Declare what is drawn over bodies, and what their colour tells."""
    parser.add_argument("--overlay", metavar="NAMES", help="drawn over the bodies, such as contacts,velocities,stamp")
    parser.add_argument("--color", metavar="MODE", help="what the colour of bodies tells, such as speed")
    parser.add_argument(
        "--plot", nargs="+", metavar="WHAT", help="a quantity over time in a corner, such as energy or speed(ball)"
    )
    parser.add_argument("--wireframe", action="store_true", default=None, help="draw bodies as their edges only")


def look(arguments: argparse.Namespace, loaded: LoadedWorld) -> Look:
    """Return the look of a world with what the command line states; raise CaromError for unknown names."""
    from carom.tools.look import look_of

    overlays = None if arguments.overlay is None else listed(arguments.overlay)
    return look_of(loaded, overlays, arguments.color, arguments.wireframe, arguments.plot)


def listed(text: str) -> list[str]:
    """Return the names in a text with commas between them."""
    return [name for part in text.split(",") if (name := part.strip())]
