"""A user's own package takes part like carom itself: schema, check, explain, runs, recordings, hashes, messages."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path

import jsonschema
import pytest

from carom.ecs import (
    SnapshotError,
    snapshot_from_bytes,
)
from carom.systems.simulation import Simulation
from carom.tools.recording import Recording
from carom.worlds.reader import read

EXAMPLE = Path(__file__).parent / "example_extension"
NEST = EXAMPLE / "nest.yaml"
CAROM = ("-m", "carom.tools.cli")


@pytest.fixture(scope="module")
def site(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Install the example from its own folder, offline, into a folder that is on no path otherwise."""
    folder = tmp_path_factory.mktemp("site")
    alone = ["--no-deps", "--no-build-isolation", "--no-index", "--disable-pip-version-check"]
    command = [sys.executable, "-m", "pip", "install", "--quiet", *alone, "--target", str(folder), str(EXAMPLE)]
    subprocess.run(command, check=True, capture_output=True)
    return folder


def run(words: Sequence[str | Path], *sites: Path) -> subprocess.CompletedProcess[str]:
    """Run Python in a process that finds what is installed in ``sites``."""
    paths = [*map(str, sites), *filter(None, [os.environ.get("PYTHONPATH")])]
    environment = os.environ | {"PYTHONPATH": os.pathsep.join(paths)}
    return subprocess.run([sys.executable, *map(str, words)], capture_output=True, text=True, env=environment)


def carom(site: Path, *words: str | Path) -> str:
    """Return what a command prints that ends well."""
    done = run([*CAROM, *words], site)
    assert done.returncode == 0, done.stderr
    return done.stdout


def extension(folder: Path, name: str, source: str) -> Path:
    """Write an installed distribution of one module, ``carom-NAME`` 1.0, with its entry point."""
    about = folder / f"carom_{name}-1.0.dist-info"
    about.mkdir(parents=True)
    (about / "METADATA").write_text(f"Metadata-Version: 2.1\nName: carom-{name}\nVersion: 1.0\n")
    (about / "entry_points.txt").write_text(f"[carom.extensions]\n{name} = {name}\n")
    (folder / f"{name}.py").write_text(source)
    return folder


def test_the_schema_knows_its_words_with_unit_and_meaning(site: Path) -> None:
    """Its world fits, and columns, parameters and defaults are those it declares."""
    schema = json.loads(carom(site, "schema"))
    jsonschema.Draft202012Validator(schema).validate(read(NEST.read_text(), NEST.name).data)
    parts = schema["$defs"]
    health = parts["Health"]["properties"]
    assert "health" in parts["Entity"]["properties"] and parts["Health"]["description"] == "What blows wear down."
    assert (health["points"]["anyOf"][0]["type"], health["points"]["default"]) == ("integer", 1)
    assert health["toughness"]["x-unit"] == "N s"
    assert health["toughness"]["description"] == "impulse up to which a blow does nothing (N s)"
    assert health["armor"]["anyOf"][0]["maxItems"] == 3
    assert health["guardian"]["type"] == "string"
    assert parts["Egg"]["required"] == ["radius", "length"]
    assert {"egg", "sphere"} < set(parts["Collider"]["properties"]) & set(parts["Visual"]["properties"])
    assert "tether" in parts["Force"]["properties"] and parts["Tether"]["properties"]["stiffness"]["x-unit"] == "N/m"


def test_explain_shows_its_systems_where_they_are_placed(site: Path) -> None:
    """With what they read, write and add."""
    frame = json.loads(carom(site, "explain", "--json"))
    names = [row["system"] for row in frame]
    damage, tether = frame[names.index("take_damage")], frame[names.index("apply_tether")]
    assert names[names.index("take_damage") + 1] == "clear_inputs"
    assert names[names.index("apply_tether") - 1] == "apply_quadratic_drag"
    assert (damage["phase"], damage["reads"], damage["writes"]) == ("finish", ["Impact"], ["Health"])
    assert (tether["phase"], tether["adds"]) == ("laws", ["Force"])
    assert tether["reads"] == ["Forces", "Transform", "RigidBody"]


