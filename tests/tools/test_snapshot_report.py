"""The report of snapshots that do not pass, in a real browser."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from browser import Browser, browser
from unlike import leave_unlike

from carom.tools.snapshot_kit.case import Case, cases
from carom.tools.snapshot_kit.picture import Picture
from carom.tools.snapshot_kit.report import markdown, page

RED, BLUE = (200, 30, 30), (30, 60, 200)


def plain(color: tuple[int, int, int]) -> Picture:
    """Return a picture in one colour."""
    return np.full((240, 320, 3), color, np.uint8)


@pytest.fixture
def report(tmp_path: Path) -> Path:
    """Return a report with one case: red was expected, blue is there."""
    folder = leave_unlike(tmp_path, "carom-report", "tests/test_game.py::test_<start>", plain(RED), plain(BLUE))
    (folder / "index.html").write_text(page(list(cases(folder))))
    return folder / "index.html"


@pytest.fixture
def shown(report: Path, tmp_path: Path) -> Iterator[Browser]:
    """Return a browser that shows it, moved to where no file lies beside it."""
    alone = report.rename(tmp_path / "alone.html")
    with browser(tmp_path / "profile") as made:
        made.open(alone)
        yield made


def share_of_red(shown: Browser) -> float:
    """Return how much of the middle row of the pictures shows what was expected; the rest must show what is."""
    left, top, width, height = shown.box(".frame")
    row = shown.picture()[int(top + height / 2), int(left) : int(left + width)].astype(int)
    red, blue = (np.abs(row - color).max(axis=1) < 8 for color in (RED, BLUE))
    assert (red | blue).mean() > 0.95  # but for the line between them
    assert (np.nonzero(red)[0].max() if red.any() else 0) < (np.nonzero(blue)[0].min() if blue.any() else len(row))
    return float(red.mean())


def test_dragging_in_the_pictures_shows_more_or_less_of_what_was_expected(shown: Browser) -> None:
    """Left of the line is what was expected, right of it what is; the line follows the mouse."""
    assert share_of_red(shown) == pytest.approx(0.5, abs=0.02)
    left, top, width, height = shown.box(".frame")
    middle = top + height / 2
    for at in (0.25, 0.8):
        shown.drag((left + width / 2, middle), (left + at * width, middle))
        assert share_of_red(shown) == pytest.approx(at, abs=0.02)
    shown.click(left + 0.1 * width, middle)
    assert share_of_red(shown) == pytest.approx(0.1, abs=0.02)


def test_the_range_below_moves_the_line_too(shown: Browser) -> None:
    """For keyboards, and for fingers that would hide what they touch."""
    left, top, width, height = shown.box("input[type=range]")
    shown.click(left + width - 2, top + height / 2)
    assert share_of_red(shown) > 0.95


def test_the_difference_and_both_in_turns(shown: Browser) -> None:
    """Buttons show what differs in red, and the two pictures one after the other."""
    for number, mode in enumerate(("slide", "difference", "blink")):
        left, top, width, height = shown.box(f".modes button:nth-child({number + 1})")
        shown.click(left + width / 2, top + height / 2)
        assert shown.value("document.querySelector('.compare').dataset.mode") == mode
        if mode == "difference":
            left, top, width, height = shown.box(".frame")
            assert shown.picture()[int(top + height / 2), int(left + width / 2)].tolist() == [220, 0, 30]
    style = "getComputedStyle(document.querySelector('.expected'))"
    assert shown.value(f"{style}.animationName") == "blink" and shown.value(f"{style}.clipPath") == "none"


def test_it_says_what_a_terminal_says(shown: Browser) -> None:
    """Test, layer, frame and commands; what looks like HTML in a name is text."""
    assert shown.value("document.querySelector('h1').innerText") == "carom: 1 snapshot does not pass"
    text = shown.value("document.querySelector('article').innerText")
    for part in (
        "rendering",
        "tests/test_game.py::test_<start> start",
        "4 x 4 px from (0, 0) on differ by 170.0 of 255, at most 2.5 may on the driver that drew the golden",
        'pytest "tests/test_game.py::test_<start>" --carom-update',
    ):
        assert part in text


def test_markdown_keeps_to_its_cells() -> None:
    """Bars and lines within a text do not break the table."""
    case = Case("test_a.py::test_b[x|y]", "__carom__/test_a/b", "physics", "a\nb | c", 3, {})
    assert markdown([case]) == (
        "## Snapshots that do not pass\n"
        "\n"
        "| layer | test | what | again |\n"
        "| --- | --- | --- | --- |\n"
        '| physics | `test_a.py::test_b[x\\|y]` | a b \\| c | `pytest "test_a.py::test_b[x\\|y]"` |\n'
        "\n"
        "To take them over: download the report of this run and `carom accept REPORT.zip`.\n"
    )
