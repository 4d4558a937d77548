"""Run: simulate a world; record, film and photograph it."""

from __future__ import annotations

import argparse
import dataclasses
import sys
from pathlib import Path

from carom.tools.commands.look import declare_look, look
from carom.tools.commands.options import (
    declare_detail,
    declare_overrides,
    detail,
    ending,
    factor,
    named,
    overrides,
    print_json,
    print_warnings,
    whole_number,
)


def declare(parser: argparse.ArgumentParser) -> None:
    """Declare the world, what to write, and what to override."""
    parser.add_argument("world", metavar="WORLD", help="a world file, or the name of a library world")
    parser.add_argument("--record", type=Path, metavar="FILE", help="write a Rerun recording (.rrd)")
    declare_detail(parser)
    parser.add_argument("--only", nargs="+", metavar="NAME", help="record nobody but these, such as 'crate*'")
    parser.add_argument(
        "--promote", nargs="+", metavar="NAME", help="record these with a path, a label, plots and a lane of their own"
    )
    parser.add_argument("--live", action="store_true", help="show it in the Rerun viewer as it runs")
    parser.add_argument("--viewer", metavar="URL", help="a viewer elsewhere, such as rerun+http://HOST:9876/proxy")
    parser.add_argument("--speed", metavar="X", help="simulated time to real time, such as 1x; as fast as can be")
    parser.add_argument("--film", type=Path, metavar="FILE", help="write a film (.mp4, .webp or .gif)")
    parser.add_argument(
        "--picture", type=ending(".png"), metavar="FILE", help="write a picture of the last state (.png)"
    )
    parser.add_argument(
        "--frames", type=whole_number, metavar="N", help="stop after N steps; what is expected is not judged"
    )
    parser.add_argument("--camera", metavar="NAME", help="camera of film and picture; the world's 'main' by default")
    declare_look(parser)
    parser.add_argument("--check", action="store_true", help="let every system touch only what it declares")
    parser.add_argument("--ledger", action="store_true", help="tell who gave energy and who took it")
    parser.add_argument(
        "--audit", action="store_true", help="measure every contact by FCL as well, and tell where kernels disagree"
    )
    declare_overrides(parser)


def execute(arguments: argparse.Namespace) -> int:
    """Run the world and print the summary; 1 when an expectation or the audit failed or a number became infinite."""
    from carom.ecs.errors import NonFiniteError
    from carom.systems.observer import Observer
    from carom.tools.auditing import Auditing
    from carom.tools.filming import Filming, photograph, shot_of
    from carom.tools.outputs import prepare_outputs
    from carom.tools.pace import Pace
    from carom.tools.painter import Painter
    from carom.tools.recorder.of_world import recorder_of
    from carom.tools.session import run
    from carom.tools.vantage import vantage_warnings
    from carom.tools.viewer import running_viewer
    from carom.worlds.builder import load_world

    loaded = load_world(arguments.world, checked=arguments.check or None, **overrides(arguments))
    print_warnings(loaded.warnings)
    shown = arguments.live or arguments.viewer
    level = detail(arguments, loaded.recording.detail, bool(arguments.record or shown), "--record FILE or --live")
    shot = shot_of(loaded, arguments.camera, look(arguments, loaded))
    if arguments.film or arguments.picture:
        print_warnings(vantage_warnings(shot, loaded.simulation))
    observers: list[Observer] = []
    for option, patterns in {"--only": arguments.only, "--promote": arguments.promote}.items():
        named(option, patterns, loaded)
    pace = Pace(factor("--speed", arguments.speed)) if arguments.speed else None
    live = running_viewer(arguments.viewer) if shown else None
    if arguments.record or live:
        chosen = {"only": arguments.only, "promote": arguments.promote or ()}
        observers.append(recorder_of(loaded, shot, arguments.record, live=live, detail=level, **chosen))
    if arguments.film:
        observers.append(Filming(shot, arguments.film))
    prepare_outputs([arguments.record, arguments.film, arguments.picture])
    painter = Painter(loaded.simulation, shot.look)
    if arguments.picture:
        observers.append(painter)
    auditing = Auditing()
    if arguments.audit:
        observers.append(auditing)
    if pace:
        observers.append(pace)
    ledger = loaded.simulation.keep_ledger() if arguments.ledger else None
    kept = f"; the recording up to there: carom view {arguments.record}" if arguments.record else ""
    try:
        summary = run(loaded, observers, frames=arguments.frames)
    except KeyboardInterrupt:
        print(f"interrupted in frame {loaded.simulation.frame}{kept}", file=sys.stderr)
        return 130
    except NonFiniteError as fault:
        print(f"{fault}{kept}", file=sys.stderr)
        return 1
    if arguments.picture:
        photograph(shot, loaded.simulation, arguments.picture, painter)
    written = {"recording": arguments.record, "film": arguments.film, "picture": arguments.picture}
    summary.outputs = {kind: str(path) for kind, path in written.items() if path}
    if arguments.json:
        further = ({"audit": auditing.rows()} if arguments.audit else {}) | ({"ledger": ledger.since} if ledger else {})
        print_json(dataclasses.asdict(summary) | further)
    else:
        print(summary.text())
        if ledger:
            print(ledger.text())
        if arguments.audit:
            print(auditing.text())
    return 1 if summary.failures or auditing.failed else 0
