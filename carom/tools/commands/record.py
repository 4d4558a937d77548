"""Record: what a run records, by the options that say so."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from carom.tools.commands.options import declare_detail, detail, named, seconds

if TYPE_CHECKING:
    from carom.systems.observer import Observer
    from carom.systems.simulation import Simulation
    from carom.tools.filming import Shot
    from carom.worlds.builder import LoadedWorld
    from carom.worlds.expectation import Outcome


def declare_record(parser: argparse.ArgumentParser) -> None:
    """Declare the recording, which part of the run it holds, and the viewer that is sent the same."""
    parser.add_argument("--record", type=Path, metavar="FILE", help="write a Rerun recording (.rrd)")
    parser.add_argument("--record-from", metavar="TIME", help="begin the recording there, such as 3s")
    parser.add_argument(
        "--ring", metavar="TIME", help="record only the last 10s, or so, once something fails or is interrupted"
    )
    declare_detail(parser)
    parser.add_argument("--only", nargs="+", metavar="NAME", help="record nobody but these, such as 'crate*'")
    parser.add_argument(
        "--promote", nargs="+", metavar="NAME", help="record these with a path, a label, plots and a lane of their own"
    )
    parser.add_argument("--live", action="store_true", help="show it in the Rerun viewer as it runs")
    parser.add_argument("--viewer", metavar="URL", help="a viewer elsewhere, such as rerun+http://HOST:9876/proxy")


class Records:
    """The observers that record a run; what of it there is a recording of is told after it.

    Raises CaromError for options that do not go together, a time that is none or beyond the run, or no viewer.
    """

    def __init__(self, arguments: argparse.Namespace, loaded: LoadedWorld, shot: Shot) -> None:
        from carom.systems.ring import Ring
        from carom.tools.last_seconds import LastSeconds
        from carom.tools.later import Later
        from carom.tools.recorder.of_world import recorder_of
        from carom.tools.viewer import running_viewer

        self._path: Path | None = arguments.record
        self._ring, self._from = _part(arguments, loaded)
        shown = arguments.live or arguments.viewer
        level = detail(arguments, loaded.recording.detail, bool(self._path or shown), "--record FILE or --live")
        for option, patterns in {"--only": arguments.only, "--promote": arguments.promote}.items():
            named(option, patterns, loaded)
        chosen = {"only": arguments.only, "promote": arguments.promote or (), "detail": level}
        live = running_viewer(arguments.viewer) if shown else None
        self.observers: list[Observer] = []
        self._last: LastSeconds | None = None
        self._later: Later | None = None
        if live and (self._ring or self._from is not None):  # a viewer is sent all of the run
            self.observers.append(recorder_of(loaded, shot, None, live=live, **chosen))
            live = None
        if not (self._path or live):
            return
        recorder = recorder_of(loaded, shot, self._path, live=live, **chosen)
        if self._ring:
            judged = loaded.expectations if arguments.frames is None else []
            self._last = LastSeconds(Ring.of_seconds(self._ring, loaded.simulation), recorder, judged)
        elif self._from is not None:
            self._later = Later(recorder, self._from)
        self.observers.append(self._last or self._later or recorder)

    @property
    def path(self) -> Path | None:
        """The recording that there is."""
        there = (self._last is None or self._last.shown) and (self._later is None or self._later.begun)
        return self._path if there else None

    def after(self, simulation: Simulation, failures: list[Outcome]) -> str:
        """Write what a ring holds where something failed in the end; return why nothing is recorded, if so."""
        if self._last and failures:
            self._last.show(simulation)
        if self.path == self._path:
            return ""
        if self._last:
            return f"nothing failed, so that {self._path} is not written"
        return f"the run was over at {simulation.time:g} s, before anything was recorded; {self._path} is not written"

    def after_a_stop(self, simulation: Simulation) -> str:
        """Write what a ring holds; return what is added to the message of a run that was stopped."""
        if self._last:
            self._last.show(simulation)
            return f"; the last {self._ring:g} s or more: carom view {self._path}"
        return f"; the recording up to there: carom view {self.path}" if self.path else ""


def _part(arguments: argparse.Namespace, loaded: LoadedWorld) -> tuple[float, int | None]:
    """Return how many seconds a ring holds, 0 for none, and the frame a recording begins with, None for the first."""
    from carom.ecs.errors import CaromError
    from carom.worlds.run import frames_of

    for option, value in (("--ring", arguments.ring), ("--record-from", arguments.record_from)):
        if value and not arguments.record:
            raise CaromError(f"{option}: goes with --record FILE, the recording it is of")
    if arguments.ring and arguments.record_from:
        raise CaromError("--record-from: goes with a recording to the end of the run, --ring makes another; leave one")
    held = seconds("--ring", arguments.ring, above=0.0) if arguments.ring else 0.0
    if not arguments.record_from:
        return held, None
    begin, dt = seconds("--record-from", arguments.record_from, least=0.0), loaded.simulation.settings.dt
    last = loaded.run.frames if arguments.frames is None else arguments.frames
    frame = frames_of(begin, dt)
    if frame > last:
        raise CaromError(f"--record-from: must be within the run, which ends at {last * dt:g} s; received {begin:g} s")
    return held, frame
