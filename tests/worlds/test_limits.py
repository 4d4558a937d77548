"""What is too much is told with its limit before it is made; no file can fill the memory, or take for ever."""

# ruff: noqa: E501 - messages stand whole, as a user sees them

from __future__ import annotations

from pathlib import Path

import pytest
from refusals import refusal

from carom.ecs.errors import DeclarationError, NonFiniteError, did_you_mean
from carom.worlds import WorldError, library, load_text, load_world
from carom.worlds.library import MOST_BYTES
from carom.worlds.lint import lint
from carom.worlds.names import fitting

LONG = "x" * 300
FILE_NAME = "is not the name of a file; received '"
NAME_FORM = "accepted: at most 255 printable characters"
MANY = "{name: %s, collider: {point: {}}, grid: {count: [100, 100, 50], spacing: 1}}"


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (
            f"entities: [{', '.join(MANY % name for name in ('a', 'b', 'c'))}]\n",
            (
                "w.yaml:2:199: entities.2.grid: brings the world to 1500000 entities, more than the 1000000 it may have; "
                "take fewer"
            ),
        ),
        (
            "entities: [{name: rope, chain: {end: [1, 0, 0], count: 1000001}}]\n",
            (
                "w.yaml:2:25: entities.0.chain: brings the world to 1000001 entities, more than the 1000000 it may have; "
                "take fewer"
            ),
        ),
        (
            "run: {duration: 1e300}\n",
            (
                "w.yaml:2:1: run: 1e+300 s take more steps of 0.0166667 s than a run may have, 1,000,000,000; "
                "state a shorter time, or a longer step.dt"
            ),
        ),
        (
            "run: {frames: 1000000001}\n",
            "w.yaml:2:7: run.frames: must be a whole number; received 1000000001; accepted: 1 to 1000000000",
        ),
        (
            "expect: [{at: 1e300, x.y: {is: 1, within: 1}}]\n",
            "w.yaml:2:11: expect.0.at: is more than 1,000,000,000 steps of 0.0166667 s away; received 1e+300 s",
        ),
        (
            "step: {substeps: 1000000000}\n",
            "w.yaml:2:8: step.substeps: must be a whole number; received 1000000000; accepted: 1 to 1000",
        ),
        (
            f"include: [{LONG}.yaml]\n",
            f"w.yaml:2:11: include.0: {FILE_NAME}{'x' * 56}...; {NAME_FORM}",
        ),
        (
            'include: ["a\\0.yaml"]\n',
            f"w.yaml:2:11: include.0: {FILE_NAME}a\\x00.yaml'; {NAME_FORM}",
        ),
        (
            f"entities: [{{collider: {{mesh: {{file: {LONG}.obj}}}}}}]\n",
            f"w.yaml:2:31: entities.0.collider.mesh.file: {FILE_NAME}{'x' * 56}...; {NAME_FORM}",
        ),
        (
            "entities: [{name: a, emitter: {burst: 2000000}}]\n",
            ("w.yaml:2:32: entities.0.emitter.burst: must be finite and at least 0 and at most 1e+06, received 2e+06"),
        ),
        (
            'layers: {"\\e[31m": 1}\n',
            (
                "w.yaml:2:10: layers.\\x1b[31m: is not a name; received '\\x1b[31m'; accepted: a letter or _, then letters, "
                "digits, _ or -, at most 48 in all"
            ),
        ),
        (
            'entities: [{name: ["x"], entities: []}]\n',
            "w.yaml:2:13: entities.0.name: is not a name; received ['x']; accepted: a letter or _, then letters, digits, _ or -, at most 48 in all",
        ),
        (
            "entities: [{name: c, chain: {end: [1e300, 1, 1], count: 5, sag: 1}}]\n",
            "w.yaml:2:30: entities.0.chain.end: a chain is at most 1e+100 m long, and hangs as low; received 1e+300 m",
        ),
    ],
)
def test_what_is_too_much_is_told_with_its_limit(text: str, message: str) -> None:
    """Each with its place, what was received and what may be."""
    assert refusal(text) == message


