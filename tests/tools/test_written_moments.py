"""Moments of runs and of recordings as world files, from the command line."""

from __future__ import annotations

from pathlib import Path

import pytest

from carom.tools.cli import main


def test_a_moment_of_a_recording_goes_on_to_the_same_end(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Written in the middle, run to the end and written again, it is the file that the run itself has written."""
    record, moment, end, again = (str(tmp_path / name) for name in ("a.rrd", "moment.yaml", "end.yaml", "again.yaml"))
    assert main(["run", "trap", "--frames", "40", "--record", record, "--write", end]) == 0
    assert main(["replay", record, "--to", "25", "--write", moment]) == 0
    assert main(["check", moment]) == 0
    assert main(["run", moment, "--frames", "40", "--write", again]) == 0
    assert Path(again).read_text() == Path(end).read_text()
    told = capsys.readouterr().out
    assert f"  world         {end}\n" in told
    assert f"  world      {moment}\n" in told


def test_a_world_is_written_to_yaml_and_nothing_else(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Said before anything runs."""
    with pytest.raises(SystemExit) as ended:
        main(["run", "bounce", "--write", str(tmp_path / "w.json")])
    assert ended.value.code == 2
    told = f"argument --write: must end in .yaml or .yml, received {str(tmp_path / 'w.json')!r}\n"
    assert capsys.readouterr().err.endswith(told)


def test_a_world_does_not_write_itself(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """What somebody wrote by hand would be lost, and --watch would see it saved."""
    world = tmp_path / "w.yaml"
    world.write_text("carom: 1\n")
    assert main(["run", str(world), "--write", str(world)]) == 2
    assert capsys.readouterr().err == f"{world} is the world itself; write another file\n"
    assert world.read_text() == "carom: 1\n"
