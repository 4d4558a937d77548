"""Warm: compile the kernels into the cache, once for all later runs."""

from __future__ import annotations

import argparse
import sys
from time import perf_counter

from carom.tools.commands.options import print_json


def declare(parser: argparse.ArgumentParser) -> None:
    """Declare what is printed instead."""
    parser.add_argument(
        "--key", action="store_true", help="compile nothing; print a key for the cache, another one where that is stale"
    )


def execute(arguments: argparse.Namespace) -> int:
    """Compile every kernel, saying so before it begins."""
    from carom.systems.kernels.warm import key_of_cache, warm
    from carom.tools.strokes import compile_strokes

    if arguments.key:
        key = key_of_cache()
        print_json({"key": key}) if arguments.json else print(key)
        return 0
    print("compiling the kernels, which takes a minute or two the first time ...", file=sys.stderr, flush=True)
    start = perf_counter()
    warm(compile_strokes)
    seconds = perf_counter() - start
    if arguments.json:
        print_json({"seconds": seconds})
    else:
        print(f"kernels are ready ({seconds:.1f} s)")
    return 0
