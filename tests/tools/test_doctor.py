"""The doctor finds what works, and says how to mend what does not."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from carom.tools import doctor as module
from carom.tools import offscreen
from carom.tools.doctor import FaultError, Finding, doctor, examine


def test_all_works_on_a_machine_that_runs_the_tests(capsys: pytest.CaptureFixture[str]) -> None:
    """The doctor reports its seven parts in order, each working, and exits with code 0."""
    assert doctor(json=True) == 0
    found = {finding["name"]: finding for finding in json.loads(capsys.readouterr().out)}
    assert list(found) == ["python", "processor", "kernels", "collision", "graphics", "recording", "film", "extensions"]
    assert all(finding["works"] and finding["mend"] == "" for finding in found.values())
    assert found["collision"]["seen"].endswith("two unit spheres 1.5 m apart overlap by 0.5 m")
    assert "llvmpipe" in found["graphics"]["seen"]


def test_a_fault_is_printed_with_its_cure(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    """One failed check makes the exit code 1, and the checks after it still run."""

    def fuse() -> str:
        raise FaultError("the fuse has blown", "put in a new one")

    def lamp() -> str:
        return "burns"

    monkeypatch.setattr(module, "CHECKS", (fuse, lamp))
    assert doctor() == 1
    assert capsys.readouterr().out == (
        "FAIL  fuse       the fuse has blown\n                 put in a new one\nok    lamp       burns\n"
    )


def test_a_cache_that_cannot_be_written_names_the_variable(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    """Without a writable cache folder the kernels do not work, and NUMBA_CACHE_DIR mends that."""

    def refuse(*arguments: object, **options: object) -> None:
        raise PermissionError("read-only")

    monkeypatch.setattr(module, "TemporaryFile", refuse)
    assert examine(module.kernels) == Finding(
        "kernels",
        False,
        "no folder to cache kernels in: read-only",
        "set the environment variable NUMBA_CACHE_DIR to a folder that can be written",
    )


def test_missing_graphics_say_what_to_install(monkeypatch: pytest.MonkeyPatch) -> None:
    """The message of a graphics error becomes the cure of the finding, word for word."""

    def missing() -> str:
        raise offscreen.GraphicsError("no OpenGL; run: sudo apt-get install -y libosmesa6")

    monkeypatch.setattr(offscreen, "backend", missing)
    finding = examine(module.graphics)
    assert (finding.works, finding.mend) == (False, "no OpenGL; run: sudo apt-get install -y libosmesa6")


def test_an_unforeseen_error_is_a_finding_too(monkeypatch: pytest.MonkeyPatch) -> None:
    """Any exception in a check is caught, shown with its type, and answered with a reinstall."""

    def broken() -> str:
        raise ImportError("no module")

    assert examine(broken) == Finding(
        "broken", False, "ImportError: no module", "run: python -m pip install --force-reinstall carom"
    )
