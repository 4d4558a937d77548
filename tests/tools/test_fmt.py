"""`carom fmt` writes files that are not in form, and leaves alone what it cannot read."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from carom.tools.cli import main

UNTIDY, TIDY = "name: a # one\ncarom: 1\n", "carom: 1\nname: a  # one\n"


@pytest.fixture(autouse=True)
def _folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    Path("bad.yaml").write_text("carom: [\n")
    Path("tidy.yaml").write_text(TIDY)
    Path("untidy.yaml").write_text(UNTIDY)


def test_files_are_written(capsys: pytest.CaptureFixture[str]) -> None:
    """Those that change are named; the rest is not touched."""
    assert main(["fmt", "bad.yaml", "tidy.yaml", "untidy.yaml"]) == 2
    told = capsys.readouterr()
    assert told.out == "changed  untidy.yaml\n"
    assert told.err == "bad.yaml:2:1: is not YAML: while parsing a flow node did not find expected node content\n"
    assert [Path(f"{name}.yaml").read_text() for name in ("bad", "tidy", "untidy")] == ["carom: [\n", TIDY, TIDY]
    assert main(["fmt", "tidy.yaml", "untidy.yaml"]) == 0
    assert capsys.readouterr().out == ""


def test_check_and_diff_write_nothing(capsys: pytest.CaptureFixture[str]) -> None:
    """``--check`` exits 1 and names files, ``--diff`` shows lines."""
    assert main(["fmt", "--check", "tidy.yaml"]) == 0
    assert main(["fmt", "--check", "tidy.yaml", "untidy.yaml"]) == 1
    assert capsys.readouterr().out == "not in form  untidy.yaml\n"
    assert main(["fmt", "--diff", "untidy.yaml"]) == 0
    assert capsys.readouterr().out == (
        "--- untidy.yaml\n+++ untidy.yaml\n@@ -1,2 +1,2 @@\n-name: a # one\n carom: 1\n+name: a  # one\n"
    )
    assert main(["fmt", "--check", "--json", "untidy.yaml"]) == 1
    assert json.loads(capsys.readouterr().out) == {"changed": [], "to_change": ["untidy.yaml"], "unread": []}
    assert Path("untidy.yaml").read_text() == UNTIDY


def test_the_header_for_editors(capsys: pytest.CaptureFixture[str]) -> None:
    """It is written where the schema lies beside the file."""
    Path("carom.schema.json").write_text("{}")
    assert main(["fmt", "tidy.yaml"]) == 0
    assert Path("tidy.yaml").read_text() == "# yaml-language-server: $schema=carom.schema.json\n" + TIDY
    assert main(["fmt", "--check", "tidy.yaml"]) == 0