def test_a_file_is_measured_before_it_is_read(tmp_path: Path) -> None:
    """What is larger than the memory may be is not read at all."""
    large = tmp_path / "large.yaml"
    with large.open("wb") as file:
        file.truncate(MOST_BYTES + 1)
    with pytest.raises(WorldError) as caught:
        load_world(large)
    assert str(caught.value) == f"{large}: is larger than a world file may be, 128,000,000 bytes"


def test_patterns_of_many_stars_take_no_longer_than_the_names() -> None:
    """No way of sharing out a name among the stars is tried twice."""
    assert fitting("*a" * 25 + "b", ["a" * 60]) == []
    assert fitting("*a*", ["cab", "b", "a"]) == ["cab", "a"]
    assert fitting("*b*c", ["abcbc", "bca", "bxc[3]"]) == ["abcbc", "bxc[3]"]


def test_what_no_word_is_near_is_told_soon() -> None:
    """Names are compared as far as that is quick, and not with what is no word."""
    names = [f"post[{number}]" for number in range(2000)]
    assert did_you_mean("post[999", names) == "did you mean 'post[999]'?"
    assert did_you_mean("post[1999", names[1500:]) == "did you mean 'post[1999]'?"
    assert did_you_mean("beyond", [*names, "beyond"]) == ""
    assert did_you_mean("a" * 101, ["a" * 100]) == ""


def test_sections_of_nothing_are_linted() -> None:
    """What a file leaves empty has no names that could be unused."""
    assert lint(load_text("carom: 1\nprefabs:\n")) == []


@pytest.mark.parametrize("words", ["rate: 1e9", "burst: 1, every: 1e-9"])
def test_a_step_is_refused_that_would_fill_the_memory_with_particles(words: str) -> None:
    """An emitter is told before it brings forth more than a step may have."""
    simulation = load_text(f"carom: 1\nentities: [{{name: hose, emitter: {{{words}}}}}]\n").simulation
    with pytest.raises(DeclarationError) as caught:
        simulation.step()
    assert str(caught.value) == (
        "emitter of 'hose' brings forth 1.67e+07 particles in a step, more than 1,000,000; lower its rate or burst, "
        "or step.dt"
    )


def test_speeds_without_a_square_end_in_a_sentence() -> None:
    """A spring of 3e299 N/m makes speeds that leave whatever is foreseen at once: the step ends all the same."""
    text = library.find("spring_mass").read_text()
    loaded = load_text(text.replace("29.608813203268074", "3e299"), "w.yaml")
    with pytest.raises(NonFiniteError, match=r"of entity '.*' is .*, found at the end of the step"):
        loaded.simulation.step(3)


def test_layers_with_a_fault_are_no_further_fault_of_who_is_on_them() -> None:
    """What they collide with is unknown then, which only their own fault tells."""
    found = refusal(
        "layers: {lost: [nobody], pocketed: []}\n"
        "entities: [{name: hole, collider: {sphere: {radius: 1}, sensor: true, on_enter: {layer: pocketed}}}]\n"
    )
    assert found == "w.yaml:2:1: layers: unknown layer 'nobody'; the layers are none, default, lost, pocketed"


def test_a_key_of_blanks_is_shown() -> None:
    """In quotes, where a path of nothing would be no place."""
    with pytest.raises(WorldError) as caught:
        load_text('carom: 1\nentities: [{body: {" ": 1}}]\n', "w.yaml")
    assert str(caught.value).startswith("w.yaml:2:20: entities.0.body.' ': unknown key; received ' '; accepted: type")


def test_jitter_is_a_distance() -> None:
    """None below 0, and none whose square is no number."""
    with pytest.raises(WorldError) as caught:
        load_text("carom: 1\nentities: [{transform: {jitter: -1}}, {transform: {jitter: [0, 1e200, 0]}}]\n", "w.yaml")
    assert str(caught.value).split("\n") == [
        "w.yaml:2:25: entities.0.transform.jitter: must be at least 0 m; received -1",
        "w.yaml:2:64: entities.1.transform.jitter.1: must be at most 1e+100 m; received 1e+200",
    ]


