"""Doctor: say what works on this machine, and how to mend what does not."""

import argparse


def declare(parser: argparse.ArgumentParser) -> None:
    """Declare no arguments."""


def execute(arguments: argparse.Namespace) -> int:
    """X."""
    return 0
