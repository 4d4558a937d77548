"""Doctor: say what works on this machine, and how to mend what does not."""

from __future__ import annotations

import argparse


def declare(parser: argparse.ArgumentParser) -> None:
    """Declare no arguments."""


def execute(arguments: argparse.Namespace) -> int:
    """Print what was found; 1 when something does not work."""
    from carom.tools.doctor import doctor

    return doctor(json=arguments.json)
