"""Run: simulate a world; record, film and photograph it."""

from __future__ import annotations

import argparse
import dataclasses
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from carom.tools.commands.breaks import Breaks, declare_breaks
from carom.tools.commands.look import declare_look, look
from carom.tools.commands.options import (
    declare_overrides,
    ending,
    factor,
    overrides,
    print_json,
    print_warnings,
    stated_overrides,
    whole_number,
)
from carom.tools.commands.record import Records, declare_record

if TYPE_CHECKING:
    from carom.tools.watching import Watching
    from carom.worlds.builder import LoadedWorld


def declare(parser: argparse.ArgumentParser) -> None:
    """Declare the world, what to write, and what to override."""
    parser.add_argument("world", metavar="WORLD", help="a world file, or the name of a library world")
    declare_record(parser)
    parser.add_argument("--speed", metavar="X", help="simulated time to real time, such as 1x; as fast as can be")
    parser.add_argument("--film", type=Path, metavar="FILE", help="write a film (.mp4, .webp or .gif)")
    parser.add_argument(
        "--picture", type=ending(".png"), metavar="FILE", help="write a picture of the last state (.png)"
    )
    parser.add_argument(
        "--write", type=ending(".yaml", ".yml"), metavar="FILE", help="write the last state as a world file (.yaml)"
    )
    parser.add_argument(
        "--frames", type=whole_number, metavar="N", help="stop after N steps; what is expected is not judged"
    )
    parser.add_argument("--camera", metavar="NAME", help="camera of film and picture; the world's 'main' by default")
    declare_look(parser)
    parser.add_argument(
        "--compare", metavar="SETTING=A,B", help="run several futures side by side, such as integrator=euler,verlet"
    )
    parser.add_argument("--watch", action="store_true", help="run it anew whenever it, or a file it names, is saved")
    parser.add_argument("--check", action="store_true", help="let every system touch only what it declares")
    parser.add_argument("--ledger", action="store_true", help="tell who gave energy and who took it")
    parser.add_argument(
        "--audit", action="store_true", help="measure every contact by FCL as well, and tell where kernels disagree"
    )
    declare_breaks(parser)
    declare_overrides(parser)


def execute(arguments: argparse.Namespace) -> int:
    """Run the world, once or whenever it is saved; 1 when something failed, or a breakpoint or a NaN stopped it."""
    from carom.ecs.errors import CaromError
    from carom.tools.comparing import load_futures
    from carom.tools.watching import Watching, keep_running
    from carom.worlds import library, load_world

    stated = {"checked": arguments.check or None, **overrides(arguments)}
    if arguments.write and arguments.write.resolve() == library.find(arguments.world).resolve():
        raise CaromError(f"{arguments.write} is the world itself; write another file")
    if arguments.watch:
        if arguments.compare:
            raise CaromError("--compare: shows futures of a world that stays as it is; leave out --watch")
        watching = Watching(library.find(arguments.world), lambda: load_world(arguments.world, **stated))
        return keep_running(watching, lambda loaded: once(arguments, [("", loaded)], watching))
    if arguments.compare:
        return once(arguments, load_futures(arguments.world, arguments.compare, **stated))
    return once(arguments, [("", load_world(arguments.world, **stated))])


def once(
    arguments: argparse.Namespace, worlds: Sequence[tuple[str, LoadedWorld]], watching: Watching | None = None
) -> int:
    """Run a world, with the other futures of it, and print the summary; return the exit status."""
    from carom.ecs.errors import NonFiniteError
    from carom.systems.breakpoints import StoppedError
    from carom.tools.auditing import Auditing
    from carom.tools.filming import Filming, photograph, shot_of
    from carom.tools.futures import Futures
    from carom.tools.offscreen import backend
    from carom.tools.opening import Opening
    from carom.tools.outputs import prepare_outputs
    from carom.tools.pace import Pace
    from carom.tools.painter import Painter
    from carom.tools.session import run
    from carom.tools.vantage import vantage_warnings
    from carom.worlds import write_world

    loaded = worlds[0][1]
    print_warnings(loaded.warnings)
    shot = shot_of(loaded, arguments.camera, look(arguments, loaded))
    if arguments.film or arguments.picture:
        backend()  # who cannot draw is told before the run
        print_warnings(vantage_warnings(shot, loaded.simulation))
    pace = Pace(factor("--speed", arguments.speed)) if arguments.speed else None
    futures = Futures([(name, world.simulation) for name, world in worlds]) if arguments.compare else None
    records, breaks = Records(arguments, loaded, shot), Breaks(arguments, loaded)
    observers = [*([futures] if futures else []), *records.observers, *breaks.observers]
    if arguments.film:
        observers.append(Filming(shot, arguments.film))
    prepare_outputs([arguments.record, arguments.film, arguments.picture, arguments.write])
    painter = Painter(loaded.simulation, shot.look)
    if arguments.picture:
        observers.append(painter)
    auditing = Auditing()
    if arguments.audit:
        observers.append(auditing)
    observers += [item for item in (pace, watching) if item]
    ledger = loaded.simulation.keep_ledger() if arguments.ledger else None
    simulation = loaded.simulation
    try:
        summary = run(loaded, observers, frames=arguments.frames, judged=futures is None)
    except KeyboardInterrupt:
        print(f"interrupted in frame {simulation.frame}{records.after_a_stop(simulation)}", file=sys.stderr)
        return 130
    except NonFiniteError as fault:
        breaks.tell_not_finite(fault, records.after_a_stop(simulation))
        return 1
    except StoppedError as stopped:
        records.after_a_stop(simulation)
        breaks.tell(stopped, records.path)
        return 1
    if reason := records.after(simulation, summary.failures):
        print(reason, file=sys.stderr)
    if arguments.picture:
        photograph(shot, loaded.simulation, arguments.picture, painter)
    if arguments.write:
        write_world(loaded, arguments.write)
    written = {"recording": records.path, "film": arguments.film, "picture": arguments.picture}
    written["world"] = arguments.write
    summary.outputs = {kind: str(path) for kind, path in written.items() if path}
    opening = Opening(loaded, arguments.world, stated_overrides(arguments), records.path)
    if arguments.json:
        further = ({"audit": auditing.rows()} if arguments.audit else {}) | ({"ledger": ledger.since} if ledger else {})
        further |= {"futures": list(map(dataclasses.asdict, futures.outcomes()))} if futures else {}
        further |= {"failures": list(map(opening.told, summary.failures))}
        print_json(dataclasses.asdict(summary) | further)
    else:
        print(summary.text(opening))
        if futures:
            print(futures.text())
        if ledger:
            print(ledger.text())
        if arguments.audit:
            print(auditing.text())
    return 1 if summary.failures or auditing.failed else 0
