"""Gallery: worlds of the library on one page that needs nothing but itself, each with film, law and expectations."""

from __future__ import annotations

from base64 import b64encode
from collections.abc import Sequence
from dataclasses import dataclass, replace
from html import escape
from importlib.resources import files
from itertools import groupby
from pathlib import Path
from tempfile import TemporaryDirectory

from carom.tools.filming import shot_of
from carom.tools.glimpse import Glimpse
from carom.tools.session import run
from carom.worlds.builder import load_world
from carom.worlds.expectation import Outcome
from carom.worlds.library import lesson

WIDTH = 360  # of films, px


@dataclass(frozen=True)
class Card:
    """What the page tells of a world: its file, a film (WebP) with its speed, and what became of its expectations."""

    group: str
    name: str
    title: str
    description: str
    source: str
    film: bytes
    speed: float
    outcomes: list[Outcome]

    @property
    def held(self) -> bool:
        """Whether all that the world expects has held."""
        return all(outcome.held for outcome in self.outcomes)


def card(group: str, name: str) -> Card:
    """Run a world of the library and return its card."""
    loaded = load_world(name)
    shot = shot_of(loaded)
    shot = replace(shot, width=WIDTH, height=round(WIDTH * shot.height / shot.width))
    with TemporaryDirectory() as folder:
        path = Path(folder, "film.webp")
        glimpse = Glimpse(shot, path, loaded.run.frames)
        run(loaded, [glimpse])
        film = path.read_bytes()
    outcomes = [item.outcome() for item in loaded.expectations]
    return Card(group, name, loaded.name, loaded.description, loaded.source_text, film, glimpse.speed, outcomes)


def page(cards: Sequence[Card]) -> str:
    """Return the page (HTML) of cards, which come group by group."""
    template = files("carom.tools").joinpath("gallery.html").read_text(encoding="utf-8")
    sections = [(group, list(members)) for group, members in groupby(cards, key=lambda one: one.group)]
    links = "".join(f'<a href="#{escape(group)}">{escape(group)}</a>' for group, _ in sections)
    body = "\n".join(
        f'<h2 id="{escape(group)}">{escape(group)}</h2>\n' + "\n".join(_article(one) for one in members)
        for group, members in sections
    )
    return template.replace("{{links}}", links).replace("{{worlds}}", body)


def _article(card: Card) -> str:
    rows = "".join(_row(outcome) for outcome in card.outcomes)
    count = f"{sum(outcome.held for outcome in card.outcomes)} of {len(card.outcomes)} expectations held"
    return (
        f'<article id="{escape(card.name)}"><h3>{escape(card.title)} <i>{escape(card.name)}</i></h3>'
        f"<p>{escape(card.description)}</p>"
        f'<div class="seen"><figure><img alt="{escape(card.title)}" src="data:image/webp;base64,'
        f'{b64encode(card.film).decode()}"><figcaption>{_times(card.speed)}</figcaption></figure>'
        f"<pre>{escape(lesson(card.source))}</pre></div>"
        f'<details{"" if card.held else " open"}><summary class="{"held" if card.held else "failed"}">{count}</summary>'
        f"<table><tr><th></th><th>expectation</th><th>expected</th><th>received</th></tr>{rows}</table></details>"
        f"<details><summary>the world file</summary><pre>{escape(card.source)}</pre></details>"
        f"<code>carom run {escape(card.name)}</code></article>"
    )


def _row(outcome: Outcome) -> str:
    verdict = "held" if outcome.held else "failed"
    cells = "".join(f"<td>{escape(text)}</td>" for text in (outcome.text, outcome.expected, outcome.received))
    return f'<tr><td class="{verdict}">{verdict}</td>{cells}</tr>'


def _times(speed: float) -> str:
    rounded = float(f"{speed:.2g}")
    return "as fast as it is" if rounded == 1.0 else f"{rounded:,.10g} times as fast as it is"
