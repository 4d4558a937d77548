"""Levels of detail: each has all before it, commands go before worlds, and no bit of a run depends on one."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from carom.ecs import DeclarationError, Force, RigidBody, World, state_hash, system
from carom.systems.observer import observed
from carom.systems.settings import Random
from carom.systems.simulation import Simulation
from carom.tools.cli import main
from carom.tools.recorder import Recorder
from carom.tools.recorder.detail import tracks_of
from carom.tools.recording import Recording
from carom.worlds.sections import DETAILS

WORLD = """
carom: 1
run: {frames: 30}
recording: {detail: full}
entities:
  - {name: floor, collider: {plane: {}}}
  - {name: ball, transform: {position: [0, 0.2, 0]}, collider: {sphere: {radius: 0.1}}, body: {}}
"""


@system(reads=(RigidBody, Random), adds=(Force,))
def tremble(world: World, dt: float) -> None:
    """Push everybody another way in every substep."""
    rows = world.row_numbers(RigidBody)
    world[Force].force[rows] += world[Random].generator.normal(size=(len(rows), 3))


def detail(path: Path) -> str:
    """Return the detail a recording says it has."""
    return str(Recording(path).static["/about"]["detail"][0])


def test_each_level_has_all_of_those_before_it() -> None:
    """In their order."""
    light, full, solver = (list(tracks_of(level)) for level in DETAILS)
    assert light == [
        "bodies", "ledger", "cameras", "contacts", "dissipation", "error", "difference", "ghosts", "log", "impacts",
        "particles", "plots", "promoted", "triggers",
    ]  # fmt: skip
    own = {
        "bounds", "colliders", "forces", "manifolds", "momentum", "normals", "shapes", "states", "trails", "velocities"
    }  # fmt: skip
    assert own <= set(full) - set(light)
    assert [key for key in full if key in light] == light
    assert [key for key in solver if key in full] == full


def test_momentum_is_that_of_all_bodies_in_every_frame(tmp_path: Path) -> None:
    """Two masses that fall freely gain (m1 + m2) g t; nothing acts sideways."""
    simulation = Simulation(dt=1 / 60, gravity=(0.0, -10.0, 0.0))
    for mass, speed in ((2.0, 3.0), (1.0, -1.0)):
        place = {"position": (mass, 9.0, 0.0)}
        simulation.add(
            transform=place,
            collider={"sphere": {"radius": 0.1}},
            body={"mass": mass},
            motion={"linear": (speed, 0.0, 0.0)},
        )
    with observed(simulation, Recorder(tmp_path / "rec.rrd", detail="full")):
        simulation.step(30)
    table = Recording(tmp_path / "rec.rrd").table("momentum").polars()
    assert table["frame"].to_list() == list(range(31))
    assert table["x"].to_list() == [5.0] * 31
    assert table["y"].to_list() == pytest.approx([-30.0 * frame / 60 for frame in range(31)], abs=1e-12)
    assert table["z"].to_list() == [0.0] * 31


def test_the_command_line_goes_before_the_world(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Of a run and of a replay."""
    world, path, part = tmp_path / "world.yaml", tmp_path / "rec.rrd", tmp_path / "part.rrd"
    world.write_text(WORLD)
    assert main(["run", str(world), "--record", str(path)]) == 0
    assert detail(path) == "full"
    assert main(["run", str(world), "--record", str(path), "--detail", "light"]) == 0
    assert detail(path) == "light"
    frames = ["--from", "10", "--to", "12", "--out", str(part)]
    assert main(["replay", str(path), *frames]) == 0
    assert detail(part) == "full"
    assert main(["replay", str(path), *frames, "--detail", "solver"]) == 0
    assert detail(part) == "solver"
    assert Recording(part).frames == [10, 11, 12]
    capsys.readouterr()
    assert main(["replay", str(path), "--detail", "full"]) == 2
    assert capsys.readouterr().err == "--detail: goes with --out FILE, the recording it is of\n"


def test_no_bit_of_a_run_depends_on_the_detail(tmp_path: Path) -> None:
    """Nor does what a replay finds: hashes of state are the same."""
    hashes = []
    for level in DETAILS:
        path = tmp_path / f"{level}.rrd"
        assert main(["run", "billiards", "--frames", "240", "--record", str(path), "--detail", level]) == 0
        hashes.append([saved.hash for saved in Recording(path).saved_states()])
        assert len(hashes[-1]) > 1
    assert hashes[0] == hashes[1] == hashes[2]


def test_forces_that_draw_numbers_draw_the_same_whoever_looks_on(tmp_path: Path) -> None:
    """Forces are told by evaluating them once more."""
    ends = []
    for level in DETAILS:
        simulation = Simulation(seed=7)
        simulation.add(name="ball", collider={"sphere": {"radius": 0.1}}, body={})
        simulation.schedule = simulation.schedule.insert(tremble, after="apply_quadratic_drag")
        with observed(simulation, Recorder(tmp_path / f"{level}.rrd", detail=level)):
            simulation.step(10)
        ends.append(state_hash(simulation.world))
    assert ends[0] == ends[1] == ends[2]


@pytest.mark.parametrize("detail", DETAILS)
def test_worlds_of_little_are_recorded(tmp_path: Path, detail: str) -> None:
    """Nobody at all; a look without a body; a point alone; a body without a shape, whose name is told."""
    little: list[dict[str, Any]] = [
        {"visual": {"sphere": {"radius": 0.1}}},
        {"collider": {"point": {}}, "body": {"mass": 1.0, "inertia": (1.0, 1.0, 1.0)}},
        {"body": {"mass": 1.0, "inertia": (1.0, 1.0, 1.0)}},
    ]
    for words in (None, *little):
        simulation, recorder = Simulation(), Recorder(tmp_path / "little.rrd", every=1, detail=detail)
        if words is not None:
            simulation.add(name="it", **words)
        recorder.begin(simulation)
        simulation.step(2)
        recorder.observe(simulation)
        recorder.end(simulation)
        recording = Recording(tmp_path / "little.rrd")
        rows = {name: recording.table(name).polars() for name in recording.tables()}
        assert len(rows["energy"]) == 2
        assert set(rows["bodies"]["name"]) == ({"it"} if words and words.keys() & {"visual", "collider"} else set())
        if detail != "light":
            assert set(rows["velocities"]["body.name"]) == ({"it"} if words and "body" in words else set())


def test_a_detail_that_is_none_is_told(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """From Python, of a world, and where nothing is recorded."""
    with pytest.raises(DeclarationError) as caught:
        Recorder(tmp_path / "rec.rrd", detail="ful")
    assert str(caught.value) == "no detail is named 'ful'; accepted: light, full, solver; did you mean 'full'?"
    world = tmp_path / "world.yaml"
    world.write_text(WORLD.replace("detail: full", "detail: ful"))
    assert main(["run", str(world)]) == 2
    told = f"{world}:4:13: recording.detail: unknown word; received 'ful'; accepted: light, full, solver\n"
    assert capsys.readouterr().err == told
    assert main(["run", "bounce", "--detail", "full"]) == 2
    assert capsys.readouterr().err == "--detail: goes with --record FILE or --live, the recording it is of\n"