def test_its_world_holds_what_it_expects_and_is_recorded_and_drawn(site: Path, tmp_path: Path) -> None:
    """Shape, force, component and both systems at work in checked mode; every state in the recording comes back."""
    record, picture = tmp_path / "nest.rrd", tmp_path / "nest.png"
    summary = json.loads(carom(site, "run", NEST, "--json", "--check", "--record", record, "--picture", picture))
    assert (summary["expectations"], summary["failures"]) == (6, [])
    assert picture.read_bytes().startswith(b"\x89PNG")
    code = """
import json, sys
from carom.ecs import restore_snapshot, snapshot_from_bytes, state_hash
from carom.tools.recording import Recording
from carom.worlds.builder import load_world

recording = Recording(sys.argv[1])
simulation = load_world(sys.argv[2]).simulation
points = []
for saved in recording.saved_states():
    restore_snapshot(simulation.world, snapshot_from_bytes(saved.state, simulation.world))
    assert state_hash(simulation.world) == saved.hash
    points.append(int(simulation["swinging"].health.points))
(version,) = recording.static["/about"]["version_carom_example"]
print(json.dumps([points, version, sorted(recording.names(0).values())]))
"""
    done = run(["-c", code, record, NEST], site)
    assert done.returncode == 0, done.stderr
    assert json.loads(done.stdout) == [[3, 2], "0.1.0", ["dropped", "floor", "swinging"]]
    simulation = Simulation()
    with pytest.raises(SnapshotError) as fault:
        snapshot_from_bytes(Recording(record).saved_states()[0].state, simulation.world)
    assert str(fault.value) == (
        "the snapshot does not fit this world:\n"
        "  it holds component 'health', which nothing here declares; carom_example.health did: "
        "import it, or install the package carom_example"
    )


def test_its_state_is_hashed_and_stated_in_python_as_in_files(site: Path) -> None:
    """One point more is another state; in checked mode as always."""
    code = """
from carom.ecs import state_hash
from carom.systems.simulation import Simulation

def made(points):
    simulation = Simulation()
    shape = {"egg": {"radius": 1.0, "length": 3.0}}
    simulation.add(name="egg", health={"points": points, "toughness": 0.1}, collider=shape)
    simulation.force("tether", stiffness=2.0)
    return simulation

from carom_example.health import Health
a, b, c = made(3), made(3), made(4)
assert state_hash(a.world) == state_hash(b.world) != state_hash(c.world)
with c.world.edit(Health) as health:
    health.points[0] -= 1
assert state_hash(c.world) == state_hash(a.world)
try:
    a.add(helth={})
except Exception as fault:
    print(fault)
"""
    done = run(["-c", code], site)
    assert done.returncode == 0, done.stderr
    assert done.stdout == "an entity has no word 'helth'; did you mean 'health'?\n"


def test_check_tells_what_is_wrong_with_its_words(site: Path, tmp_path: Path) -> None:
    """At line and column, with unit and the nearest word, in prefabs and expectations too."""
    world = tmp_path / "bad.yaml"
    world.write_text(
        "carom: 1\n"
        "prefabs:\n"
        "  egg: {health: {pionts: 3}}\n"
        "entities:\n"
        "  - {name: b, health: {points: 2.5, toughness: 3 kg}}\n"
        "  - {name: c, health: {armor: [1, 2]}, collider: {egg: {radius: 1}}}\n"
        "  - {name: d, helth: {}}\n"
        "forces:\n"
        "  - {tether: {stiffness: 0}}\n"
    )
    done = run([*CAROM, "check", world], site)
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr == (
        f"{world}:3:18: prefabs.egg.health.pionts: unknown key; received 'pionts'; accepted: points, toughness, "
        "guardian, armor; did you mean 'points'?\n"
        f"{world}:5:24: entities.0.health.points: must be a whole number; received 2.5; "
        "accepted: -2147483648 to 2147483647\n"
        f"{world}:5:37: entities.0.health.toughness: must be a value in N s; received '3 kg', which is a mass; "
        "accepted: a number in N s, or one with a unit: N s\n"
        f"{world}:6:24: entities.1.health.armor: must be a list of 3 numbers; received [1, 2]; accepted: numbers in m\n"
        f"{world}:6:51: entities.1.collider.egg.length: is missing; accepted: from end to end (m)\n"
        f"{world}:7:15: entities.2.helth: unknown key; received 'helth'; accepted: name, prefab, transform, motion, "
        "body, keyframes, collider, material, visual, emitter, joint, tags, health, parent, spring, grid, heap, line, "
        "pyramid, random, ring, stack, wall, chain, parameters, entities; did you mean 'health'?\n"
        f"{world}:9:15: forces.0.tether.stiffness: must be above 0 N/m; received 0\n"
    )
    world.write_text("carom: 1\nentities: [{name: a, health: {guardian: aa}}]\nexpect: [{never: a.health.point > 2}]\n")
    done = run([*CAROM, "check", world], site)
    assert done.stderr == (
        f"{world}:2:31: entities.0.health.guardian: unknown entity; received 'aa'; accepted: a; did you mean 'a'?\n"
        f"{world}:3:11: expect.0.never: a has no such column; received 'health.point'; accepted: position, rotation, "
        "friction, restitution, density, rolling_friction, spinning_friction, friction_combine, restitution_combine, "
        "number, color, points, toughness, guardian, armor; did you mean 'points'?\n"
    )


