"""The form of world files: comments stay where they belong, and the file says what it said."""

from __future__ import annotations

import re

import pytest

from carom.worlds import library
from carom.worlds.errors import WorldError
from carom.worlds.layout import formatted

UNTIDY = """# yaml-language-server: $schema=carom.schema.json
# A file, by somebody.

# what is seen
cameras: {main: {position: [3, 2, 4],   target: [0, 0.50, 0]}}   # from the left
name: 'Untidy'
carom: 1


# how it steps
step:
    dt: 1/240
    substeps: 2
gravity:
    - 0
    - "${-g}"
    - 0
variables: {g: 9.810 m/s2, words: "a: b"}
entities:
      # the ground
    - {name: "ground", collider: {plane: {}}}  # of stone
    - name: ball  # it falls
      collider: {sphere: {
          radius: 1e-1,  # m
          # and this is below
          }, layer: default}
      body: {}

      # after the last

description: |  # as written
    One line,
      and another.
expect:
- penetration: < 1 mm
- {when: {impact: [ball, ground]}, time: {is: 0, within: 1 s},
   speed: {is: 0 m/s, within: 10 m/s}, point: {is: [0, 0, 0], within: 1}}
"""

TIDY = """# yaml-language-server: $schema=carom.schema.json
# A file, by somebody.

carom: 1
name: Untidy

description: |  # as written
  One line,
    and another.
gravity: [0, "${-g}", 0]

# how it steps
step: {dt: 1/240, substeps: 2}
variables: {g: 9.810 m/s2, words: "a: b"}
entities:
  # the ground
  - {name: ground, collider: {plane: {}}}  # of stone
  - name: ball  # it falls
    collider:
      sphere:
        radius: 1e-1  # m
        # and this is below
      layer: default
    body: {}

    # after the last
# what is seen
cameras: {main: {position: [3, 2, 4], target: [0, 0.50, 0]}}  # from the left
expect:
  - penetration: < 1 mm
  - {when: {impact: [ball, ground]}, time: {is: 0, within: 1 s}, speed: {is: 0 m/s, within: 10 m/s},
     point: {is: [0, 0, 0], within: 1}}
"""


NO_NODE = "while parsing a flow node did not find expected node content"


def test_an_untidy_file_is_put_into_form() -> None:
    """Sections in order, leaves in braces, long lines broken between words; comments go with what they are about."""
    assert formatted(UNTIDY, "w.yaml") == TIDY
    assert formatted(TIDY, "w.yaml") == TIDY


@pytest.mark.parametrize("name", library.names())
def test_the_library_is_in_form(name: str) -> None:
    """Also where its sections stood the other way round: no word, number or comment of a world gets lost."""
    text = library.read_text(library.find(name), name)
    sections = re.findall(r"(?m)(?:^#.*\n)*^\w.*\n(?:^[ -].*\n|^\n)*", text)
    assert "".join(sections) == text
    assert formatted(text, name) == text
    turned = formatted("".join(reversed(sections)), name)
    assert turned.replace("\n\n", "\n") == text.replace("\n\n", "\n")  # a blank line stays with what was above it


@pytest.mark.parametrize(
    ("text", "written"),
    [
        ("carom: 1\r\nname: a\r\n", "carom: 1\nname: a\n"),
        ("{carom: 1, name: 'it''s', seed: 5}", "carom: 1\nname: \"it's\"\nseed: 5\n"),
        ("carom: 1\nstep: {dt: 1\n\n}\n", "carom: 1\nstep: {dt: 1}\n"),
        ("carom: 1\nname: '1'\n", 'carom: 1\nname: "1"\n'),
        ("---\ncarom: 1 # one\nname: ä # two\n...\n", "carom: 1  # one\nname: ä  # two\n"),
        ("carom: 1\nseed: &a 5\ndrawn: *a\nname: b\n", "carom: 1\nseed: &a 5\ndrawn: *a\nname: b\n"),
        ("carom: 1\nstep: &s\n    dt: 1\n    # why\n", "carom: 1\nstep: &s\n  dt: 1\n  # why\n"),
        ("carom: 1\nname: >-\n    a\n    b\n\n    c\n", "carom: 1\nname: >-\n  a\n  b\n\n  c\n"),
        ("name: |\n  a\n# why\ncarom: 1\n", "# why\ncarom: 1\nname: |\n  a\n"),
        ('carom: 1\nname: "a\n  b"\n', "carom: 1\nname: a b\n"),
        ("carom: 1\nname: a\n\n  b\n", 'carom: 1\nname: "a\\nb"\n'),
        ("carom: 1\nentities: []\nmaterials:\n# last\n", "carom: 1\nmaterials:\nentities: []\n# last\n"),
        ("carom: 1\nexpect:\n- # why\n  energy: conserved\n", "carom: 1\nexpect:\n  # why\n  - energy: conserved\n"),
        ("carom: 1\nname:" + 25 * " words" + "\n", "carom: 1\nname:" + 19 * " words" + "\n " + 6 * " words" + "\n"),
    ],
)  # fmt: skip
def test_forms_of_values(text: str, written: str) -> None:
    """Quotes where they are needed, texts of several lines, anchors, which keep sections where they are, and ends."""
    assert formatted(text, "w.yaml") == written
    assert formatted(written, "w.yaml") == written


def test_what_cannot_be_read_is_told() -> None:
    """Faults of the text are those of reading it; unknown words are kept, for they may be of a system not here."""
    for text, told in (
        ("carom: 1\nname: [\n", "w.yaml:3:1: is not YAML: " + NO_NODE),
        ("carom: 1\nname: a\nname: b\n", "w.yaml:3:1: name: duplicate key 'name', first at line 2"),
        ("name: a\n", "w.yaml:1:1: carom: is missing; accepted: 'carom: 1' as its first line"),
    ):  # fmt: skip
        with pytest.raises(WorldError) as refused:
            formatted(text, "w.yaml")
        assert str(refused.value) == told
    assert formatted("carom: 1\nkites: 2\nname: a\n", "w.yaml") == "carom: 1\nname: a\nkites: 2\n"


def test_the_header_for_editors_is_written_where_a_schema_lies() -> None:
    """Once, as the first line."""
    written = formatted("# mine\ncarom: 1\n", "w.yaml", schema=True)
    assert written == "# yaml-language-server: $schema=carom.schema.json\n# mine\ncarom: 1\n"
    assert formatted(written, "w.yaml", schema=True) == written
