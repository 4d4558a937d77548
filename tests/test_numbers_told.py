"""Numbers that pages state by hand are those that hold."""

from __future__ import annotations

import re

from pages import ROOT

from carom.ecs import Material
from carom.systems.constants import FARTHEST, MOST_BORN, MOST_TRIANGLES
from carom.systems.settings import MOST_SUBSTEPS, Settings
from carom.worlds import amounts, expression, include, parsing, reader, run, unfold, values, variables

NUMBER = r"\d{1,3}(?:,\d{3})*(?:e\d+)?"
LIMITS = {
    "a file, and all that it includes": [reader.MOST_CHARACTERS],
    "nesting of lists and mappings": [reader.DEEPEST],
    "values that stand for others (`*alias`), unfolded": [reader.MOST_REPEATED],
    "an expression": [expression.LONGEST, parsing.DEEPEST, *2 * [expression.LARGEST_EXPONENT]],
    "a variable made of others": [variables.MOST_STEPS, variables.LONGEST_LIST, variables.LONGEST_TEXT],
    "included files": [include.MOST_FILES, include.DEEPEST],
    "entities, with all copies and links": [amounts.MOST_ENTITIES],
    "entities of groups": [unfold.MOST_MEMBERS, unfold.DEEPEST],
    "name of a file beside the world": [values.LONGEST_FILE_NAME],
    "triangles of a mesh or a height field": [MOST_TRIANGLES],
    "particles that an emitter brings forth in a step": [MOST_BORN],
    "reach of a collider, but a plane": [FARTHEST],
    "substeps of a step; steps of a run": [MOST_SUBSTEPS, run.MOST_FRAMES],
}


def test_the_limits_of_worlds_are_those_that_hold() -> None:
    """Row by row of the table of docs/authoring.md."""
    (section,) = re.findall(r"^## Limits\n(.*?)^## ", (ROOT / "docs/authoring.md").read_text("utf-8"), re.M | re.S)
    rows = re.findall(r"^\| (\w.*?) \| (.*) \|$", section, re.MULTILINE)
    told = {what: [float(n.replace(",", "")) for n in re.findall(NUMBER, most)] for what, most in rows}
    assert told == LIMITS


def test_the_defaults_of_the_readme_are_those_that_hold() -> None:
    """One line, in full in docs/frame.md, where it is generated."""
    settings = Settings()
    friction, restitution, density = (
        f"{name} {float(Material.columns[name].default):g}" for name in ("friction", "restitution", "density")
    )
    assert (
        f"| defaults | dt 1/{1 / settings.dt:g}, {settings.substeps} substeps, {settings.integrator}, "
        f"sleeping {'on' if settings.sleeping else 'off'}, {friction}, {restitution}, {density}: "
    ) in (ROOT / "README.md").read_text("utf-8")
