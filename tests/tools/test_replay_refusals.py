"""Recordings that cannot be replayed, or only in part, are told of in whole sentences."""

from __future__ import annotations

import re
import signal
import subprocess
import sys
from pathlib import Path

import pytest
from replays import BALLS, record, replayed

from carom.ecs import CaromError, SnapshotError
from carom.tools.cli import main
from carom.tools.recorder import about
from carom.tools.recording import SavedState
from carom.tools.replay import Replay
from carom.tools.retrace import retrace
from carom.worlds import WorldError, load_text


def test_other_versions_and_processors_are_told(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Beside the verdict, which they need not change."""
    record(load_text(BALLS), tmp_path / "a.rrd", 4)
    here = about.versions_here()
    other = {"version_numba": "0.1", "processor": "abacus"}
    monkeypatch.setattr(about, "versions_here", lambda: here | other)
    verdict = replayed(tmp_path / "a.rrd")
    path = tmp_path / "a.rrd"
    assert verdict.text() == (
        f"{path}: frames 0 to 4 simulated again: the same, bit for bit\n"
        f"  changed: processor was {here['processor']}, here it is abacus\n"
        f"  changed: numba was {here['version_numba']}, here it is 0.1"
    )


def test_a_recording_of_before_the_step_was_recorded_is_replayed(tmp_path: Path) -> None:
    """Nothing is said of the step."""
    record(load_text(BALLS), tmp_path / "a.rrd", 4)
    replay = Replay(tmp_path / "a.rrd")
    del replay.stated["schedule"]
    verdict = retrace(replay, replay.loaded(), 4)
    assert (verdict.same, verdict.changes) == (True, [])


def test_frames_that_were_not_recorded_are_refused(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """On the command line and in Python."""
    path = tmp_path / "a.rrd"
    record(load_text(BALLS), path, 20)
    assert main(["replay", str(path), "--from", "10", "--to", "30"]) == 2
    assert capsys.readouterr().err == f"frames 10 to 30 cannot be simulated again; {path} holds frames 0 to 20\n"
    assert main(["replay", str(path), "--out", str(path)]) == 2
    assert capsys.readouterr().err == f"{path} is the recording itself; write another file\n"
    with pytest.raises(CaromError, match=re.escape(f"{path} does not hold frame 21, but frames 0 to 20")):
        Replay(path).simulation_at(21)


def test_a_snapshot_that_was_tampered_with_is_refused(tmp_path: Path) -> None:
    """By its checksum, by its hash, and one of a later version by that."""
    path = tmp_path / "a.rrd"
    record(load_text(BALLS), path, 200)
    replay = Replay(path)
    saved = replay.states[120]
    name = f"{path}, the snapshot of frame 120,"
    damaged = saved.state[:-1] + bytes([saved.state[-1] ^ 1])
    later = saved.state.replace(b"carom snapshot 2 ", b"carom snapshot 3 ", 1)
    for state, digest, message in (
        (damaged, saved.hash, f"{name} is damaged: its bytes are not those that were saved; save it anew"),
        (later, saved.hash, f"{name} is of version 3, this carom reads version 2; update carom"),
        (saved.state, "0" * 32, f"{name} is damaged: its hash is {saved.hash}, recorded with it is {'0' * 32}"),
    ):
        replay.states[120] = SavedState(120, state, digest)
        for act in (lambda: replay.simulation_at(130), lambda: retrace(replay, replay.loaded(), 200)):
            with pytest.raises(SnapshotError) as refused:
                act()
            assert str(refused.value) == message


def test_a_world_file_that_no_longer_loads_is_refused(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """As any world file, saying in which recording it is."""
    path = tmp_path / "a.rrd"
    loaded = load_text(BALLS)
    loaded.source_text = "carom: 1\nentitys: []\n"
    record(loaded, path, 2)
    with pytest.raises(WorldError):
        Replay(path).loaded()
    assert main(["replay", str(path)]) == 2
    assert capsys.readouterr().err.startswith(f"{path}, its world file:2:1: entitys: unknown key; received 'entitys'")


def test_what_is_no_such_recording_is_refused(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """A file that is not there, one of something else, and one without a world file."""
    nowhere, text, python = (tmp_path / name for name in ("nowhere.rrd", "text.rrd", "python.rrd"))
    text.write_text("carom: 1\n")
    loaded = load_text(BALLS)
    loaded.source_text = ""
    record(loaded, python, 2)
    lost = f"no recording at {nowhere}; make one with: carom run billiards --record {nowhere}\n"
    unsourced = (
        f"{python} holds no world file, so that it cannot be simulated again; "
        f"record a world file: carom run WORLD --record {python}\n"
    )
    for path, message in ((nowhere, lost), (python, unsourced)):
        assert main(["replay", str(path)]) == 2
        assert capsys.readouterr().err == message
    assert main(["replay", str(text)]) == 2
    assert capsys.readouterr().err.startswith(f"cannot read {text}: ")


KILLED = """
import sys
sys.path.insert(0, {folder!r})
from pathlib import Path
from test_replay import BALLS
from carom.tools.recorder import Recorder
from carom.worlds import load_text
loaded = load_text(BALLS)
recorder = Recorder(Path({path!r}), source=loaded.source_text)
loaded.simulation.observers.append(recorder)
recorder.begin(loaded.simulation)
while True:
    loaded.simulation.step()
    print(loaded.simulation.frame, flush=True)
"""


def test_a_recording_cut_by_a_kill_is_replayed_as_far_as_it_goes(tmp_path: Path) -> None:
    """Which is said; up to the last snapshot bit for bit, then by its poses."""
    path = tmp_path / "killed.rrd"
    code = KILLED.format(folder=str(Path(__file__).parent), path=str(path))
    with subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, text=True) as process:
        assert process.stdout is not None
        for line in process.stdout:
            if int(line) >= 310:
                break
        process.send_signal(signal.SIGKILL)
    verdict = replayed(path)
    assert verdict.same
    assert verdict.full >= 120
    assert verdict.notes == [
        f"{path} was not finished: the run that wrote it was killed; its last second may be missing"
    ]
