"""A world may be put together from files beside it, and from no others; what is wrong is told in the file it is in."""

# ruff: noqa: E501 - messages stand whole, as a user sees them

from __future__ import annotations

from pathlib import Path

import pytest

from carom.ecs.snapshot import state_hash
from carom.tools.filming import shot_of
from carom.tools.recorder.of_world import recorder_of
from carom.tools.replay import Replay
from carom.worlds import LoadedWorld, WorldError, load_text, load_world

BOX = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"
WORLD = """carom: 1
name: Two tips
include: [parts/tip.yaml, materials.yaml]
variables: {height: 2 m}
materials: {ice: {friction: 0}}
entities:
  - {name: right, prefab: tip, transform: {position: [3, "${height}", 0]}}
run: {duration: 0.5 s}
"""
TIP = """carom: 1
name: A tip, tried alone
include: [../materials.yaml]
variables: {height: 1 m}
gravity: [0, -1, 0]
prefabs: {tip: {collider: {convex: {file: tip.obj}}, body: {}, material: stone}}
entities:
  - {name: left, prefab: tip, transform: {position: [0, "${height}", 0]}}
"""
MATERIALS = "carom: 1\nmaterials:\n  stone: {density: 2000}\n  ice: {friction: 1}\n"


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """Return a folder with a world of three files and a model."""
    (tmp_path / "parts").mkdir()
    for name, text in (
        ("w.yaml", WORLD),
        ("parts/tip.yaml", TIP),
        ("materials.yaml", MATERIALS),
        ("parts/tip.obj", BOX),
    ):
        (tmp_path / name).write_text(text)
    return tmp_path


def load(folder: Path) -> LoadedWorld:
    """Return the world of a folder."""
    return load_text((folder / "w.yaml").read_text(), "w.yaml", folder)


def messages(folder: Path, **files: str) -> list[str]:
    """Return the lines a world is refused with once these of its files are changed."""
    for name, text in files.items():
        (folder / f"{name}.yaml").write_text(text)
    with pytest.raises(WorldError) as caught:
        load(folder)
    return str(caught.value).split("\n")


def test_files_together_are_the_world_that_one_file_would_be(folder: Path) -> None:
    """Names are joined, entities follow each other, and the words of who includes go before those it includes."""
    loaded = load(folder)
    one_file = """carom: 1
gravity: [0, -1, 0]
materials: {stone: {density: 2000}, ice: {friction: 0}}
prefabs: {tip: {collider: {convex: {file: parts/tip.obj}}, body: {}, material: stone}}
entities:
  - {name: left, prefab: tip, transform: {position: [0, 2, 0]}}
  - {name: right, prefab: tip, transform: {position: [3, 2, 0]}}
"""
    assert loaded.name == "Two tips"
    assert loaded.simulation.world.names() == ["left", "right"]
    assert state_hash(loaded.simulation.world) == state_hash(load_text(one_file, "w.yaml", folder).simulation.world)
    assert loaded.files == {name: folder / name for name in ("parts/tip.yaml", "materials.yaml", "parts/tip.obj")}


def test_a_recording_holds_what_it_includes(folder: Path) -> None:
    """It is simulated again from itself alone, when the files are gone."""
    loaded = load_world(folder / "w.yaml")
    stated = {"title": loaded.name, "source": loaded.source_text, "files": loaded.contents()}
    simulation, recorder = loaded.simulation, recorder_of(loaded, shot_of(loaded), folder / "a.rrd", every=1, **stated)
    recorder.begin(simulation)
    for _ in range(10):
        simulation.step()
        recorder.observe(simulation)
    recorder.end(simulation)
    for name in ("w.yaml", "parts/tip.yaml", "materials.yaml", "parts/tip.obj"):
        (folder / name).unlink()
    again = Replay(folder / "a.rrd").simulation_at(frame=10)
    assert state_hash(again.world) == state_hash(simulation.world)


def test_faults_are_told_in_the_file_they_are_in(folder: Path) -> None:
    """Each with its own line, column and path, all of them at once."""
    tip = TIP.replace("body: {}", "body: {mas: 1}").replace("name: left", "name: left, matrial: stone") + "speed: 3\n"
    found = messages(folder, **{"parts/tip": tip, "materials": MATERIALS.replace("2000", "-1")})
    assert [line.split("; received")[0] for line in found] == [
        "materials.yaml:3:11: materials.stone.density: must be above 0 kg/m3",
        "parts/tip.yaml:6:61: prefabs.tip.body.mas: unknown key",
        "parts/tip.yaml:8:18: entities.0.matrial: unknown key",
        "parts/tip.yaml:9:1: speed: unknown key",
    ]


