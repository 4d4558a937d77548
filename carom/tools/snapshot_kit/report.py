"""Report: every check of a run that did not pass, as one page that needs nothing but itself, and as Markdown for CI."""

from __future__ import annotations

from base64 import b64encode
from collections.abc import Sequence
from html import escape
from importlib.resources import files
from pathlib import Path

from carom.tools.snapshot_kit.case import RECORDING, Case

PICTURES = ("expected", "actual", "difference")


def page(cases: Sequence[tuple[Case, Path]]) -> str:
    """Return the page (HTML) of cases and their folders; pictures are in it."""
    template = files("carom.tools.snapshot_kit").joinpath("report.html").read_text(encoding="utf-8")
    count = f"{len(cases)} {'snapshot does' if len(cases) == 1 else 'snapshots do'} not pass"
    articles = "\n".join(_article(case, folder) for case, folder in cases)
    return template.replace("{{count}}", count).replace("{{cases}}", articles)


def _article(case: Case, folder: Path) -> str:
    rows = [("frame", str(case.frame))]
    stated = (("entity", case.entity), ("column", case.column), ("expected", case.expected), ("actual", case.actual))
    rows += [(name, value) for name, value in stated if value]
    table = "".join(f"<tr><th>{name}</th><td>{escape(value)}</td></tr>" for name, value in rows)
    commands = [("again", case.again), ("accept", case.accept)]
    if (folder / RECORDING).is_file():
        commands.insert(0, ("last frames", f"carom view {'/'.join(folder.parts[-3:])}/{RECORDING}"))
    lines = "".join(f"<dt>{name}</dt><dd><code>{escape(command)}</code></dd>" for name, command in commands)
    return (
        f'<article id="{escape(folder.name)}"><h2><b class="{escape(case.kind)}">{escape(case.kind)}</b> '
        f"{escape(case.test)} <i>{escape(Path(case.golden).name)}</i></h2><p>{escape(case.what)}</p>"
        f"{_compare(folder)}<table>{table}</table><dl>{lines}</dl></article>"
    )


def _compare(folder: Path) -> str:
    """Return the pictures: side by side where they can be compared, as they are where not."""
    found = {name: _picture(folder / f"{name}.png", name) for name in PICTURES if (folder / f"{name}.png").is_file()}
    if "difference" not in found:
        figures = (f"<figure>{image}<figcaption>{name}</figcaption></figure>" for name, image in found.items())
        return f'<div class="pictures">{"".join(figures)}</div>'
    return f'<div class="compare" data-mode="slide">{"".join(found.values())}</div>'


def _picture(path: Path, name: str) -> str:
    return f'<img class="{name}" alt="{name}" src="data:image/png;base64,{b64encode(path.read_bytes()).decode()}">'


def markdown(cases: Sequence[Case]) -> str:
    """Return the cases as a section for the summary of a CI run."""
    rows = [f"| {case.kind} | `{_cell(case.test)}` | {_cell(case.what)} | `{_cell(case.again)}` |" for case in cases]
    head = ["## Snapshots that do not pass", "", "| layer | test | what | again |", "| --- | --- | --- | --- |"]
    tail = ["", "To take them over: download the report of this run and `carom accept REPORT.zip`.", ""]
    return "\n".join([*head, *rows, *tail])


def _cell(text: str) -> str:
    return " ".join(text.split()).replace("|", "\\|")
