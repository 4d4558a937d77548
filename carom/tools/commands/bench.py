"""Bench: measure what carom promises, with every bound and whether it holds."""

import argparse


def declare(parser: argparse.ArgumentParser) -> None:
    """Declare no arguments."""


def execute(arguments: argparse.Namespace) -> int:
    """X."""
    return 0
