"""Explain: print the frame, system by system, with what each reads, writes and adds."""

from __future__ import annotations

import argparse

from carom.tools.commands.options import print_json


def declare(parser: argparse.ArgumentParser) -> None:
    """Declare no arguments."""


def execute(arguments: argparse.Namespace) -> int:
    """Print the schedule."""
    from carom.ecs.explain import explain
    from carom.systems.places import extended
    from carom.systems.step import STEP

    frame = extended(STEP)
    if not arguments.json:
        print(explain(frame), end="")
        return 0
    repeated = {system.name for phase in frame.phases if phase.repeat for _, system in phase}  # in phases within it too
    print_json(
        [
            {
                "phase": phase.name,
                "repeated": system.name in repeated,
                "system": system.name,
                **{use: [kind.__name__ for kind in getattr(system, use)] for use in ("reads", "writes", "adds")},
            }
            for phase, system in frame
        ]
    )
    return 0
