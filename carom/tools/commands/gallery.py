"""Gallery: render worlds of the library to one page, with films, laws, and what they expect."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from carom.tools.commands.options import ending, print_json

DEFAULT = Path("gallery.html")


def declare(parser: argparse.ArgumentParser) -> None:
    """Declare which worlds, and where the page goes."""
    parser.add_argument(
        "--out", "-o", type=ending(".html"), default=DEFAULT, metavar="FILE", help=f"the page; {DEFAULT} by default"
    )
    parser.add_argument("--only", nargs="+", metavar="NAME", help="groups and worlds of the library; all by default")


def execute(arguments: argparse.Namespace) -> int:
    """Run each world and write the page; 1 when an expectation of any failed."""
    from carom.tools.gallery import card, page
    from carom.tools.outputs import prepare_outputs

    worlds = _chosen(arguments.only)
    prepare_outputs([arguments.out])
    cards = []
    for number, (group, name) in enumerate(worlds, 1):
        print(f"{number} of {len(worlds)}: {name}", file=sys.stderr)
        cards.append(card(group, name))
    arguments.out.write_text(page(cards), encoding="utf-8")
    failed = [one.name for one in cards if not one.held]
    if arguments.json:
        print_json({"page": str(arguments.out), "worlds": [one.name for one in cards], "failed": failed})
    else:
        told = f"; not held: {', '.join(failed)}" if failed else ", all they expect held"
        print(f"{arguments.out}: {len(cards)} worlds{told}")
    return 1 if failed else 0


def _chosen(only: list[str] | None) -> list[tuple[str, str]]:
    """Return group and name of the worlds that the names mean, group by group; raise CaromError for unknown names."""
    from carom.ecs.errors import CaromError, did_you_mean
    from carom.worlds import library

    groups = library.groups()
    accepted = [*groups, *library.names()]
    unknown = [name for name in only or () if name not in accepted]
    if unknown:
        hints = "; ".join(dict.fromkeys(hint for name in unknown if (hint := did_you_mean(name, accepted))))
        parts = f"received {', '.join(unknown)}", f"accepted: the groups {', '.join(groups)}, and worlds", hints
        raise CaromError(f"--only: no group or world of the library; {'; '.join(filter(None, parts))}")
    pairs = [(group, name) for group, names in groups.items() for name in names]
    return [pair for pair in pairs if not only or set(pair) & set(only)]
