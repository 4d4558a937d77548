"""Variables and expressions of world files come to the numbers they say, with their units, and can do nothing else."""

# ruff: noqa: E501 - messages stand whole, as a user sees them

from __future__ import annotations

import math
from fractions import Fraction

import jsonschema
import pytest
from hypothesis import given
from hypothesis import strategies as st
from refusals import messages, refusal

from carom.ecs.snapshot import state_hash
from carom.worlds import json_schema, load_text
from carom.worlds.errors import WordError
from carom.worlds.expression import evaluate
from carom.worlds.quantity import Quantity, dimension_of
from carom.worlds.reader import read
from carom.worlds.units import read_quantity

FILE = """carom: 1
name: A table of ${table.length}, ${balls} balls
variables:
  table: {length: 9 ft, width: "${table.length / 2}", size: ["${table.length}", 1 in, "${table.width}"]}
  ball: 57.15 mm
  speed: 2 m/s
  balls: ${2 ** 2}
  look: brown
materials: {ivory: {color: "${look}"}}
prefabs:
  ball: {collider: {sphere: {radius: "${ball / 2}"}}, body: {mass: 170 g}, motion: {angular: [0, 0, "${-speed / (ball / 2)}"]}}
entities:
  - {name: table, collider: {box: {size: "${table.size}"}}, material: ivory}
  - name: cue
    prefab: ball
    transform: {position: ["${table.length / 4}", 1, 0], rotation: {axis: [0, 1, 0], angle: "${180 deg / 4}"}}
  - {name: row, prefab: ball, grid: {count: ["${balls / 2}", 1, 1], spacing: "${ball + 1 mm}", origin: [0, 2, 0]}}
expect:
  - never: cue.position.y < ${-table.length}
  - {at: "${1 min / 60}", cue.position.x: {is: "${table.length / 4}", within: "${ball}"}}
"""
FORM = "numbers with units, variables, + - * / ** ( ), pi, sqrt, abs, min, max, round, sin, cos, tan, exp"
LENGTH = "a number in m, or one with a unit: m, mm, cm, km, um, in, ft, mi"


def test_expressions_stand_wherever_a_value_does() -> None:
    """Numbers, components, whole lists, counts, texts, conditions: all are what the same values written out would be."""
    loaded = load_text(FILE, "w.yaml")
    simulation = loaded.simulation
    assert loaded.name == "A table of 2.7432 m, 4 balls"
    assert simulation["cue"].transform.position.tolist() == [2.7432 / 4, 1.0, 0.0]
    assert simulation["cue"].motion.angular[2] == -2.0 / (0.05715 / 2)
    assert simulation.world.names() == ["table", "cue", "row[0,0,0]", "row[1,0,0]"]
    assert simulation["row[1,0,0]"].transform.position[0] == 0.05715 + 0.001
    assert loaded.expectations[0].text == "never: cue.position.y < -2.7432 m"
    assert loaded.expectations[1].text == "cue.position.x at frame 60"


def test_a_world_with_expressions_is_the_world_with_their_values() -> None:
    """What is computed and what is written out have the same state, to the bit."""
    plain = "carom: 1\nentities: [{name: a, collider: {sphere: {radius: %s}}, body: {}, transform: {position: [%s, 0, 0]}}]\n"
    one = load_text(plain % ('"${9 ft / 2}"', '"${1/240 s * 3 m/s}"'))
    other = load_text(plain % ("1.3716", str(1 / 240 * 3.0)))
    assert state_hash(one.simulation.world) == state_hash(other.simulation.world)


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("1 + 2 * 3 - 4 / 2", 5),
        ("-2 ** 2", -4),
        ("2 ** 3 ** 2 / 2 ** 8", 2),
        ("2 ** -2", 0.25),
        ("(1 + 2) * -(3)", -9),
        ("+-+2", -2),
        ("sqrt(2 ** 4) + abs(-1) + round(2.6)", 8),
        ("min(3, 1, 2) + max(1, 3)", 4),
        ("cos(60 deg) - sin(30 deg)", 0),
        ("tan(45 deg)", 1),
        ("2 * pi", 2 * math.pi),
        ("3 m / 2 m", 1.5),
        ("1/2 m / 1 m", 0.5),
        ("sqrt(16 m2) / 1 m", 4),
        ("2 m * 30 deg / 1 m", math.pi / 3),
    ],
)
def test_arithmetic(text: str, value: float) -> None:
    """Signs bind looser than powers, these from the right; units cancel, and radius times angle is a length."""
    found = evaluate(text, lambda name: pytest.fail(name))
    assert isinstance(found, (int, float))
    assert dimension_of(found) == (0, 0, 0, 0, 0)
    assert found == pytest.approx(value, rel=1e-15, abs=2e-16)


