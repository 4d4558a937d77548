"""The wheel holds what is tracked under carom/, all of it and nothing else."""

from __future__ import annotations

import shutil
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]


@pytest.mark.skipif(not (ROOT / ".git").exists() or shutil.which("git") is None, reason="not in a clone")
def test_the_wheel_holds_the_tracked_files(tmp_path: Path) -> None:
    """The library's worlds and the shaders included, and no room under a name of its own."""
    listed = subprocess.run(["git", "ls-files", "carom"], cwd=ROOT, capture_output=True, text=True, check=True)
    tracked = {name for name in listed.stdout.splitlines() if (ROOT / name).is_file()}
    command = [sys.executable, "-m", "pip", "wheel", "--quiet", "--no-deps", "--wheel-dir", str(tmp_path), str(ROOT)]
    subprocess.run(command, check=True, capture_output=True)
    (wheel,) = tmp_path.glob("carom-*.whl")
    with zipfile.ZipFile(wheel) as archive:
        held = {name for name in archive.namelist() if ".dist-info/" not in name}
        entries = archive.read(next(n for n in archive.namelist() if n.endswith("entry_points.txt"))).decode()
    untracked = subprocess.run(
        ["git", "ls-files", "--others", "--exclude-standard", "carom"],
        cwd=ROOT,
        capture_output=True,
        text=True,
        check=True,
    )
    assert held - set(untracked.stdout.splitlines()) == tracked
    assert {name.split("/")[0] for name in held} == {"carom"}
    assert any(name.startswith("carom/worlds/library/") and name.endswith(".yaml") for name in held)
    assert "carom = carom.tools.cli:main" in entries
