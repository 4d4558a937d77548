"""Options: those several commands share."""

from __future__ import annotations

import argparse
import json
from typing import Any


def declare_overrides(parser: argparse.ArgumentParser) -> None:
    """Declare the options that set aside what a world file states."""
    parser.add_argument("--collision", choices=("auto", "fcl"), help="fcl: no kernel stands in for FCL")
    parser.add_argument("--dt", help="time step, such as 1/240 or 0.5 ms")
    parser.add_argument("--integrator", choices=("euler", "semi_implicit", "verlet"))
    parser.add_argument("--seed", type=int)


def overrides(arguments: argparse.Namespace) -> dict[str, Any]:
    """Return the overrides stated on the command line, by name of the setting."""
    names = ("collision", "dt", "integrator", "seed")
    return {name: value for name in names if (value := getattr(arguments, name, None)) is not None}


def print_json(value: Any) -> None:
    """Print a result for programs."""
    print(json.dumps(value, indent=2))
