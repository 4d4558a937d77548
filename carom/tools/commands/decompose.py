"""Decompose: cut a model into convex parts, the collider of a body that moves."""

from __future__ import annotations

import argparse
from pathlib import Path
from time import perf_counter

from carom.tools.commands.options import print_json


def declare(parser: argparse.ArgumentParser) -> None:
    """Declare the model, how to read it, how finely to cut it, and where the parts go."""
    parser.add_argument("model", type=Path, metavar="MODEL", help="a closed mesh: OBJ, STL, PLY or glTF")
    parser.add_argument("-o", "--out", type=Path, required=True, metavar="FOLDER", help="where the parts are written")
    parser.add_argument("--parts", type=part_count, metavar="N", help="as many parts at most; by default what it takes")
    parser.add_argument(
        "--concavity", type=concavity, default=0.05, metavar="X",
        help="how far from convex a part may be, 0.01 to 1; 0.05 by default",
    )  # fmt: skip
    parser.add_argument("--unit", default="m", metavar="UNIT", help="unit of lengths in the model, such as mm")
    parser.add_argument("--up", default="y", choices=("y", "z"), help="axis of the model that points up")


def execute(arguments: argparse.Namespace) -> int:
    """Write the parts and print the entities that a world file needs for them."""
    from carom.systems.shapes.model_files import load_mesh
    from carom.tools.decomposition import compound, decompose, name_of
    from carom.tools.outputs import prepare_outputs

    start = perf_counter()
    model = load_mesh(arguments.model, unit=arguments.unit, up=arguments.up)
    stem = name_of(arguments.model)
    prepare_outputs([arguments.out / f"{stem}-0.ply"])
    made = decompose(model, stem, arguments.out, parts=arguments.parts, concavity=arguments.concavity)
    stated = {"unit": arguments.unit} if arguments.unit != "m" else {}
    stated |= {"up": arguments.up} if arguments.up != "y" else {}
    world, seconds = compound(arguments.model, stated, made), perf_counter() - start
    if arguments.json:
        print_json(
            {"parts": [str(part) for part in made.parts], "known": made.known, "seconds": seconds, "world": world}
        )
        return 0
    how = "known from before" if made.known else f"{seconds:.1f} s"
    print(f"# {len(made.parts)} convex parts of {arguments.model}, {how}; paths are relative to this folder")
    print(world)
    return 0


def part_count(text: str) -> int:
    """Return a whole number from 1 on; raise ArgumentTypeError for anything else."""
    if not text.isdecimal() or int(text) < 1:
        raise argparse.ArgumentTypeError(f"must be a whole number from 1 on, received {text!r}")
    return int(text)


def concavity(text: str) -> float:
    """Return a number from 0.01 to 1, as coacd takes it; raise ArgumentTypeError for anything else."""
    try:
        value = float(text)
    except ValueError:
        value = 0.0
    if not 0.01 <= value <= 1.0:
        raise argparse.ArgumentTypeError(f"must be a number from 0.01 to 1, received {text!r}")
    return value
