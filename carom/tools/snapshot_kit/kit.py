"""Kit: what all checks of a pytest session share, and what happens at its end."""

from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest

from carom.tools.snapshot_kit.ledger import Ledger

if TYPE_CHECKING:
    from carom.tools.renderer import Renderer

KIT = pytest.StashKey["Kit"]()
REPORT = "carom-report"
PAGE = "index.html"
STEP_SUMMARY = "GITHUB_STEP_SUMMARY"  # a file in CI whose Markdown is shown on the page of the run


class Kit:
    """Where the session's report goes, whether it updates goldens, and renderers by size, which are slow to make."""

    def __init__(self, config: pytest.Config) -> None:
        self._config = config
        stated: Path | None = config.getoption("--carom-report")
        self.root = config.rootpath
        self.report = config.invocation_params.dir / stated if stated else self.root / REPORT
        self.update = bool(config.getoption("--carom-update"))
        self.ledger = Ledger(config)
        self._renderers: dict[tuple[int, int], Renderer] = {}

    def begin(self) -> None:
        """Remove the report of an earlier run."""
        if self.report.is_dir():
            from carom.tools.snapshot_kit.case import forget_cases

            forget_cases(self.report)
            (self.report / PAGE).unlink(missing_ok=True)

    def renderer(self, size: tuple[int, int]) -> Renderer:
        """Return a renderer of pictures of a size."""
        from carom.tools.renderer import Renderer

        if size not in self._renderers:
            self._renderers[size] = Renderer(*size)
        return self._renderers[size]

    def shown(self, path: Path) -> str:
        """Return a path as it is reached from where pytest was started."""
        return os.path.relpath(path, self._config.invocation_params.dir)

    def close(self) -> None:
        """Close the renderers."""
        for renderer in self._renderers.values():
            renderer.close()

    def finish(self) -> bool:
        """Write page and step summary of what did not pass, and update; return whether nothing went wrong in that."""
        if not self.report.is_dir():
            return True
        from carom.tools.snapshot_kit.case import cases
        from carom.tools.snapshot_kit.report import markdown, page

        found = list(cases(self.report))
        if not found:
            return True
        (self.report / PAGE).write_text(page(found), encoding="utf-8")
        if summary := os.environ.get(STEP_SUMMARY):
            with Path(summary).open("a", encoding="utf-8") as file:
                file.write(markdown([case for case, _ in found]))
        return not self.update or self._update()

    def _update(self) -> bool:
        from carom.ecs.errors import CaromError
        from carom.tools.snapshot_kit.accept import accept, changes, read_report

        try:
            made = changes(read_report(self.report), self.root)
            self._tell("goldens to change:", *made)
            accept(made)
        except CaromError as fault:
            self._tell("no golden was changed:", fault)
            return False
        return True

    def _tell(self, *lines: Any) -> None:
        reporter: Any = self._config.pluginmanager.get_plugin("terminalreporter")
        if reporter is not None:
            for line in ("", *lines):
                reporter.write_line(str(line))

    def summary(self) -> Iterator[str]:
        """Yield what to say at the end."""
        if (self.report / PAGE).is_file():
            yield f"carom: expected and actual, side by side: {self.shown(self.report / PAGE)}"
        unused = self.ledger.unused()
        if unused:
            yield "carom: goldens that no test uses; remove them:"
            yield from (f"  {self.shown(path)}" for path in unused)
