"""Renew the tables of docs/numbers.md: ``carom bench contacts --json | python .ci/site/figures.py``.

The figures of a bench stand between two marks that name it, a line for each thing measured, a column for each engine.
"""

from __future__ import annotations

import json
import re
import sys
from pathlib import Path
from typing import Any

PAGE = Path(__file__).resolve().parents[2] / "docs" / "numbers.md"


def renewed(text: str, told: dict[str, Any]) -> str:
    """Return the page with the table of one bench as it is told."""
    name = told["bench"]
    mark = re.compile(rf"(<!-- bench {name} -->\n).*?(<!-- end -->)", re.DOTALL)
    assert mark.search(text), f"no table of the bench {name} in docs/numbers.md"
    table = f"\n{told['machine']}\n\n{rows(told['figures'])}\n"
    return mark.sub(lambda found: found[1] + table + found[2], text)


def rows(figures: list[dict[str, Any]]) -> str:
    """Return the table: what names an engine at its end is a column, comparisons of engines are left out."""
    measured: dict[tuple[str, str], dict[str, str]] = {}
    for one in figures:
        what, engine = parted(one["name"])
        if " by " not in engine:
            value = one["wall"] if one["by"] == "wall" else one["cpu"]
            measured.setdefault((what, one["unit"]), {})[engine] = f"{value:.3g}"
    engines = list(dict.fromkeys(engine for row in measured.values() for engine in row))
    head = ["", *engines]
    lines = [head, ["---"] * len(head)]
    lines += [[f"{what}, {unit}", *(row.get(each, "") for each in engines)] for (what, unit), row in measured.items()]
    return "".join(f"| {' | '.join(line)} |\n" for line in lines)


def parted(name: str) -> tuple[str, str]:
    """Return what was measured and by which engine: 'pyramid_40, carom, drift' is its drift, by carom."""
    parts = name.split(", ")
    engine = next((part for part in parts if re.match(r"(carom|rapier3d|pybullet|mujoco|esper)\b", part)), "carom")
    return " ".join(part for part in parts if part != engine).replace("_", " "), engine


if __name__ == "__main__":
    told, _ = json.JSONDecoder().raw_decode(sys.stdin.read())  # PyBullet prints a line of its own behind it
    PAGE.write_text(renewed(PAGE.read_text(encoding="utf-8"), told), encoding="utf-8")