def test_a_fault_after_included_entities_counts_from_its_own_file(folder: Path) -> None:
    """The first entity of the world is entities.0 there, whatever went before it."""
    assert messages(folder, w=WORLD.replace("prefab: tip", "prefab: tap")) == [
        "w.yaml:7:19: entities.0.prefab: unknown prefab; received 'tap'; accepted: tip; did you mean 'tip'?"
    ]
    assert messages(folder, w=WORLD.replace("name: right", "name: left")) == [
        "w.yaml:7:6: entities.0.name: two entities of one name; received 'left', also of entities.0 at line 8 of parts/tip.yaml"
    ]


@pytest.mark.parametrize(
    ("word", "told"),
    [
        ("tools.yaml", "file FOLDER/tools.yaml does not exist"),
        ("../other.yaml", "lies outside the folder of the world; move it there"),
        ("parts/../../other.yaml", "lies outside the folder of the world; move it there"),
        ("/etc/other.yaml", "lies outside the folder of the world; move it there"),
        ("link.yaml", "lies outside the folder of the world; move it there"),
        ("parts/tip.obj", "is no world file; its name ends in .yaml, .yml, .json"),
        ("parts", "is no world file; its name ends in .yaml, .yml, .json"),
        ("w.yaml", "includes itself: w.yaml -> w.yaml"),
    ],
)
def test_what_cannot_be_included_is_told_where_it_is_named(folder: Path, word: str, told: str) -> None:
    """No file outside the folder is read, be it through a link."""
    (folder / "link.yaml").symlink_to("/etc/hostname")
    message = f"w.yaml:2:11: include.0: {told.replace('FOLDER', str(folder))}; received {word!r}"
    assert messages(folder, w=f"carom: 1\ninclude: [{word}]\n") == [message]


def test_circles_are_told(folder: Path) -> None:
    """The whole way round, where it closes."""
    assert messages(
        folder, w="carom: 1\ninclude: [a.yaml]\n", a="carom: 1\ninclude: [b.yaml]\n", b="carom: 1\ninclude: [a.yaml]\n"
    ) == ["b.yaml:2:11: include.0: includes itself: w.yaml -> a.yaml -> b.yaml -> a.yaml; received 'a.yaml'"]


def test_depth_and_number_of_files_are_limited(folder: Path) -> None:
    """A row of files ends in a sentence, and so does a crowd of them."""
    for number in range(120):
        (folder / f"f{number}.yaml").write_text(f"carom: 1\ninclude: [f{number + 1}.yaml]\n")
        (folder / f"g{number}.yaml").write_text("carom: 1\n")
    assert messages(folder, w="carom: 1\ninclude: [f0.yaml]\n") == [
        "f15.yaml:2:11: include.0: is included through more than 16 files; received 'f16.yaml'"
    ]
    crowd = ", ".join(f"g{number}.yaml" for number in range(101))
    (line,) = messages(folder, w=f"carom: 1\ninclude: [{crowd}]\n")
    assert line.endswith("include.100: is one file more than a world may include, 100; received 'g100.yaml'")


def test_two_files_side_by_side_do_not_say_the_same_thing_twice(folder: Path) -> None:
    """Which would win could only be guessed."""
    a, b = (
        "carom: 1\nmaterials: {ice: {}}\ngravity: [0, 0, 0]\n",
        "carom: 1\nmaterials: {ice: {}}\ngravity: [0, 1, 0]\n",
    )
    hint = "say it in the file that includes both"
    assert messages(folder, w="carom: 1\ninclude: [a.yaml, b.yaml]\n", a=a, b=b) == [
        f"b.yaml:2:13: materials.ice: is said by a.yaml as well, at line 2; {hint}",
        f"b.yaml:3:1: gravity: is said by a.yaml as well, at line 3; {hint}",
    ]


def test_whatever_is_wrong_with_an_included_file_is_told(folder: Path) -> None:
    """One without a header, one that is no YAML, and words that are no names of files."""
    assert messages(folder, w="carom: 1\ninclude: [a.yaml, b.yaml, 3]\nseed: x\n", a="seed: 1\n", b="a: b: c\n") == [
        "a.yaml:1:1: carom: is missing; accepted: 'carom: 1' as its first line",
        (
            "b.yaml:1:5: is not YAML: mapping values are not allowed in this context; "
            "a text with ': ' stands in quotes, entries beside each other stand in {...}"
        ),
        "w.yaml:2:27: include.2: must be text; received 3; accepted: text",
        "w.yaml:3:1: seed: must be a whole number; received 'x'; accepted: 0 or more",
    ]
