"""The README cannot rot: its world, its Python, its frame and its commands are run."""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path

import pytest

from carom.ecs.explain import explain
from carom.systems.step import STEP
from carom.tools.cli import main

ROOT = Path(__file__).resolve().parents[1]
README = (ROOT / "README.md").read_text()


def blocks(language: str) -> list[str]:
    """Return the code blocks of one language."""
    return re.findall(rf"^```{language}\n(.*?)^```", README, re.MULTILINE | re.DOTALL)


def test_the_frame_is_the_one_that_runs() -> None:
    """The table under "The frame" is what `carom explain` prints."""
    assert explain(STEP) in blocks("text")


def test_the_world_holds_what_it_expects(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """The world file of the README runs and all of its expectations hold."""
    (world,) = blocks("yaml")
    path = tmp_path / "world.yaml"
    path.write_text(world)
    assert main(["test", str(path)]) == 0
    assert "3 of 3 expectations held" in capsys.readouterr().out


def test_the_python_runs() -> None:
    """The Python of the README runs as it stands and prints a ball on the ground."""
    (code,) = blocks("python")
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert run.stdout.startswith("[0.")


def test_its_commands_and_files_exist() -> None:
    """Every make target, carom command and linked file that the README names is there."""
    makefile = (ROOT / "Makefile").read_text()
    for target in re.findall(r"make (\w+)", README):
        if target not in ("and",):
            assert f"\n{target}:" in makefile, target
    for command in set(re.findall(r"`carom (\w+)", README)):
        assert (ROOT / "carom/tools/commands" / f"{command}.py").is_file(), command
    for path in re.findall(r"\]\(((?!http)[^)#]+)", README):
        assert (ROOT / path).is_file(), path
