"""The command line itself: help, commands that only tell, and how it ends."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path
from typing import get_args

import pytest
from command_lines import changed

from carom.systems.settings import Collision, Integrator
from carom.tools.cli import COMMANDS, main, parser
from carom.tools.recording import Recording
from carom.worlds import library
from carom.worlds.importing.convention import UPRIGHT
from carom.worlds.sections import DETAILS

CAROM = [sys.executable, "-m", "carom.tools.cli"]


def test_wrong_usage_ends_with_2(world: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """By argparse, which leaves through SystemExit."""
    with pytest.raises(SystemExit, match="2"):
        main(["run", str(world), "--frames", "-3"])
    assert capsys.readouterr().err.splitlines()[-1] == (
        "carom run: error: argument --frames: must be a whole number from 0 on, received '-3'"
    )
    with pytest.raises(SystemExit, match="2"):
        main(["rnu"])


def test_view_tells_how_to_get_a_recording(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """The message holds a command to paste."""
    path = tmp_path / "none.rrd"
    assert main(["view", str(path)]) == 2
    message = f"no recording at {path}; make one with: carom run billiards --record {path}\n"
    assert capsys.readouterr().err == message


def test_view_needs_a_display_or_a_browser(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """On a server the browser is the way."""
    path = tmp_path / "a.rrd"
    path.write_bytes(b"")
    for name in ("DISPLAY", "WAYLAND_DISPLAY"):
        monkeypatch.delenv(name, raising=False)
    monkeypatch.setattr(sys, "platform", "linux")
    assert main(["view", str(path)]) == 2
    assert capsys.readouterr().err == f"no display to open a window on; serve it instead: carom view --web {path}\n"
    assert main(["view", "--web", "--json", str(path)]) == 0
    served = json.loads(capsys.readouterr().out)
    data, web = served["command"][6], served["command"][8]
    words = [str(path), "--serve-web", "--bind", "127.0.0.1", "--port", data, "--web-viewer-port", web]
    assert served["command"][1:] == words
    assert served["page"] == f"http://127.0.0.1:{web}/?url=rerun%2Bhttp%3A%2F%2F127.0.0.1%3A{data}%2Fproxy"


def test_explain_schema_and_worlds_print(capsys: pytest.CaptureFixture[str]) -> None:
    """The commands that only tell."""
    assert main(["explain"]) == 0
    assert capsys.readouterr().out.startswith("phase")
    assert main(["explain", "--json"]) == 0
    frame = json.loads(capsys.readouterr().out)
    assert all({"phase", "system", "reads", "writes", "adds"} < system.keys() for system in frame)
    repeated = {system["phase"] for system in frame if system["repeated"]}
    assert repeated == {"substep", "forces", "laws", "begin substep", "end substep"}
    assert main(["schema"]) == 0
    assert "properties" in json.loads(capsys.readouterr().out)
    assert main(["worlds"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert lines.index("impacts") < lines.index("joints")
    assert "  pong               Two dimensions, two paddles, no loss." in "\n".join(lines)
    assert main(["worlds", "--json"]) == 0
    listed = {world["name"]: world for world in json.loads(capsys.readouterr().out)}
    assert sorted(listed) == library.names()
    assert listed["pong"]["group"] == "impacts" and listed["pong"]["title"] == "Pong"


def test_who_reads_no_further_ends_a_command_quietly() -> None:
    """As `carom schema | head` does, which reads less than a pipe holds of all that is printed."""
    words = [sys.executable, "-m", "carom.tools.cli", "schema"]
    with subprocess.Popen(words, stdout=subprocess.PIPE, stderr=subprocess.PIPE) as process:
        assert process.stdout is not None and process.stderr is not None
        assert process.stdout.read(1) == b"{"
        process.stdout.close()
        assert process.stderr.read() == b""
    assert process.returncode == 0


def test_help_names_every_command_and_imports_nothing_of_weight() -> None:
    """So that it comes at once."""
    code = (
        "import sys\nfrom carom.tools.cli import main\n"
        "try:\n    main(['--help'])\nexcept SystemExit:\n    pass\n"
        "heavy = {'numpy', 'numba', 'rerun', 'pyrender', 'fcl', 'pydantic', 'yaml', 'trimesh', 'scipy'}\n"
        "assert not heavy & set(sys.modules), heavy & set(sys.modules)"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    for name in COMMANDS:
        assert f"    {name}" in [line[: 4 + len(name)] for line in done.stdout.splitlines()]


@pytest.mark.parametrize(
    ("command", "option", "known"),
    [
        ("run", "--collision", get_args(Collision)),
        ("run", "--integrator", get_args(Integrator)),
        ("replay", "--detail", DETAILS),
        ("import", "--up", tuple(UPRIGHT)),
    ],
)
def test_what_help_offers_is_what_there_is(command: str, option: str, known: tuple[str, ...]) -> None:
    """Options state their choices again, since help imports nothing that has them."""
    single = parser().parse_args([command, "it"]).parser
    assert [tuple(action.choices) for action in single._actions if option in action.option_strings] == [known]


def test_ctrl_c_ends_cleanly_with_the_recording_flushed(world: Path, tmp_path: Path) -> None:
    """Between two steps: the last recorded frame is the last frame."""
    record = tmp_path / "a.rrd"
    long = changed(world, "duration: 0.5 s", "duration: 1000 s")
    words = [*CAROM, "run", long, "--record", str(record)]
    with subprocess.Popen(words, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as process:
        while not record.exists() or record.stat().st_size < 20_000:
            time.sleep(0.05)
            assert process.poll() is None
        process.send_signal(signal.SIGINT)
        out, err = process.communicate(timeout=60)
    frames = Recording(record).frames
    assert process.returncode == 130
    assert out == ""
    assert err == f"interrupted in frame {frames[-1]}; the recording up to there: carom view {record}\n"


def test_the_module_runs_as_the_console_script_does() -> None:
    """Benches start it this way."""
    done = subprocess.run([*CAROM, "--version"], capture_output=True, text=True, check=True, env=os.environ.copy())
    assert done.stdout.startswith("carom 0.")
