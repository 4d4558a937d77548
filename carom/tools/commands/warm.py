"""Warm: compile the kernels into the cache, once for all later runs."""

from __future__ import annotations

import argparse
import sys
from time import perf_counter

from carom.tools.commands.options import print_json


def declare(parser: argparse.ArgumentParser) -> None:
    """Declare no arguments."""


def execute(arguments: argparse.Namespace) -> int:
    """Compile every kernel, saying so before it begins."""
    print("compiling the kernels, which takes some seconds the first time ...", file=sys.stderr, flush=True)
    start = perf_counter()
    from carom.systems.kernels.warm import warm

    warm()
    seconds = perf_counter() - start
    if arguments.json:
        print_json({"seconds": seconds})
    else:
        print(f"kernels are ready ({seconds:.1f} s)")
    return 0