@given(st.recursive(
    st.integers(1, 99).map(str),
    lambda inner: st.tuples(inner, st.sampled_from("+-*"), inner).map(lambda parts: f"({' '.join(parts)})"),
    max_leaves=9,
))  # fmt: skip
def test_arithmetic_agrees_with_exact_fractions(text: str) -> None:
    """What is made of whole numbers is that of Python, exactly where a float holds it."""
    exact = eval(text, {"__builtins__": {}})
    found = evaluate(text, lambda name: None)
    assert found == (exact if abs(exact) < 2**53 else pytest.approx(float(Fraction(exact)), rel=1e-14))


def test_units_follow_the_arithmetic() -> None:
    """A product has the product of the units, as text too; ratios of lengths are angles."""
    force = evaluate("2 kg * 9.81 m/s2", lambda name: None)
    assert str(force) == "19.62 kg m/s2"
    assert read_quantity(force, "N") == 19.62
    spin = evaluate("3 m/s / 0.5 m", lambda name: None)
    assert isinstance(spin, Quantity)
    assert (read_quantity(spin, "rad/s"), read_quantity(spin, "1/s")) == (6.0, 6.0)
    with pytest.raises(WordError, match="must be a frequency"):
        read_quantity(evaluate("60 rpm", lambda name: None), "Hz")


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (
            "variables: {table: {length: 9 ft}}\nseed: ${tabel.length}",
            "w.yaml:3:1: seed: unknown variable; received 'tabel'; accepted: table; did you mean 'table'?",
        ),
        (
            "variables: {table: {length: 9 ft}}\nseed: ${table.lenght}",
            "w.yaml:3:1: seed: unknown variable; received 'lenght'; accepted: length; did you mean 'length'?",
        ),
        ("variables: {a: {b: 1}}\nseed: ${a}", "w.yaml:3:1: seed: a is several variables; received 'a'; accepted: a.b"),
        ("variables: {a: [1, 2]}\nseed: ${a.z}", "w.yaml:3:1: seed: a has no z; received 'a.z'; accepted: x, y"),
        ("variables: {a: 1}\nseed: ${a.x}", "w.yaml:3:1: seed: a has no x; received 'a.x'; accepted: its name alone"),
        (
            "variables: {a: '${b}', b: '${c + 1}', c: '${a}'}",
            "w.yaml:2:39: variables.c: is made of itself: a -> b -> c -> a; received 'a'",
        ),
        (
            "variables: {kg: 1 kg}\nentities: [{collider: {sphere: {radius: '${kg / 2}'}}}]",
            (
                "w.yaml:3:33: entities.0.collider.sphere.radius: must be a length; received 0.5 kg, which is a mass; "
                f"accepted: {LENGTH}"
            ),
        ),
        ("seed: ${1 m + 2}", "w.yaml:2:1: seed: adds a length and a number; received '1 m + 2'; state the unit of each"),
        ("seed: ${min(1 m, 2 s)}", "w.yaml:2:1: seed: compares a length and a time; received 'min(1 m, 2 s)'; state the unit of each"),
        ("seed: ${1 / (2 - 2)}", "w.yaml:2:1: seed: divides by zero; received '1 / (2 - 2)'"),
        ("seed: ${2 ** 0.5}", "w.yaml:2:1: seed: raises to what is no whole number from -16 to 16; received '2 ** 0.5'"),
        ("seed: ${2 ** 99}", "w.yaml:2:1: seed: raises to what is no whole number from -16 to 16; received '2 ** 99'"),
        ("seed: ${1e200 * 1e200}", "w.yaml:2:1: seed: makes a number beyond all bounds; received '1e200 * 1e200'"),
        ("seed: ${(2 m) ** 10}", "w.yaml:2:1: seed: makes a unit to a power above 9; received '(2 m) ** 10'"),
        ("seed: ${sqrt(2 m)}", "w.yaml:2:1: seed: takes the root of what is no square; received 'sqrt(2 m)'"),
        (
            "seed: ${sin(2 m)}",
            ("w.yaml:2:1: seed: takes the sine, cosine or tangent of what is no angle; received 'sin(2 m)'; "
            "accepted: such as 30 deg"),
        ),
        (
            "seed: ${round(2 m)}",
            ("w.yaml:2:1: seed: rounds what is no plain number; received 'round(2 m)'; "
            "accepted: such as round(length / 1 m)"),
        ),
        (
            "seed: ${sinus(1)}",
            ("w.yaml:2:1: seed: unknown function 'sinus'; received 'sinus(1)'; "
            "accepted: sqrt, abs, min, max, round, sin, cos, tan, exp; did you mean 'sin'?"),
        ),
        ("seed: ${abs(1, 2)}", "w.yaml:2:1: seed: abs takes one value; received 'abs(1, 2)'; accepted: abs(value)"),
        (
            "seed: ${__import__('os')}",
            f"w.yaml:2:1: seed: is no expression at \"'os')\"; received \"__import__('os')\"; accepted: {FORM}",
        ),
        ("seed: ${1 +}", f"w.yaml:2:1: seed: lacks a value; received '1 +'; accepted: {FORM}"),
        ("seed: ${(1}", f"w.yaml:2:1: seed: lacks a closing bracket; received '(1'; accepted: {FORM}"),
        ("seed: ${1 2}", f"w.yaml:2:1: seed: is no expression at '2'; received '1 2'; accepted: {FORM}"),
        (
            "variables: {look: brown}\nseed: ${look + 1}",
            f"w.yaml:3:1: seed: computes with what is no number; received 'look + 1'; accepted: {FORM}",
        ),
        (
            f"seed: ${{{'1 + ' * 60}1}}",
            "w.yaml:2:1: seed: is longer than an expression may be, 200 characters; received '1 + 1 + 1 + 1 + 1 + 1 + 1 + 1 + 1 + 1 + ...'",
        ),
        ("name: a ${b", "w.yaml:2:1: name: has an expression that does not end; received 'a ${b'; accepted: ${...}"),
        ("variables: {a: [1]}\nname: b ${a}", "w.yaml:3:1: name: puts a list into a text; received [1]"),
        (
            "variables: {a-b: 1}",
            "w.yaml:2:13: variables.a-b: is not the name of a variable; accepted: a letter or _, then letters, digits or _",
        ),
        ("variables: {a: 5 fet}", "w.yaml:2:13: variables.a: unknown unit 'fet'; received '5 fet'; did you mean 'ft'?"),
        (
            "variables: {a: null}",
            "w.yaml:2:13: variables.a: has no value; accepted: a number, one with a unit, a text, a list, true or false",
        ),
        (
            "variables: {a: [[1]]}",
            ("w.yaml:2:13: variables.a: is no list for a variable; received a list of 1; "
            "accepted: at most 64 numbers, texts or expressions"),
        ),
        ("variables: 3", "w.yaml:2:1: variables: must be a mapping; received 3; accepted: keys with values"),
        (
            "entities: [{collider: {sphere: {radius: ${r}}}}]",
            ("w.yaml:2:42: is not YAML: while parsing a flow mapping did not find expected ',' or '}'; "
            'inside {...} and [...] an expression stands in quotes: "${...}"'),
        ),
    ],
)  # fmt: skip
def test_whatever_is_wrong_is_told_once_where_it_stands(text: str, message: str) -> None:
    """A wrong expression is one line, and hides nothing but what it would have said."""
    assert refusal(text) == message


