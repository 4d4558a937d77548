"""The gallery: a page of worlds, in a real browser, and the short films in it."""

from __future__ import annotations

import io
import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from browser import Browser, browser
from PIL import Image

from carom.tools.cli import main
from carom.tools.filming import shot_of
from carom.tools.gallery import WIDTH, card, page
from carom.tools.glimpse import FEWEST, MOST, RATE, Glimpse
from carom.tools.session import run
from carom.worlds import load_text

TURNING = """
carom: 1
name: A box that turns, so that no two pictures are alike
gravity: [0, 0, 0]
step: {dt: 1/100, substeps: 1}
run: {frames: %d}
entities: [{name: box, collider: {box: {size: [1, 1, 1]}}, body: {mass: 1}, motion: {angular: [0, 2, 0]}}]
"""
ELSEWHERE = "performance.getEntriesByType('resource').filter(e => !e.name.startsWith('data:')).length"


def test_a_browser_shows_a_card_with_film_law_and_expectations_for_each_world(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Group by group; every film is there, and none comes from elsewhere."""
    path = tmp_path / "page" / "worlds.html"
    assert main(["gallery", "--only", "head_on", "orbit", "bounce", "-o", str(path), "--json"]) == 0
    told = json.loads(capsys.readouterr().out)
    assert told == {"page": str(path), "worlds": ["orbit", "bounce", "head_on"], "failed": []}
    alone = path.rename(tmp_path / "alone.html")
    with browser(tmp_path / "profile") as shown:
        shown.open(alone)
        assert shown.value("[...document.querySelectorAll('h2')].map(e => e.id)") == ["gravitation", "impacts"]
        assert shown.value("[...document.querySelectorAll('article')].map(e => e.id)") == told["worlds"]
        assert shown.value("[...document.images].map(e => e.naturalWidth)") == [WIDTH] * 3
        assert shown.value(ELSEWHERE) == 0
        first = film_of(shown, "orbit")
        assert any(not np.array_equal(first, film_of(shown, "orbit")) for _ in range(1000))  # it plays
        assert "leaves with e g t" in shown.value("document.querySelector('#bounce .seen pre').textContent")
        assert shown.value("document.querySelector('#bounce .held').textContent") == "19 of 19 expectations held"
        assert shown.value("document.querySelectorAll('#bounce td.held').length") == 19
        assert shown.value("document.querySelector('#bounce details').open") is False


def film_of(shown: Browser, world: str) -> np.ndarray:
    """Return what the browser shows of a world's film now."""
    left, top, width, height = (round(side) for side in shown.box(f"#{world} img"))
    return shown.picture()[top : top + height, left : left + width]


def test_a_world_that_does_not_hold_says_so_at_once() -> None:
    """Its table is open, with what was expected and received."""
    one = card("flight", "falling_ball")
    first = replace(one.outcomes[0], held=False, received="<3 J>")
    shown = page([replace(one, outcomes=[first, *one.outcomes[1:]])])
    count = len(one.outcomes)
    assert f'<details open><summary class="failed">{count - 1} of {count} expectations held' in shown
    assert shown.count('<td class="failed">failed</td>') == 1
    assert "<td>&lt;3 J&gt;</td>" in shown


@pytest.mark.parametrize(
    ("frames", "planned", "pictures", "stride"),
    [(6, 6, 7, 1), (48, 48, 25, 2), (200, 200, 26, 8), (600, 600, 38, 16), (200, 9000, 26, 8)],
)
def test_a_film_shows_a_whole_run_in_few_pictures(
    frames: int, planned: int, pictures: int, stride: int, tmp_path: Path
) -> None:
    """Short runs slower, long ones faster, and those that end before their time to that end."""
    loaded = load_text(TURNING % frames)
    glimpse = Glimpse(replace(shot_of(loaded), width=64, height=48), tmp_path / "film.webp", planned)
    run(loaded, [glimpse])
    film = Image.open(io.BytesIO((tmp_path / "film.webp").read_bytes()))
    assert getattr(film, "n_frames", 1) == pictures < MOST
    rate = RATE * min(1.0, pictures / FEWEST)
    assert glimpse.speed == pytest.approx(stride * 0.01 * rate)


def test_unknown_worlds_and_groups_are_refused_before_anything_runs(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    """With those that are near."""
    monkeypatch.chdir(tmp_path)
    assert main(["gallery", "--only", "impact", "orbit"]) == 2
    assert capsys.readouterr().err == (
        "--only: no group or world of the library; received impact; accepted: the groups contact, events, flight, "
        "gravitation, impacts, joints, particles, space, and worlds; did you mean 'impacts'?\n"
    )
    assert not list(tmp_path.glob("*"))
