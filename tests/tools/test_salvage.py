"""A recording cut anywhere is whole again after salvage, up to its last whole message."""

from __future__ import annotations

import json
import random
import struct
import subprocess
import warnings
from pathlib import Path

import pytest

from carom.tools.bench.killed import RATE, lone_ball, record_until_killed
from carom.tools.cli import main
from carom.tools.recorder.stream import Stamp, Stream
from carom.tools.recording import Recording
from carom.tools.salvage import salvage
from carom.tools.viewer import viewer_binary

FRAMES = 60


@pytest.fixture(scope="module")
def recorded(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a recording of sixty frames, a twentieth of a second apart, flushed every fifth."""
    import rerun
    import rerun.blueprint as rrb

    path = tmp_path_factory.mktemp("recorded") / "run.rrd"
    stream = Stream("counting")
    stream.to_file(path, rrb.Blueprint(rrb.TextLogView(origin="log")))
    stream.static("about", rerun.AnyValues(title="counting"))
    for frame in range(FRAMES):
        stamp = Stamp(frame, frame / 20)
        stream.row("plots/counts/bodies", stamp, rerun.Scalars(float(frame)))
        stream.row("log", stamp, rerun.TextLog(f"frame {frame}", level="INFO"))
        if frame % 5 == 0:
            stream.flush()
    stream.close()
    return path


def messages(path: Path) -> list[tuple[int, int]]:
    """Return the kind and the end of each message of a finished recording, but of the one that ends it."""
    data, at, found = path.read_bytes(), 12, []
    while True:
        kind, length = struct.unpack_from("<QQ", data, at)
        if kind == 0:
            return found
        at += 16 + length
        found.append((kind, at))


def assert_nothing_wrong(path: Path) -> None:
    """Raise what Rerun or the reader finds wrong, warnings too."""
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        Recording(path)
    verified = subprocess.run([viewer_binary(), "rrd", "verify", path], capture_output=True, text=True, check=True)
    assert "1 file verified without error." in verified.stdout + verified.stderr


def test_every_whole_message_is_kept_wherever_a_recording_is_cut(recorded: Path, tmp_path: Path) -> None:
    """At 50 places; Rerun finds nothing wrong with any, and the reader does not warn."""
    data, whole = recorded.read_bytes(), messages(recorded)
    kinds = [kind for kind, _ in whole]
    first = kinds.index(2, kinds.index(3))  # data follow the blueprint
    chance = random.Random(8)
    cut, mended = tmp_path / "cut.rrd", tmp_path / "mended.rrd"
    frames = set()
    for place in (chance.randrange(whole[first][1], len(data)) for _ in range(50)):
        cut.write_bytes(data[:place])
        salvaged = salvage(cut, mended)
        kept = [message for message in whole if message[1] <= place]
        assert (salvaged.kept, salvaged.dropped, salvaged.whole) == (kept[-1][1], place - kept[-1][1], False)
        assert_nothing_wrong(mended)
        assert [kind for kind, _ in messages(mended)] == kinds[: len(kept)]
        recording = Recording(mended)
        assert recording.frames == list(range(salvaged.frames))
        assert [line.text for line in recording.lines] == [f"frame {number}" for number in range(len(recording.lines))]
        frames.add(salvaged.frames)
    assert len(frames) > 5 and max(frames) == FRAMES


def test_a_recording_that_is_whole_is_copied(
    recorded: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Byte for byte, into a folder that is made."""
    out = tmp_path / "deep" / "whole.rrd"
    assert main(["salvage", str(recorded), "--out", str(out)]) == 0
    assert out.read_bytes() == recorded.read_bytes()
    assert capsys.readouterr().out == f"{out}: 60 frames, 2.950 s; {recorded} was whole already, and is copied\n"


def test_what_was_kept_is_told(recorded: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """In words and as JSON."""
    data, (_, end) = recorded.read_bytes(), messages(recorded)[-1]
    cut, out = tmp_path / "cut.rrd", tmp_path / "whole.rrd"
    cut.write_bytes(data[:end])
    assert main(["salvage", str(cut), "--out", str(out)]) == 0
    assert capsys.readouterr().out == f"{out}: 60 frames, 2.950 s; kept all {end:,} bytes, and finished them\n"
    cut.write_bytes(data[: end + 7])
    assert main(["salvage", str(cut), "--out", str(out)]) == 0
    told = f"{out}: 60 frames, 2.950 s; kept {end:,} bytes, dropped 7 of a message that was cut off\n"
    assert capsys.readouterr().out == told
    assert main(["salvage", str(cut), "--out", str(out), "--json"]) == 0
    numbers = {"frames": 60, "seconds": 2.95, "kept": end, "dropped": 7, "whole": False}
    assert json.loads(capsys.readouterr().out) == {"out": str(out), **numbers}


@pytest.mark.parametrize(
    ("content", "fault"),
    [
        (b"", "it is empty"),
        (b"hello", "it is no recording, which would start with RRF2"),
        (b"RRF2\0", "it was cut before its first message"),
        (b"RRF2\0\x29\0\0\1\2\0\0\1\0", "its 12 whole bytes hold no data"),
    ],
)
def test_what_holds_nothing_is_refused(
    content: bytes, fault: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """And nothing is written."""
    broken = tmp_path / "broken.rrd"
    broken.write_bytes(content)
    assert main(["salvage", str(broken), "--out", str(tmp_path / "whole.rrd")]) == 2
    assert capsys.readouterr().err == f"cannot salvage {broken}: {fault}\n"
    assert [path.name for path in tmp_path.iterdir()] == ["broken.rrd"]


def test_a_recording_is_not_mended_in_place(recorded: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Nor one that is not there."""
    here = str(recorded)
    assert main(["salvage", here, "--out", here]) == 2
    assert capsys.readouterr().err == f"cannot write {here}: it is the broken recording itself; name another file\n"
    assert main(["salvage", f"{tmp_path}/none.rrd", "--out", f"{tmp_path}/a.rrd"]) == 2
    lost = f"no recording at {tmp_path}/none.rrd; make one with: carom run billiards --record {tmp_path}/none.rrd\n"
    assert capsys.readouterr().err == lost


@pytest.mark.parametrize("seed", range(2))
def test_a_kill_loses_at_most_a_second(seed: int, tmp_path: Path) -> None:
    """Of simulated or of real time, whatever the moment."""
    path, mended = tmp_path / "killed.rrd", tmp_path / "mended.rrd"
    killed = record_until_killed(lone_ball, path, random.Random(seed).uniform(1.0, 3.0))
    salvaged = salvage(path, mended)
    assert_nothing_wrong(mended)
    newest = Recording(mended).frames[-1]
    assert salvaged.seconds == pytest.approx(newest / RATE, abs=1e-9)
    assert killed.lost(newest) <= 1.0
