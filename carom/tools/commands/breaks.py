"""Breaks: what stops a run before a step is committed, and what is told of it."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path
from typing import TYPE_CHECKING

from carom.tools.commands.options import print_json, stated_overrides

if TYPE_CHECKING:
    from carom.ecs.errors import NonFiniteError
    from carom.systems.breakpoints import StoppedError
    from carom.systems.observer import Observer
    from carom.tools.opening import Opening
    from carom.worlds.builder import LoadedWorld

REACH = 5.0  # s that a prompt goes back, where no ring says how many


def declare_breaks(parser: argparse.ArgumentParser) -> None:
    """Declare the conditions and the prompt."""
    parser.add_argument(
        "--break",
        dest="breaks",
        action="append",
        default=[],
        metavar="CONDITION",
        help="stop before a step after which it holds: 'speed(crate) > 20', 'overlap > 1 cm', 'energy rises 5 %%', "
        "'not finite'; may be stated several times",
    )
    parser.add_argument(
        "--pdb", action="store_true", help="open a prompt on the world where a --break or a NaN stops it"
    )


class Breaks:
    """The breakpoints of a run; raises CaromError for conditions that are none, or a prompt without any."""

    def __init__(self, arguments: argparse.Namespace, loaded: LoadedWorld) -> None:
        from carom.ecs.errors import CaromError
        from carom.systems.ring import Ring
        from carom.tools.commands.options import seconds
        from carom.worlds.breaks import break_when

        if arguments.pdb and not arguments.breaks:
            raise CaromError("--pdb: goes with --break CONDITION, at which it opens")
        self._arguments, self._loaded = arguments, loaded
        break_when(loaded.simulation, *arguments.breaks, place="--break")
        reach = seconds("--ring", arguments.ring, above=0.0) if arguments.ring else REACH
        self._ring = Ring.of_seconds(reach, loaded.simulation) if arguments.pdb else None

    @property
    def observers(self) -> list[Observer]:
        """The ring that a prompt goes back in."""
        return [self._ring] if self._ring else []

    def tell(self, stopped: StoppedError, recording: Path | None) -> None:
        """Print who and where, and the command that opens it there; open the prompt if it was asked for."""
        from carom.tools.opening import place_of
        from carom.tools.stops import Prompt, text

        command = self._opening(recording).command(stopped.frame, stopped.names, self._arguments.breaks)
        told = text(stopped, self._loaded, command)
        if self._arguments.json:
            files = [place_of(self._loaded, name) for name in stopped.names]
            found = {"condition": stopped.breakpoint.text, "frame": stopped.frame, "time": stopped.time}
            found |= {"values": stopped.met.values, "entities": stopped.names, "files": files, "command": command}
            print_json({"stopped": found})
        elif self._ring:
            Prompt(self._loaded.simulation, stopped, self._ring).open(told)
        else:
            print(told)

    def tell_not_finite(self, fault: NonFiniteError, recorded: str) -> None:
        """Print what was no number, in a prompt if it was asked for, or else with the command that opens it."""
        from carom.tools.stops import Prompt

        if self._ring:
            Prompt(self._loaded.simulation, fault, self._ring).open(f"{fault}{recorded}")
        else:
            recorded = recorded or f"\nopen it with: {self._opening(None).of_no_number()}"
            print(f"{fault}{recorded}", file=sys.stderr)

    def _opening(self, recording: Path | None) -> Opening:
        from carom.tools.opening import Opening

        return Opening(self._loaded, self._arguments.world, stated_overrides(self._arguments), recording)
