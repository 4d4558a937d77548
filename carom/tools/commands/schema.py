"""Schema: print the JSON Schema of world files, for editors."""

from __future__ import annotations

import argparse

from carom.tools.commands.options import print_json


def declare(parser: argparse.ArgumentParser) -> None:
    """Declare no arguments."""


def execute(arguments: argparse.Namespace) -> int:
    """Print the schema; it is JSON with and without ``--json``."""
    from carom.worlds.schema import json_schema

    print_json(json_schema())
    return 0
