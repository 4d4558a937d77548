"""docs/words.md shows one world twice, in Python and as a file: both columns are the same to the bit."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

from carom.ecs import first_difference
from carom.systems.events import Events
from carom.systems.forces import Forces
from carom.systems.simulation import Simulation
from carom.worlds import load_text
from carom.worlds.emit import emit
from carom.worlds.reader import read

PAGE = Path(__file__).resolve().parents[1] / "docs" / "words.md"
ROW = re.compile(r"<tr><td>.*?```python\n(.*?)```.*?```yaml\n(.*?)```.*?</td></tr>", re.DOTALL)


def test_both_columns_are_one_world() -> None:
    """Row by row of the table: the Python is run, the parts of the file are put together."""
    rows = ROW.findall(PAGE.read_text(encoding="utf-8").partition("</table>")[0])
    assert len(rows) == 13
    names: dict[str, Any] = {}
    sections: dict[str, Any] = {}
    for python, words in rows:
        exec(compile(python, str(PAGE), "exec"), names)
        for key, value in read(words, PAGE.name).data.items():
            sections[key] = [*sections.get(key, []), *value] if isinstance(value, list) and key != "gravity" else value
    built: Simulation = names["simulation"]
    found = load_text(emit(sections), PAGE.name).simulation
    assert first_difference(found.world, built.world) is None
    assert found.settings == built.settings
    assert found.world[Forces].entries == built.world[Forces].entries
    assert found.world[Events].entries == built.world[Events].entries
