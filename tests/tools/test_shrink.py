"""``carom shrink`` leaves the smallest world in which the same expectation fails, and refuses those that hold."""

# ruff: noqa: E501 - messages stand whole, as a user sees them

from __future__ import annotations

import json
from pathlib import Path

import pytest

from carom.tools.cli import main
from carom.tools.shrinking.shrink import shrink
from carom.tools.shrinking.tree import Edit, edited, nodes, owner, shorter_numbers
from carom.worlds import load_text, load_world
from carom.worlds.reader import read

FORTY = """carom: 1
name: Forty
gravity: [0, 0, 0]
run: {duration: 3 s}
materials: {steel: {friction: 0.25}}
prefabs:
  crate: {collider: {box: {size: [1, 1, 1]}}, body: {mass: 2}, material: steel}
entities:
  - {name: rain, prefab: crate, transform: {position: [0, 5.4321, 0]}, grid: {count: [6, 1, 6], spacing: 2}}
  - {name: gun, prefab: crate, transform: {position: [-3, 0, 30]}, motion: {linear: [4, 0, 0]}}
  - {name: target, prefab: crate, transform: {position: [0, 0, 30]}}
  - {name: post, prefab: crate, transform: {position: [20, 0, 30]}}
  - {name: pin, joint: {fixed: {a: post, at: [20, 0, 30]}}}
forces:
  - {linear_drag: {coefficient: 0.001}, entities: [gun, post]}
cameras:
  main: {position: [0, 3, 10], target: [0, 0, 0]}
render: {plots: [speed(post)]}
expect:
  - {at: 3 s, post.position.x: {is: 20, within: 1 mm}}
  - never: target.position.x > 0.5 m
  - never: gun.position.x > -2 m
"""


