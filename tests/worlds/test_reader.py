"""Text becomes data with positions, by the rules of YAML 1.2, and nothing in a file can harm the reader."""

# ruff: noqa: E501 - messages stand whole, as a user sees them

from __future__ import annotations

import json

import pytest
from hypothesis import given
from hypothesis import strategies as st

from carom.worlds.errors import WorldError
from carom.worlds.reader import read


def test_words_that_yaml_1_1_would_turn_into_something_else_stay_text() -> None:
    """On, NO, 12:30 and dates are text."""
    data = read("a: on\nb: NO\nc: 12:30\nd: 1_000\ne: 0x10\nf: 2026-01-01\n", "w.yaml").data
    assert data == {"a": "on", "b": "NO", "c": "12:30", "d": "1_000", "e": "0x10", "f": "2026-01-01"}


def test_numbers_booleans_and_null() -> None:
    """Numbers, booleans and null are what YAML 1.2 says; quoted ones are text."""
    data = read("[1, -2, 1e3, .5, 012, true, False, null, ~, '1', \"true\"]", "w.yaml").data
    assert data == [1, -2, 1000.0, 0.5, 12.0, True, False, None, None, "1", "true"]


def test_every_path_has_a_position() -> None:
    """Keys and items are where they stand, from 1."""
    positions = read("a:\n  - b: 1\n    c: {d: 2}\n", "w.yaml").positions
    assert positions == {(): (1, 1), ("a",): (1, 1), ("a", 0): (2, 5), ("a", 0, "b"): (2, 5), ("a", 0, "c"): (3, 5)} | {
        ("a", 0, "c", "d"): (3, 9)
    }


def test_aliases_repeat_what_was_anchored() -> None:
    """An alias stands for a copy, positioned at what it repeats."""
    source = read("a: &ball {radius: 1}\nb: [*ball, *ball]\n", "w.yaml")
    assert source.data == {"a": {"radius": 1}, "b": [{"radius": 1}, {"radius": 1}]}
    assert source.positions["b", 1, "radius"] == (1, 11)


words = st.text(st.characters(max_codepoint=0xD7FF))  # beyond, JSON escapes in pairs that YAML does not join
keys = st.text(st.characters(max_codepoint=0xD7FF), max_size=160)  # YAML ends a key on one line after 1,024 signs
numbers = st.integers(-(10**12), 10**12) | st.floats(allow_nan=False, allow_infinity=False)
json_values = st.recursive(
    st.none() | st.booleans() | numbers | words,
    lambda inner: st.lists(inner, max_size=4) | st.dictionaries(keys, inner, max_size=4),
    max_leaves=20,
)


@given(json_values)
def test_json_is_a_subset(value: object) -> None:
    """What JSON writes is read as it was."""
    assert read(json.dumps(value), "w.json").data == value


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (
            "a: [1",
            "w.yaml:2:1: is not YAML: while parsing a flow sequence did not find expected ',' or ']'; it begins at line 1",
        ),
        (
            "a: [\n b\n",
            "w.yaml:3:1: is not YAML: while parsing a flow sequence did not find expected ',' or ']'; it begins at line 1",
        ),
        (
            "a: 1\nb [1]\nc: 3",
            "w.yaml:3:1: is not YAML: while scanning a simple key could not find expected ':'; it begins at line 2",
        ),
        (
            "a:\n\t- 1",
            "w.yaml:2:1: is not YAML: while scanning for the next token found character that cannot start any token; a line begins with blanks, never with a tab",
        ),
        (
            "a: {color: #ff8000, b: 1}",
            "w.yaml:2:1: is not YAML: while parsing a flow node did not find expected node content; what follows # is a comment; a colour stands in quotes: '#ff8000'",
        ),
        (
            "a: b: c",
            "w.yaml:1:5: is not YAML: mapping values are not allowed in this context; a text with ': ' stands in quotes, entries beside each other stand in {...}",
        ),
        ("\x00", "w.yaml:1:1: is not YAML: unacceptable character #x0000: control characters are not allowed"),
        ("a: 1\n---\nb: 2", "w.yaml:2:1: holds more than one document"),
        ("? [a]\n: b", "w.yaml:1:3: has a key that is not a word"),
        ("a: *b", "w.yaml:1:4: alias *b stands for nothing before it"),
        ("&a [*a]", "w.yaml:1:5: alias *a stands for nothing before it"),
        ("[" * 900, "w.yaml:1:66: is nested deeper than 64 levels"),
        ("- " * 100_000, "w.yaml:1:131: is nested deeper than 64 levels"),
    ],
)
def test_what_is_not_yaml_is_refused_in_one_line(text: str, message: str) -> None:
    """Broken, deep and self-containing files end in a sentence, not in a traceback or a crash."""
    with pytest.raises(WorldError) as caught:
        read(text, "w.yaml")
    assert str(caught.value) == message


def test_brackets_without_end_are_refused_in_one_line() -> None:
    """Where libyaml gives up before it hands over the first of them, its place is told, in the same sentence."""
    with pytest.raises(WorldError) as caught:
        read("[" * 100_000, "w.yaml")
    assert str(caught.value) in [f"w.yaml:1:{column}: is nested deeper than 64 levels" for column in (66, 1001)]


def test_a_few_lines_of_aliases_cannot_fill_the_memory() -> None:
    """Aliases of aliases are cut off."""
    lines = ["a: &a0 [1, 1, 1, 1, 1, 1, 1, 1, 1, 1]"]
    lines += [f"a{n}: &a{n} [{', '.join([f'*a{n - 1}'] * 10)}]" for n in range(1, 9)]
    with pytest.raises(WorldError, match="repeats more than 200000 values by aliases"):
        read("\n".join(lines), "w.yaml")


def test_duplicate_keys_and_tags_are_noted_and_the_rest_is_read() -> None:
    """Such faults do not hide others."""
    source = read("a: 1\nb: !!python/object:x y\na: 2\n", "w.yaml")
    assert source.data == {"a": 1, "b": None}
    assert [str(fault) for fault in source.faults] == [
        "w.yaml:2:4: b: tag 'tag:yaml.org,2002:python/object:x' is not accepted; accepted: plain values without tags",
        "w.yaml:3:1: a: duplicate key 'a', first at line 1",
    ]
