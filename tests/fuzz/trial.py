"""A trial: what carom does with a mutant, which must end in a world or in whole sentences of its own."""

from __future__ import annotations

import re
import warnings
from pathlib import Path

from mutants import mutant

from carom.ecs.errors import CaromError
from carom.worlds import WorldError, load_world
from carom.worlds.builder import LoadedWorld
from carom.worlds.lint import lint

MOST_STEPPED, MOST_SUBSTEPS = 60, 20  # entities and substeps of a world that takes steps; others are only loaded
LONGEST_LINE = 3000
PLACE = re.compile(r"(world|part)\.yaml(?::(\d+):(\d+))?: \S.*")
INNER = re.compile(r"<class|<built-in|<function| object at 0x|Traceback|np\.\w+\(|Annotated\[|mappingproxy|_\w+Error\b")


class FindingError(Exception):
    """Carom did with a mutant what it must not do."""


def trial(case: int, folder: Path) -> str:
    """Hand a mutant in, alone in a folder; return how it ended, or raise FindingError, or what carom let through."""
    files = mutant(case)
    for path in folder.glob("*.yaml"):
        if path.is_file():
            path.unlink()
    for name, data in files.items():
        (folder / name).write_bytes(data)
    (folder / "folder.yaml").mkdir(exist_ok=True)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", RuntimeWarning)  # of numbers beyond all bounds, which the world then has
        ended = outcome(folder / "world.yaml")
    if there := sorted(path.name for path in folder.iterdir() if path.name not in {*files, "folder.yaml"}):
        raise FindingError(f"wrote {', '.join(there)}")
    return ended


def outcome(path: Path) -> str:
    """Load a world, and look at it as check and run do; return how that ended."""
    try:
        world = load_world(path)
    except WorldError as fault:
        hold_messages(str(fault), path.parent)
        return "refused"
    hold_messages("\n".join(world.warnings), path.parent)
    simulation = world.simulation
    few = simulation.world.used() <= MOST_STEPPED and simulation.settings.substeps <= MOST_SUBSTEPS
    return stepped(world, path) if few else "loaded"


def stepped(world: LoadedWorld, path: Path) -> str:
    """Take steps; return how they ended."""
    try:
        for _ in range(3):
            world.simulation.step()
        hold_messages("\n".join(lint(load_world(path))), path.parent)
    except CaromError as fault:
        if not str(fault).strip():
            raise FindingError("refuses a step without a word") from fault
        return "stopped"
    return "stepped"


def hold_messages(text: str, folder: Path) -> None:
    """Raise FindingError where a line is not a whole message with its place in a file."""
    for line in text.split("\n") if text else []:
        found = PLACE.fullmatch(line.removeprefix(f"{folder}/"))
        if found is None or INNER.search(line) or len(line) > LONGEST_LINE or not line.isprintable():
            raise FindingError(f"says {line[:LONGEST_LINE]!r}")
        if found[2] is not None and not _within(folder / f"{found[1]}.yaml", int(found[2]), int(found[3])):
            raise FindingError(f"tells a place that is not there: {line!r}")


def _within(path: Path, line: int, column: int) -> bool:
    lines = re.split(r"\r\n|[\r\n\x85\u2028\u2029]", path.read_bytes().decode("utf-8-sig"))
    if (line, column) == (len(lines) + 1, 1):  # the end of a text that ends too early
        return True
    return 1 <= line <= len(lines) and 1 <= column <= len(lines[line - 1]) + 1