def test_a_wrong_expression_hides_no_other_fault() -> None:
    """Faults beside it and in other entities are told in the same run; of a wrong variable only the variable."""
    text = """variables: {r: 1 fet}
entities:
  - {name: a, collider: {sphere: {radius: "${r}"}}, body: {mass: -1}}
  - {name: b, material: ivory}
"""
    assert messages(text) == [
        "w.yaml:2:13: variables.r: unknown unit 'fet'; received '1 fet'; did you mean 'ft'?",
        "w.yaml:4:60: entities.0.body.mass: must be above 0 kg; received -1",
        "w.yaml:5:15: entities.1.material: unknown material; received 'ivory'; accepted: none is defined",
    ]


def test_variables_of_variables_fill_neither_stack_nor_memory() -> None:
    """Chains of variables and texts that double end in a sentence."""
    chain = ", ".join(f"a{n}: '${{a{n + 1}}}'" for n in range(200))
    assert "is made of more than 64 variables, one of another" in refusal(f"variables: {{{chain}, a200: 1}}")
    double = ", ".join(f"a{n}: '${{a{n + 1}}}${{a{n + 1}}}'" for n in range(40))
    assert "becomes longer than 1000 characters" in refusal(f"variables: {{{double}, a40: brown}}")


@given(st.text(alphabet="0123456789.+-*/()ab, emsinqrt%^", max_size=40))
def test_no_text_is_more_than_a_fault(text: str) -> None:
    """Whatever stands in an expression is a value or a WordError."""
    try:
        found = evaluate(text, lambda name: 2.0)
    except WordError:
        return
    assert isinstance(found, (int, float)) and math.isfinite(found)


def test_editors_take_expressions() -> None:
    """The JSON Schema lets expressions stand for numbers, lists, counts, words and flags."""
    validator = jsonschema.Draft202012Validator(json_schema())
    validator.validate(read(FILE, "w.yaml").data)
    validator.validate({"carom": 1, "up": "${a}", "step": {"sleeping": "${b}"}, "gravity": "${c}"})