@pytest.fixture
def world(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> str:
    """Return the file of a world of 40 entities, of which one strikes another."""
    monkeypatch.chdir(tmp_path)
    Path("forty.yaml").write_text(FORTY)
    return "forty.yaml"


def test_two_of_forty_are_left_with_the_shortest_run(world: str, capsys: pytest.CaptureFixture[str]) -> None:
    """Crates 2 m apart meet at 4 m/s after 0.5 s, and the target goes on at 2 m/s: past 0.5 m after 0.75 s, 45 steps."""
    assert main(["shrink", world, "-o", "small.yaml", "--expect", "2", "--json"]) == 0
    told = json.loads(capsys.readouterr().out)
    assert told["before"] == {"entities": 40, "words": 59, "frames": 180}
    assert (told["after"]["entities"], told["command"], told["complete"]) == (2, "carom test small.yaml", True)
    small = load_world("small.yaml")
    assert sorted(small.simulation.world.names()) == ["target"], "nobody asks for the name of the other"
    assert small.run.frames == told["after"]["frames"] <= 46
    assert list(small.document) == ["carom", "run", "prefabs", "entities", "expect"], "they fall together"
    assert [one.text for one in small.expectations] == ["never: target.position.x > 0.5 m"]
    assert main(["check", "small.yaml"]) == 0
    capsys.readouterr()
    assert main(["test", "small.yaml"]) == 1
    told = "FAILED small.yaml: 0 of 1 expectations held\n       small.yaml:8:5: failed in frame 9 at 0.15 s: "
    assert capsys.readouterr().out.startswith(told)


def test_what_fails_first_is_kept_and_others_are_told(world: str, capsys: pytest.CaptureFixture[str]) -> None:
    """The gun passes -2 m after 0.25 s, 15 steps and one that is beyond; trials are bounded."""
    assert main(["shrink", world, "--trials", "12"]) == 0
    out = capsys.readouterr().out.splitlines()
    assert out[0] == "forty.yaml: expectation 3 fails in forty_small.yaml as it does there"
    assert out[-3:] == [
        "  trials    12, stopped before nothing more could go",
        "  note      another expectation failed as well; choose by --expect",
        "show it with: carom test forty_small.yaml",
    ]
    assert load_world("forty_small.yaml").run.frames == 16
    text = Path("forty_small.yaml").read_text()
    assert shrink(world, Path("forty_small.yaml"), trials=12).text == text, "the same comes out again"


def test_worlds_that_hold_are_refused(world: str, capsys: pytest.CaptureFixture[str]) -> None:
    """With messages that say what is wrong, and nothing is written."""
    Path("held.yaml").write_text(FORTY.split("  - never: target")[0])
    Path("silent.yaml").write_text(FORTY.split("expect:")[0])
    for words, message in (
        ("held.yaml", "held.yaml: all of its expectations hold, so that there is no failure to keep; state under 'expect' what goes wrong"),
        ("silent.yaml", "silent.yaml expects nothing, so that nothing fails; state under 'expect' what goes wrong"),
        (f"{world} --expect 1", "--expect: expectation 1 of forty.yaml holds, 'post.position.x at frame 180'; choose one that fails"),
        (f"{world} --expect 4", "--expect: forty.yaml has 3 expectations; received 4, accepted: 1 to 3"),
    ):  # fmt: skip
        assert main(["shrink", *words.split()]) == 2
        assert capsys.readouterr().err == f"{message}\n"
    assert not list(Path().glob("*_small.yaml"))


def test_another_failure_does_not_count(tmp_path: Path) -> None:
    """A strike that comes too early is another failure than one that never comes: both bodies stay."""
    path = tmp_path / "strike.yaml"
    path.write_text("""carom: 1
gravity: [0, 0, 0]
run: {duration: 2 s}
entities:
  - {name: a, collider: {sphere: {radius: 0.5}}, body: {mass: 1}, motion: {linear: [2, 0, 0]}}
  - {name: b, collider: {sphere: {radius: 0.5}}, body: {mass: 1}, transform: {position: [2, 0, 0]}}
  - {name: c, collider: {sphere: {radius: 0.5}}, body: {mass: 1}, transform: {position: [9, 0, 0]}}
expect:
  - {when: {impact: [a, b]}, time: {is: 0.7, within: 1 ms}}
""")
    shrunk = shrink(str(path), tmp_path / "small.yaml")
    assert (shrunk.after.entities, shrunk.after.frames) == (2, 31), "it is noted in the step that begins with it"
    assert "time = 0.5 s" in shrunk.outcome


def test_what_is_included_is_in_the_smaller_world(tmp_path: Path) -> None:
    """Of a group and a file beside it only who matters is left; the header comes first."""
    (tmp_path / "part.yaml").write_text("carom: 1\nentities: [{name: floor, collider: {plane: {}}}]\n")
    path = tmp_path / "whole.yaml"
    path.write_text("""carom: 1
include: [part.yaml]
entities:
  - name: cart
    transform: {position: [0, 1, 0]}
    entities:
      - {name: body, collider: {box: {size: [1, 1, 1]}}, body: {mass: 1}, motion: {linear: [3, 0, 0]}}
      - {name: hat, collider: {sphere: {radius: 0.2}}, transform: {position: [0, 3, 0]}}
expect:
  - never: cart.body.position.x > 1 m
""")
    shrunk = shrink(str(path), tmp_path / "small.yaml")
    assert (shrunk.before.entities, shrunk.before.frames) == (3, 300)
    assert (shrunk.after.entities, shrunk.after.frames) == (1, 21)
    assert shrunk.text.startswith("carom: 1\n") and "include" not in shrunk.text


def test_a_wrong_value_stays_the_value_it_was(tmp_path: Path) -> None:
    """The ball falls 9.0 t^2 / 2, not 9.81: that gravity is what is left, although any other height is wrong as well."""
    path = tmp_path / "fall.yaml"
    path.write_text("""carom: 1
gravity: [0, -9.0, 0]
materials: {rubber: {restitution: 0.9}}
entities:
  - {name: ball, collider: {sphere: {radius: 0.05}}, body: {mass: 0.3}, material: rubber, transform: {position: [0, 5, 0]}}
  - {name: floor, collider: {plane: {}}, transform: {position: [0, -3, 0]}}
expect:
  - {at: 1 s, ball.position.y: {is: 0.095, within: 1 mm}}
""")
    shrunk = shrink(str(path), tmp_path / "small.yaml")
    small = load_text(shrunk.text)
    assert small.simulation.settings.gravity == (0, -9, 0) and small.simulation.world.names() == ["ball"]
    (ball,) = small.document["entities"]
    assert ball == {"name": "ball", "body": {"mass": 0.3}, "transform": {"position": [0, 5, 0]}}
    assert shrunk.after.frames == 60 and "ball.position.y = 0.5 m" in shrunk.outcome


def test_a_tree_is_cut_by_its_paths() -> None:
    """Nodes by level, numbers of a vector together; keys with dots are found; rounding keeps units."""
    tree = read("carom: 1\nlist: [{a.b: [1.23456, 2]}, {c: 170.4 g}]\nnames: [x, y]\nrun: {frames: 100}", "here").data
    assert nodes(tree, 1) == [("list",), ("names",)]
    assert nodes(tree, 2) == [("list", 0), ("list", 1), ("names", 0), ("names", 1)]
    assert nodes(tree, 3) == [("list", 0, "a.b"), ("list", 1, "c")] and nodes(tree, 4) == []
    assert owner(tree, "list.0.a.b.1") == ("list", 0) and owner(tree, "names.1") == ("names", 1)
    assert owner(tree, "run.frames") is None and owner(tree, "nothing.here") is None
    edits = shorter_numbers(tree, 2)
    assert edits == [Edit(("list", 0, "a.b", 0), 1.2), Edit(("list", 1, "c"), "170 g")]
    small = edited(tree, [*edits, Edit(("list", 1)), Edit(("names", 0))])
    assert small == {"carom": 1, "list": [{"a.b": [1.2, 2]}], "names": ["y"], "run": {"frames": 100}}
