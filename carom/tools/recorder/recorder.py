"""Recorder: the observer that writes a simulation into a Rerun recording."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from time import monotonic

from carom.ecs.errors import CaromError
from carom.systems.simulation import Simulation
from carom.tools.cameras import Camera
from carom.tools.recorder import about
from carom.tools.recorder.blueprint import blueprint, default_camera
from carom.tools.recorder.choice import Choice, Chosen
from carom.tools.recorder.detail import tracks_of
from carom.tools.recorder.edits import Edits
from carom.tools.recorder.snapshots import Snapshots
from carom.tools.recorder.stream import Stamp, Stream
from carom.tools.recorder.track import Track
from carom.tools.recorder.tracks.bodies import ROOT
from carom.tools.recorder.tracks.cameras import Cameras
from carom.tools.recorder.tracks.promoted import Promoted
from carom.tools.rigs import Rig

FLUSH_AFTER = 0.9  # s of real time: a kill then loses less than the last second
BLOCKS = 3  # of a second of simulated time: each as many more make blocks a second longer, as Rerun keeps kB of each
BLOCK = 2 << 20  # bytes of one track: Rerun copies them several times, which takes a third in memory that caches hold
SEND_AFTER = 1 / 30  # s of real time, so that what a viewer shows of a run moves


class Recorder:
    """Record a simulation into an .rrd file at ``path``, into a running viewer at the address ``live``, or both.

    Every ``every``-th step is recorded, by default as many as make ``fps`` frames a simulated second; impacts and
    sensors entered are told of every step. Samples are written in blocks and flushed after a second of real time, or
    sooner after one of simulated time (more, the longer the run), and to a viewer 30 times a second. ``detail`` says
    how much is recorded: ``light``, ``full`` or ``solver``; no bit of the run depends on it. ``title``, ``source`` (the
    text of the world file) and ``files`` (the content of those it names, by its words for them) travel in the
    recording. Raises DeclarationError for an unknown detail. The view begins at ``camera``; ``cameras`` are recorded as
    they move, each with pictures ``aspect`` times as wide as high. Patterns of names, or a query of the world, choose
    ``only`` whom a recording tells of, and whom to ``promote`` to a path, plots and a lane of their own.
    """

    def __init__(
        self,
        path: str | Path | None = None,
        every: int | None = None,
        fps: int = 60,
        *,
        live: str | None = None,
        detail: str = "light",
        title: str = "world",
        source: str | None = None,
        files: Mapping[str, bytes] | None = None,
        camera: Camera | None = None,
        cameras: Sequence[Rig] = (),
        aspect: float = 4 / 3,
        only: Chosen | None = None,
        promote: Chosen = (),
    ) -> None:
        if path is None and live is None:
            raise CaromError("a recorder writes to a file, to a viewer or to both; state its path or live=")
        self.path = None if path is None else Path(path)
        self.live = live
        self.frames = 0
        self._every, self._fps = every, fps
        self._title, self._source, self._files, self._camera = title, source, files, camera
        self._stream: Stream | None = None
        self._detail = detail
        self._edits, self._snapshots = Edits(), Snapshots()
        self._tracks = {
            **tracks_of(detail),
            "cameras": Cameras(cameras, aspect),
            "promoted": Promoted(promote),
            "snapshots": self._snapshots,
        }
        self._only = None if only is None else Choice(only)
        for track in self._tracks.values():
            track.only = self._only
        self._sampled: dict[bool, list[Track]] = {}
        self._watching = [track for track in self._tracks.values() if type(track).watch is not Track.watch]
        self._seen = self._waiting = self._blocks = 0
        self._flushed = 0.0
        self._patience = FLUSH_AFTER if live is None else SEND_AFTER

    def begin(self, simulation: Simulation) -> None:
        """Open the file, write what never changes and the first frame."""
        import rerun

        if self._every is None:
            self._every = max(1, round(1.0 / (self._fps * simulation.settings.dt)))
        self._seen = simulation.frame
        self._edits.begin(simulation)
        world = simulation.world
        camera = self._camera or default_camera(world)
        upright = camera.up[1] >= abs(camera.up[2])
        axes = rerun.ViewCoordinates.RIGHT_HAND_Y_UP if upright else rerun.ViewCoordinates.RIGHT_HAND_Z_UP
        only = [] if self._only is None else self._only.words
        self._stream, tracks = Stream(self._title), self._tracks.values()
        if self.path is not None:
            self._stream.to_file(self.path, blueprint(world, camera, tracks))
        if self.live is not None:
            self._stream.to_viewer(self.live, blueprint(world, camera, tracks, "following"))
        self._stream.static(ROOT, axes)
        self._stream.static(about.PATH, *about.about(self._title, simulation, self._source, self._detail, only))
        if self._files:
            self._stream.static(about.FILES, about.files(self._files))
        for track in self._tracks.values():
            track.begin(simulation, self._stream, self._tracks)
            track.watch(simulation)
        telling = [track for track in self._tracks.values() if not track.silent(simulation)]
        self._sampled = {when: [track for track in telling if track.every_step is when] for when in (False, True)}
        self._record(simulation, self._stream)
        self._write(self._stream)

    def observe(self, simulation: Simulation) -> None:
        """Record the step if it is one of the frames; write and flush about once a second."""
        assert self._stream is not None and self._every is not None, "begin() comes before observe()"
        self._seen = simulation.frame
        for track in self._watching:
            track.watch(simulation)
        self._sample(simulation, self._stream, every_step=True)
        if self._edits.sample(simulation, _stamp(simulation)):
            self._snapshots.after_edit(simulation, _stamp(simulation))
        stopped = simulation.stopped and simulation.stopped.frame == simulation.frame
        if simulation.frame % self._every == 0 or stopped:
            self._record(simulation, self._stream)
        enough = self._fps * (1.0 + self._blocks / BLOCKS)
        if self._waiting >= enough or monotonic() - self._flushed > self._patience:
            self._write(self._stream)

    def end(self, simulation: Simulation) -> None:
        """Write what is left, with a last snapshot unless the world stands within a step, and close the file."""
        stream, self._stream = self._stream, None
        if stream is not None:
            for track in self._tracks.values():
                track.end(simulation)
            if simulation.frame == self._seen:
                self._snapshots.keep(simulation, _stamp(simulation))
            self._write(stream)
            stream.close()

    def _record(self, simulation: Simulation, stream: Stream) -> None:
        self._sample(simulation, stream, every_step=False)
        self.frames += 1
        self._waiting += 1

    def _sample(self, simulation: Simulation, stream: Stream, *, every_step: bool) -> None:
        stamp = _stamp(simulation)
        for track in self._sampled[every_step]:
            track.sample(simulation, stamp, stream)
            if track.kept >= BLOCK:
                track.write(stream)

    def _write(self, stream: Stream) -> None:
        for track in self._tracks.values():
            track.write(stream)
        self._edits.write(stream)
        stream.flush()
        self._waiting, self._flushed = 0, monotonic()
        self._blocks += 1


def _stamp(simulation: Simulation) -> Stamp:
    return Stamp(simulation.frame, simulation.time)
