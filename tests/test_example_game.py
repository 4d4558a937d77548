"""The example game passes its own tests where carom is installed beside it; .ci/run does the same with the wheel."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

GAME = Path(__file__).parent / "example_game"


def test_the_example_game_passes_its_tests(tmp_path: Path, pytestconfig: pytest.Config) -> None:
    """In a copy, installed offline; ``--carom-update`` brings the goldens it makes there back."""
    game, site = tmp_path / "game", tmp_path / "site"
    shutil.copytree(GAME, game, ignore=shutil.ignore_patterns("__pycache__", "carom-report"))
    alone = ["--no-deps", "--no-build-isolation", "--no-index", "--disable-pip-version-check"]
    install = ["-m", "pip", "install", "--quiet", *alone, "--target", str(site), str(game)]
    subprocess.run([sys.executable, *install], check=True, capture_output=True)
    paths = os.pathsep.join([str(site), str(Path(__file__).parents[1])])
    update = ["--carom-update"] if pytestconfig.getoption("--carom-update") else []
    command = [sys.executable, "-m", "pytest", "-p", "no:hypothesispytest", *update]
    run = subprocess.run(command, cwd=game, env=os.environ | {"PYTHONPATH": paths}, capture_output=True, text=True)
    assert run.returncode == 0, run.stdout + run.stderr
    assert "3 passed" in run.stdout
    if update:
        for golden in game.glob("*/__carom__/*/*"):
            shutil.copyfile(golden, GAME / golden.relative_to(game))
