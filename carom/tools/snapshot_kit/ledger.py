"""Ledger: which goldens the checks of a session used, so that those nobody used can be told."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import pytest

FOLDER = "__carom__"
ENDINGS = STATE, PICTURE = (".json", ".png")
TOLD = "carom"  # the key of what a worker of xdist hands to its controller


def folder_of(path: Path) -> Path:
    """Return the folder of the goldens of a test file."""
    return path.parent / FOLDER / (path.stem if path.suffix == ".py" else path.name)


class Ledger:
    """A plugin that notes tests, who passed, and goldens used; of files whose tests all ran and passed it can judge.

    With xdist the workers collect and run; each hands on what it saw.
    """

    def __init__(self, config: pytest.Config) -> None:
        self._config = config
        self._tests: dict[str, set[str]] = {}
        self._in_part: set[str] = set()
        self._used: set[str] = set()
        self._passed: set[str] = set()

    def use(self, *goldens: Path) -> None:
        """Note goldens that a check asked for."""
        self._used.update(map(str, goldens))

    def unused(self) -> list[Path]:
        """Return the goldens of wholly run files that no check asked for, and those of files that are gone."""
        whole = [Path(file) for file in self._tests.keys() - self._in_part if self._tests[file] <= self._passed]
        folders = {folder_of(file) for file in whole}
        for parent in {file.parent for file in whole}:
            there = {path.name for path in parent.iterdir()}
            folders.update(one for one in (parent / FOLDER).glob("*/") if not {one.name, f"{one.name}.py"} & there)
        files = (path for folder in folders for path in folder.glob("*") if path.suffix in ENDINGS)
        return sorted(path for path in files if str(path) not in self._used)

    def pytest_deselected(self, items: Sequence[pytest.Item]) -> None:
        """Note files of which some tests are left out."""
        self._in_part.update(str(item.path) for item in items)

    def pytest_collection_finish(self, session: pytest.Session) -> None:
        """Note which tests each file has, and which files were asked for in part."""
        for item in session.items:
            self._tests.setdefault(str(item.path), set()).add(item.nodeid)
        asked = (word.partition("::") for word in session.config.args)
        self._in_part.update(str(session.config.invocation_params.dir / path) for path, part, _ in asked if part)
        if session.config.getoption("lf", False):
            self._in_part.update(self._tests)

    def pytest_runtest_logreport(self, report: pytest.TestReport) -> None:
        """Note who passed."""
        if report.when == "call" and report.passed:
            self._passed.add(report.nodeid)

    def pytest_sessionfinish(self, session: pytest.Session) -> None:
        """Hand on what a worker saw."""
        told: dict[str, Any] | None = getattr(session.config, "workeroutput", None)
        if told is not None:
            tests = {file: sorted(names) for file, names in self._tests.items()}
            told[TOLD] = (tests, sorted(self._in_part), sorted(self._used))

    @pytest.hookimpl(optionalhook=True)
    def pytest_testnodedown(self, node: Any, error: object) -> None:
        """Take what a worker saw."""
        tests, in_part, used = getattr(node, "workeroutput", {}).get(TOLD, ({}, [], []))
        for file, names in tests.items():
            self._tests.setdefault(file, set()).update(names)
        self._in_part.update(in_part)
        self._used.update(used)
