"""Both: what is told and recorded of two runs that part, side by side."""

from __future__ import annotations

from contextlib import ExitStack
from pathlib import Path
from typing import NamedTuple

import numpy as np

from carom.systems.simulation import Simulation
from carom.tools.filming import shot_of
from carom.tools.futures import Futures
from carom.tools.parted import Comparison
from carom.tools.recorder.of_world import recorder_of
from carom.tools.side import Side

LATER = 1.0  # s that are recorded after two runs have parted


class Blame(NamedTuple):
    """The system in which two runs part, the one before it, what it declares to touch, and all of it in words."""

    system: str
    before: str
    touches: dict[str, list[str]]
    text: str


def blame(found: Comparison, a: Side, b: Side) -> Blame:
    """Return what is known of the system in which two runs part."""
    difference = found.difference
    if difference is None or not difference.system:
        return Blame("", "", {}, found.text())
    owners = {"both": (a, b), "the first only": (a,), "the second only": (b,)}
    has = [difference.system in _names(side.simulation) for side in (a, b)]
    whose = "both" if all(has) else "the first only" if has[0] else "the second only"
    schedule = owners[whose][0].simulation.schedule
    names = _names(owners[whose][0].simulation)
    place = names.index(difference.system)
    system = next(system for _, system in schedule if system.name == difference.system)
    touches = {use: [kind.__name__ for kind in getattr(system, use)] for use in ("reads", "writes", "adds")}
    by = f"system '{difference.system}', run {difference.run} in phase '{difference.phase}'"
    lines = [
        f"frame {difference.frame}: {by}, is the first after which {found.a} and {found.b} differ",
        f"  wrote    {difference.what}",
        f"  is in    {whose}",
        *(f"  {use:<8} {', '.join(kinds)}" for use, kinds in touches.items() if kinds),
    ]
    if place:
        lines.append(f"  before   all is the same, up to system '{names[place - 1]}'")
    lines.append(f"  how      {found.how}")
    return Blame(difference.system, names[place - 1] if place else "", touches, "\n".join(lines))


def record_both(found: Comparison, a: Side, b: Side, out: Path) -> str:
    """Record the first run, with the second as a ghost, around where they part; return the command that opens it."""
    if found.difference is None:
        return f"both are the same, so that {out} is not written"
    if not found.reproduced:
        return f"neither parts from the other here, so that {out} is not written"
    start = found.start
    for side in (a, b):
        side.go_to(start)
    simulation = a.simulation
    last = min(found.last, found.difference.frame + round(LATER / found.dt))
    futures = Futures([("first", simulation), ("second", b.simulation)], before=b.redo)
    recorder = recorder_of(a.loaded, shot_of(a.loaded, None), out, every=1)
    with np.errstate(all="ignore"), ExitStack() as ending:
        for observer in (futures, recorder):
            ending.callback(observer.end, simulation)
            observer.begin(simulation)
        while simulation.frame < last:
            a.step()
            for observer in (futures, recorder):
                observer.observe(simulation)
    return f"open it with: carom view {out} --frame {max(found.difference.frame, start)}"


def _names(simulation: Simulation) -> list[str]:
    return [system.name for _, system in simulation.schedule]
