"""What a world says and can hardly mean is told by check, where it stands."""

from __future__ import annotations

from pathlib import Path

import pytest

from carom.tools.cli import main
from carom.worlds import load_text
from carom.worlds.lint import lint

BALL = "entities:\n- {name: a, collider: {sphere: {radius: 1}}, body: {}}\n"


def warnings(text: str, folder: Path | None = None) -> list[str]:
    """Return what is told of a world; the header is added as line 1."""
    return lint(load_text("carom: 1\n" + text, "w.yaml", folder))


@pytest.mark.parametrize(
    ("text", "told"),
    [
        (
            "materials: {ice: {}, wood: {}}\nentities: [{material: wood}]\n",
            ["w.yaml:2:13: materials.ice: is used nowhere"],
        ),
        (
            "prefabs: {a: {}, b: {prefab: a}, c: {}}\nentities: [{prefab: b}]\n",
            ["w.yaml:2:34: prefabs.c: is used nowhere"],
        ),
        (
            "layers: {a: all, b: [c], c: all, d: all}\nentities: [{collider: {sphere: {radius: 1}, layer: a}}]\n",
            ["w.yaml:2:18: layers.b: is used nowhere", "w.yaml:2:34: layers.d: is used nowhere"],
        ),
        (
            "variables: {a: 1 m, b: '${a}', c: 1, d: {e: 1}}\nname: a world of ${b} and ${d.e}\n",
            ["w.yaml:2:32: variables.c: is used nowhere"],
        ),
        (
            "variables: {kind: ice}\nmaterials: {ice: {}, wood: {}}\nentities: [{material: '${kind}'}]\n",
            [],
        ),
        (
            "entities: [{name: ball, collider: {sphere: {radius: 2 km}}, body: {mass: 1e14}}]\n",
            ["w.yaml:2:12: entities.0: ball is 4e+03 m long; was another unit meant?"],
        ),
        (
            "entities: [{name: ball, collider: {sphere: {radius: 50 mm}}, body: {mass: 160}}]\n",
            ["w.yaml:2:12: entities.0: ball has 3.06e+05 kg/m3; is its mass or its size meant otherwise?"],
        ),
        (
            "entities: [{name: ball, collider: {sphere: {radius: 1}}, body: {}, motion: {linear: [2 km/s, 0, 0]}}]\n",
            ["w.yaml:2:12: entities.0: ball moves at 2e+03 m/s; was another unit meant?"],
        ),
        (
            BALL + "- {name: b, collider: {sphere: {radius: 1}}, transform: {position: [1.5, 0, 0]}}\n",
            ["w.yaml:4:3: entities.1: a and b are 0.5 m in each other at the start"],
        ),
        (
            BALL + "- {name: floor, collider: {plane: {offset: -0.99}}}\n",
            [],
        ),
        (
            BALL + "run: {duration: 1 s}\nevents: [{at: 59/60 s, despawn: [a]}, {at: 1 s, despawn: [a]}]\n"
            "expect: [{at: 1 s, speed(a): {is: 1, within: 1}, spin(a): {is: 1, within: 1}}, {settles_by: 2 s},\n"
            "  {at: 61/60 s, speed(a): {is: 1, within: 1}, spin(a): {is: 1, within: 1}}]\n",
            [
                "w.yaml:5:40: events.1.at: comes after the end of the run, 1 s",
                "w.yaml:6:80: expect.1: comes after the end of the run, 1 s",
                "w.yaml:7:3: expect.2: comes after the end of the run, 1 s",
            ],
        ),
        (
            BALL + "events: [{at: 1e308 s, despawn: [a]}]\n",
            ["w.yaml:4:11: events.0.at: comes after the end of the run, 5 s"],
        ),
    ],
)
def test_what_is_doubtful_is_told(text: str, told: list[str]) -> None:
    """Names that nobody uses, sizes as of a mistaken unit, bodies in each other."""
    assert warnings(text) == told


def test_included_files_may_hold_more_than_is_used(tmp_path: Path) -> None:
    """They are there for other worlds too."""
    (tmp_path / "m.yaml").write_text("carom: 1\nmaterials: {ice: {}, wood: {}}\n")
    assert warnings("include: [m.yaml]\nmaterials: {tin: {}}\n", tmp_path) == [
        "w.yaml:3:13: materials.tin: is used nowhere"
    ]


def test_a_crowd_of_one_kind_does_not_hide_the_rest() -> None:
    """Twenty are told, and how many more there are."""
    text = "entities: [{name: b, collider: {sphere: {radius: 1}}, body: {}, line: {count: 30, step: [1, 0, 0]}}]\n"
    told = warnings(text)
    assert len(told) == 21
    assert told[-1] == "w.yaml:1:1: 9 more of that kind"


def test_check_prints_warnings_and_is_content(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """They go to stderr, and the exit code stays 0."""
    world = tmp_path / "w.yaml"
    world.write_text("carom: 1\nmaterials: {ice: {}}\n")
    assert main(["check", str(world)]) == 0
    said = capsys.readouterr()
    assert said.err == f"warning: {world}:2:13: materials.ice: is used nowhere\n"
    assert said.out == f"ok     {world}: 0 entities, 0 expectations\n"
