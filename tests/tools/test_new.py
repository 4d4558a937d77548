"""A new project passes its own tests at once."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

from carom.tools.cli import main
from carom.worlds.schema import json_schema

ROOT = Path(__file__).parents[2]


def test_a_new_project_passes_its_tests_and_its_checks(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """Where carom is, before the project is installed; its world is told nothing of."""
    monkeypatch.chdir(tmp_path)
    assert main(["new", "kite"]) == 0
    assert capsys.readouterr().out.splitlines()[-1] == (
        "next: cd kite; pytest; carom run worlds/first.yaml --film out/first.mp4"
    )
    environment = {key: value for key, value in os.environ.items() if key != "PYTEST_XDIST_WORKER"}
    run = subprocess.run(
        [sys.executable, "-m", "pytest", "-p", "no:hypothesispytest", "-p", "no:cacheprovider"],
        cwd=tmp_path / "kite",
        env=environment | {"PYTHONPATH": str(ROOT)},
        capture_output=True,
        text=True,
    )
    assert run.returncode == 0, run.stdout + run.stderr
    assert "2 passed" in run.stdout
    assert main(["check", "kite/worlds/first.yaml"]) == 0
    told = capsys.readouterr()
    assert (told.out, told.err) == ("ok     kite/worlds/first.yaml: 3 entities, 2 expectations\n", "")
    assert main(["fmt", "--check", "kite/worlds/first.yaml"]) == 0
    first = Path("kite/worlds/first.yaml").read_text().partition("\n")[0]
    assert first == "# yaml-language-server: $schema=carom.schema.json"
    assert json.loads(Path("kite/worlds/carom.schema.json").read_text()) == json_schema()


def test_a_project_is_written_over_nothing(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """A folder that is there stays as it is, and a name must be one of a package."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "kite").mkdir()
    assert main(["new", "kite"]) == 2
    assert capsys.readouterr().err == "kite is there already; state another name, or remove it\n"
    assert list((tmp_path / "kite").iterdir()) == []
    for name, why in (
        ("Kite", "is no name of a package"),
        ("json", "is taken"),
        ("../kite", "is no name of a package"),
    ):
        with pytest.raises(SystemExit) as refused:
            main(["new", name])
        assert refused.value.code == 2
        assert f"{name!r} {why}; state a small letter, then small letters, digits or _" in capsys.readouterr().err
