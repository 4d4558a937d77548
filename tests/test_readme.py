"""The README cannot rot: its world, its Python, its frame and the commands it names are run or looked up."""

from __future__ import annotations

import math
import re
import subprocess
import sys
from pathlib import Path

import pytest
from pages import ROOT, blocks

from carom.ecs.explain import explain
from carom.systems.step import STEP
from carom.tools.cli import COMMANDS, main

README = ROOT / "README.md"


def block(language: str) -> str:
    """Return the one block of code in a language."""
    (found,) = blocks(README, language)
    return found.text


def test_the_frame_is_the_one_that_runs() -> None:
    """The table under "The frame" is what `carom explain` prints."""
    assert explain(STEP) == block("text")


def test_the_world_holds_what_it_expects(tmp_path: Path) -> None:
    """The world file of the README has twelve lines, runs, and all of its expectations hold."""
    path = tmp_path / "world.yaml"
    path.write_text(block("yaml"))
    assert len(block("yaml").splitlines()) == 12
    assert main(["test", str(path)]) == 0


def test_the_python_makes_the_same_world() -> None:
    """The Python of the README runs as it stands and prints where a ball is after two bounces, v / 2 and v / 4."""
    run = subprocess.run([sys.executable, "-c", block("python")], capture_output=True, text=True, check=True)
    fall = math.sqrt(2.0 / 9.81)
    left, speed = 1.0 - 2.0 * fall, 9.81 * fall / 4.0
    height, rising = (float(number) for number in re.findall(r"0\.\d+", run.stdout))
    assert height == pytest.approx(0.1 + speed * left - 9.81 * left**2 / 2.0, abs=1e-7)
    assert rising == pytest.approx(speed - 9.81 * left, abs=1e-7)


def test_what_it_names_exists() -> None:
    """Every target of make and command of carom; tests/test_docs.py looks after links and blocks."""
    text, makefile = README.read_text(), (ROOT / "Makefile").read_text()
    for target in re.findall(r"`make (\w+)|^make (\w+)", text, re.MULTILINE):
        assert f"\n{''.join(target)}:" in makefile, target
    assert set(re.findall(r"`carom ([a-z]+)", text)) <= set(COMMANDS)
