"""The tutorial, word for word: from an empty folder, in order, every file written and every command run as it says."""

from __future__ import annotations

import os
import site
import subprocess
import sys
from pathlib import Path

import pytest
from pages import ROOT, blocks, like, run_by_shell

PAGE = ROOT / "docs" / "tutorial.md"
# Its pip has no network: what it would fetch is there already. "0" is how pip is told not to isolate.
OFFLINE = {"PIP_NO_DEPS": "1", "PIP_NO_BUILD_ISOLATION": "0", "PIP_NO_INDEX": "1", "PIP_QUIET": "1"}
PROGRAMS = {"carom": "carom.tools.cli", "pytest": "pytest -p no:hypothesispytest", "pip": "pip"}


@pytest.mark.slow
def test_the_tutorial_ends_where_it_says(tmp_path: Path) -> None:
    """In an environment of its own, into which `pip install -e .` may write."""
    environment, folder = surroundings(tmp_path / "venv"), tmp_path / "empty"
    folder.mkdir()
    for block in blocks(PAGE):
        if block.title:
            (folder / block.title).write_text(block.text)
        elif block.language == "sh":
            for command in block.text.splitlines():
                if command.startswith("cd "):
                    folder = folder / command.removeprefix("cd ")
                else:
                    done, told = run_by_shell(command, folder, environment)
                    assert done == 0, told
        else:
            assert block.language == "console", block
            for part in block.text.removeprefix("$ ").split("\n$ "):
                command, _, told = part.partition("\n")
                _, printed = run_by_shell(command, folder, environment)
                assert like(told, printed), f"{command}\n{printed}"
    assert (folder / "rocket.rrd").stat().st_size > 10_000
    assert (folder / "rocket.png").read_bytes().startswith(b"\x89PNG")


def surroundings(venv: Path) -> dict[str, str]:
    """Make a virtual environment with everything that is here; return the variables in which it is used."""
    subprocess.run([sys.executable, "-m", "venv", "--without-pip", str(venv)], check=True)
    library = next(venv.glob("lib/python3*/site-packages"))
    (library / "here.pth").write_text("\n".join([str(ROOT), *site.getsitepackages()]))
    for name, module in PROGRAMS.items():
        program = venv / "bin" / name
        program.write_text(f'#!/bin/sh\nexec "{venv}/bin/python" -m {module} "$@"\n')
        program.chmod(0o755)
    kept = {key: value for key, value in os.environ.items() if key not in ("PYTEST_XDIST_WORKER", "PYTHONPATH")}
    return {**kept, **OFFLINE, "PATH": f"{venv}/bin{os.pathsep}{kept['PATH']}", "PYTHONDONTWRITEBYTECODE": "1"}
