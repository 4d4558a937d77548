"""The wheel holds what is tracked under carom/ and nothing else, and the source distribution builds the same wheel."""

from __future__ import annotations

import re
import shutil
import subprocess
import sys
import tarfile
import zipfile
from pathlib import Path

import pytest

import carom

ROOT = Path(__file__).parents[1]


def built(tree: Path, kind: str, folder: Path) -> Path:
    """Return the wheel or sdist of a tree, built by what pip would build it by."""
    command = [sys.executable, "-m", "hatchling", "build", "--target", kind, "--directory", str(folder)]
    subprocess.run(command, cwd=tree, check=True, capture_output=True)
    (made,) = folder.glob("carom-*")
    return made


def held(wheel: Path) -> dict[str, int]:
    """Return name and checksum of each file of a wheel, but for the list of them."""
    with zipfile.ZipFile(wheel) as archive:
        return {item.filename: item.CRC for item in archive.infolist() if not item.filename.endswith("/RECORD")}


def listed(*options: str) -> set[str]:
    """Return files of the clone under carom/."""
    command = ["git", "ls-files", *options, "carom"]
    names = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=True).stdout.splitlines()
    return {name for name in names if (ROOT / name).is_file()}


@pytest.mark.skipif(not (ROOT / ".git").exists() or shutil.which("git") is None, reason="not in a clone")
def test_the_wheel_holds_the_tracked_files_and_the_sdist_builds_the_same(tmp_path: Path) -> None:
    """The library's worlds, the shaders and the licence included, and no room under a name of its own."""
    wheel = built(ROOT, "wheel", tmp_path / "wheel")
    found = held(wheel)
    packaged = {name for name in found if ".dist-info/" not in name}
    assert packaged - listed("--others", "--exclude-standard") == listed()
    assert {name.split("/")[0] for name in packaged} == {"carom"}
    assert any(name.startswith("carom/worlds/library/") and name.endswith(".yaml") for name in packaged)
    about = f"carom-{carom.__version__}.dist-info"
    assert f"{about}/licenses/LICENSE" in found
    with zipfile.ZipFile(wheel) as archive:
        assert "carom = carom.tools.cli:main" in archive.read(f"{about}/entry_points.txt").decode()

    source = built(ROOT, "sdist", tmp_path / "sdist")
    with tarfile.open(source) as archive:
        archive.extractall(tmp_path, filter="data")
    tree = tmp_path / f"carom-{carom.__version__}"
    for name in ("CHANGELOG.md", "LICENSE", "Makefile", ".ci/setup", "docs/library.md", "tests/test_wheel.py"):
        assert (tree / name).read_bytes() == (ROOT / name).read_bytes()
    assert held(built(tree, "wheel", tmp_path / "again")) == found


def test_the_changelog_begins_with_this_version() -> None:
    """Its first heading is the version of the package."""
    first = re.search(r"^## (\S+)", (ROOT / "CHANGELOG.md").read_text(encoding="utf-8"), re.MULTILINE)
    assert first is not None and first[1] == carom.__version__