def test_parameters_that_are_none_are_told_of_the_prefab() -> None:
    """And nothing of who states some to it."""
    with pytest.raises(WorldError) as caught:
        load_text("carom: 1\nprefabs: {a: {parameters: 3.5}}\nentities: [{prefab: a, parameters: {x: 1}}]\n", "w.yaml")
    assert str(caught.value) == (
        "w.yaml:2:15: prefabs.a.parameters: must be a mapping; received 3.5; accepted: keys with values"
    )


def test_a_keyframe_with_a_faulty_expression_is_told_of_that_alone() -> None:
    """Its word is then as good as left out."""
    frames = "[{at: 0 s, position: [0, 0, 0]}, {at: 1 s, rotation: '${a}'}, {at: '${b}'}]"
    text = f"carom: 1\nentities: [{{body: {{type: kinematic}}, keyframes: {frames}}}]\n"
    with pytest.raises(WorldError) as caught:
        load_text(
            f"{text}cameras: {{a: {{keyframes: {frames.replace('rotation', 'position')}, target: [9, 9, 9]}}}}\n",
            "w.yaml",
        )
    told = (
        "unknown variable; received 'a'; accepted: none is defined",
        "unknown variable; received 'b'; accepted: none is defined",
    )
    assert [line.partition(": ")[2] for line in str(caught.value).split("\n")] == [
        f"entities.0.keyframes.1.rotation: {told[0]}",
        f"entities.0.keyframes.2.at: {told[1]}",
        f"cameras.a.keyframes.1.position: {told[0]}",
        f"cameras.a.keyframes.2.at: {told[1]}",
    ]


def test_a_ring_starts_within_a_few_turns() -> None:
    """An angle so large that its sine has no digit left is no angle."""
    with pytest.raises(WorldError) as told:
        load_text("carom: 1\nentities: [{name: a, ring: {count: 2, radius: 1, start: -3e9}}]\n", "w.yaml")
    assert str(told.value) == "w.yaml:2:50: entities.0.ring.start: must be at least -1e+06 rad; received -3000000000.0"


def test_who_carries_himself_is_held_by_nobody_for_ever() -> None:
    """A joint looks for the body that carries whom it holds; a circle beside another fault ends that search."""
    entities = [
        "{name: a, parent: {entity: b}, transform: {}}",
        "{name: b, parent: {entity: a}, transform: {}}",
        "{name: c, body: {mass: 1}}",
        "{name: pin, joint: {ball: {a: a, b: c, at: [0, 0, 0]}}}",
    ]
    circle = f"carom: 1\nentities: [{', '.join(entities)}]\n"
    with pytest.raises(WorldError) as told:
        load_text(f"{circle}seed: x\n", "w.yaml")
    assert str(told.value) == "w.yaml:3:1: seed: must be a whole number; received 'x'; accepted: 0 or more"
    with pytest.raises(WorldError) as told:
        load_text(circle, "w.yaml")
    assert str(told.value) == (
        "w.yaml:2:1: entities: entities carry each other in a circle: 'a', 'b'; detach one from its parent"
    )


@pytest.mark.parametrize(
    "shape", ["cylinder: {radius: 0.4, length: 18446744073709551616}", "sphere: {radius: 9.223372e+18}"]
)
def test_a_collider_ends_somewhere(shape: str) -> None:
    """FCL would look for the contacts of larger ones without end; planes have none, and what is only seen may be vast."""
    with pytest.raises(WorldError) as told:
        load_text(
            f"carom: 1\nentities: [{{name: a, collider: {{{shape}}}}}, {{name: b, visual: {{{shape}}}}}]\n", "w.yaml"
        )
    assert str(told.value) == (
        "w.yaml:2:22: entities.0.collider: reaches 9.22e+18 m, farther than detection can tell, 1e+12 m"
    )