def test_where_it_is_not_installed_its_words_are_unknown() -> None:
    """A world file means the same whatever else a process has imported."""
    done = run([*CAROM, "check", NEST])
    assert done.returncode == 2
    assert f"\n{NEST}:13:6: forces.0.tether: unknown key; received 'tether'; accepted: " in done.stderr


COMPONENT = (
    "from carom.ecs import Component, column\nclass {name}(Component):\n    x = column(unit={unit!r}, doc='x')\n"
)
SHAPE = (
    "from carom.systems.shapes.sphere import Sphere\nclass Rival(Sphere):\n    key = {key!r}\n    number = {number}\n"
)
LAW = "from carom.systems.forces.law import Law\nclass Rival(Law):\n    key = 'tether'\n"
SYSTEM = (
    "from carom.ecs import Force, system\nfrom carom.systems.places import placed\n"
    "@placed({place})\n@system(adds=(Force,))\ndef {name}(world, dt):\n    'Do nothing.'\n"
)
MODULE = "extension 'rival' of carom-rival 1.0 cannot be used: {}; python -c 'import rival' shows where; "
MODULE += "without it: python -m pip uninstall carom-rival"


@pytest.mark.parametrize(
    ("source", "message"),
    [
        ("import nowhere", MODULE.format("ModuleNotFoundError: No module named 'nowhere'")),
        (
            COMPONENT.format(name="Health", unit="1"),
            MODULE.format("two components are named Health: carom_example.health and rival; rename one of them"),
        ),
        (
            SHAPE.format(key="egg", number=70),
            MODULE.format("two shapes have the key 'egg': carom_example.egg and rival; give one of them another key"),
        ),
        (
            SHAPE.format(key="ball", number=0),
            MODULE.format(
                "two shapes have the number 0: carom.systems.shapes.sphere and rival; let one of them state none"
            ),
        ),
        (
            LAW,
            MODULE.format(
                "two force laws have the key 'tether': carom_example.tether and rival; give one of them another key"
            ),
        ),
        (
            SYSTEM.format(name="take_damage", place="after='apply_wind'"),
            MODULE.format("two systems are named take_damage: carom_example.damage and rival; rename one of them"),
        ),
        (
            SYSTEM.format(name="fly", place=""),
            MODULE.format('a place is either after or before one system; write @placed(after="apply_gravity")'),
        ),
        (
            SYSTEM.format(name="kick", place="after='apply_wind'"),
            "system 'kick' of rival (carom-rival 1.0) is named like one of carom's; rename it",
        ),
        (
            COMPONENT.format(name="Grid", unit="1"),
            "component Grid of rival (carom-rival 1.0) has the key 'grid', which is a word of every entity; rename it",
        ),
        (
            COMPONENT.format(name="Mana", unit="mana"),
            "component Mana of rival (carom-rival 1.0): column 'x': unknown unit 'mana'; use SI units, '1' for counts",
        ),
    ],
)
def test_an_extension_that_cannot_be_used_ends_with_2_and_says_whose_it_is(
    source: str, message: str, site: Path, tmp_path: Path
) -> None:
    """Broken, or of a name that carom or another extension has; the command line goes on helping."""
    rival = extension(tmp_path, "rival", source)
    done = run([*CAROM, "check", NEST], site, rival)
    assert (done.returncode, done.stdout, done.stderr) == (2, "", message + "\n")


def test_the_doctor_lists_extensions(site: Path, tmp_path: Path) -> None:
    """Or says which of them cannot be used."""
    code = "from carom.tools.doctor import examine, extensions; print(examine(extensions))"
    done = run(["-c", code], site)
    assert done.stdout == "Finding(name='extensions', works=True, seen='carom-example 0.1.0', mend='')\n", done.stderr
    done = run(["-c", code], extension(tmp_path, "rival", "import nowhere"))
    assert "works=False, seen=\"extension 'rival' of carom-rival 1.0 cannot be used: ModuleNotFound" in done.stdout


def test_neither_an_import_nor_help_imports_extensions(tmp_path: Path) -> None:
    """So that carom starts as fast as without them, and a broken one does not take the help away."""
    broken = extension(tmp_path, "broken", "import nowhere")
    everything = "import carom.ecs, carom.systems.simulation, carom.worlds.builder, carom.tools.recorder"
    for words in (["-c", everything], [*CAROM, "--help"], [*CAROM, "--version"]):
        done = run(words, broken)
        assert done.returncode == 0, done.stderr
