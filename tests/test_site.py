"""The site's own code: what is public, what is generated, and how tables of figures are renewed."""

from __future__ import annotations

import re
import sys
from pathlib import Path
from typing import Any

import pytest

from carom.ecs import World
from carom.ecs.structure import Structure
from carom.systems.settings import Settings
from carom.tools.cli import COMMANDS

SITE = Path(__file__).resolve().parents[1] / ".ci" / "site"


@pytest.fixture(autouse=True)
def beside_each_other(monkeypatch: pytest.MonkeyPatch) -> None:
    """Let the modules of the site import each other, as mkdocs does."""
    monkeypatch.syspath_prepend(str(SITE))
    for name in ("api", "reference", "figures"):
        monkeypatch.delitem(sys.modules, name, raising=False)


def test_what_pages_import_is_public() -> None:
    """And so are packages that state what they export, each with the parts it names."""
    import api

    found = api.modules()
    assert {"carom.ecs", "carom.worlds", "carom.systems.simulation", "carom.tools.recorder"} <= set(found)
    assert found == sorted(set(found))
    assert "carom.systems.forces.gravity_well" in api.parts("carom.systems.forces")
    assert not set(found) & set(api.parts("carom.ecs.spatial"))


def test_the_reference_tells_every_command_setting_and_word() -> None:
    """From the parser, the settings and the schema themselves."""
    import reference

    page = reference.commands()
    assert all(f"\n## carom {name}\n" in page for name in COMMANDS)
    assert f"| `step.substeps` | `{Settings().substeps}` | parts of a step" in reference.defaults()
    words = reference.words()
    assert "| `restitution` | number or [CombinedRestitution](#CombinedRestitution) | `0` |" in words
    assert "## Sphere {#Sphere}" in words


def figure(name: str, unit: str, value: float, by: str = "cpu") -> dict[str, Any]:
    """Return a figure as `carom bench --json` prints it."""
    return {"name": name, "unit": unit, "wall": 2.0 * value, "cpu": value, "by": by}


def test_a_table_of_figures_is_renewed_in_its_place() -> None:
    """With a column for each engine; how many times longer one took is left out, and all else stays."""
    import figures

    told = [
        figure("pyramid_40, carom", "ms a step", 1.0),
        figure("pyramid_40, rapier3d", "ms a step", 1.23456),
        figure("pyramid_40, carom by rapier3d", "x", 0.8),
        figure("second start", "s", 1.0, by="wall"),
    ]
    page = "before\n<!-- bench contacts -->\nold\n<!-- end -->\nafter <!-- bench joints -->\nkept\n<!-- end -->\n"
    assert figures.renewed(page, {"bench": "contacts", "machine": "A machine", "figures": told}) == (
        "before\n<!-- bench contacts -->\n\nA machine\n\n"
        "|  | carom | rapier3d |\n| --- | --- | --- |\n"
        "| pyramid 40, ms a step | 1 | 1.23 |\n| second start, s | 2 |  |\n"
        "\n<!-- end -->\nafter <!-- bench joints -->\nkept\n<!-- end -->\n"
    )


def test_the_page_of_the_world_has_what_it_inherits() -> None:
    """All but what only snapshots and names themselves call."""
    (listed,) = re.findall(r"inherited_members: \[(.*)\]", (SITE.parents[1] / "mkdocs.yml").read_text(encoding="utf-8"))
    own = {name for name in vars(Structure) if not name.startswith("_") and name not in vars(World)}
    assert set(listed.split(", ")) == own - {"begin_restore", "names_now"}
