"""A recording holds all it takes to simulate it again, bit for bit, and tells where something else had a hand in it."""

from __future__ import annotations

import json
import re
import shutil
import signal
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import trimesh

from carom.ecs import CaromError, Motion, Name, SnapshotError, Transform, state_hash
from carom.tools.cli import main
from carom.tools.recorder import Recorder, about
from carom.tools.recording import SavedState
from carom.tools.replay import Replay
from carom.tools.retrace import Verdict, retrace
from carom.worlds import LoadedWorld, WorldError, library, load_text, load_world

SHORT = {"billiards": 0.5, "bowling": 0.1, "dominoes": 0.4}  # s; more of them takes a minute

BALLS = """
carom: 1
name: two balls
step: {dt: 1/120}
run: {duration: 2.5 s}
entities:
  - {name: floor, collider: {plane: {}}}
  - {name: left, collider: {sphere: {radius: 0.2}}, body: {}, transform: {position: [-1, 1, 0]}}
  - {name: right, collider: {sphere: {radius: 0.2}}, body: {}, transform: {position: [1, 0.2, 0]}}
"""


def record(loaded: LoadedWorld, path: Path, frames: int, edits: dict[int, Any] | None = None) -> list[str]:
    """Record so many steps, doing ``edits`` after some; return the hash of every frame."""
    simulation = loaded.simulation
    title, source, files = loaded.name, loaded.source_text, loaded.contents()
    recorder = Recorder(path, title=title, source=source, files=files)
    simulation.observers.append(recorder)
    recorder.begin(simulation)
    hashes = [state_hash(simulation.world)]
    for _ in range(frames):
        if edits and simulation.frame in edits:
            edits[simulation.frame](simulation)
        simulation.step()
        hashes.append(state_hash(simulation.world))
    recorder.end(simulation)
    return hashes


def replayed(path: Path) -> Verdict:
    """Replay the whole of a recording."""
    replay = Replay(path)
    return retrace(replay, replay.loaded(), replay.last)


QUICK = ("billiards", "robot_arm", "trap")  # the other worlds take longer
ALL = [name if name in QUICK else pytest.param(name, marks=pytest.mark.slow) for name in library.names()]


@pytest.mark.parametrize("name", ALL)
def test_every_library_world_is_replayed_bit_for_bit(name: str, tmp_path: Path) -> None:
    """From its beginning, and from any snapshot on."""
    loaded = load_world(name)
    frames = min(loaded.run.frames, round(SHORT.get(name, 2.0) / loaded.simulation.settings.dt))
    hashes = record(loaded, tmp_path / "a.rrd", frames)
    verdict = replayed(tmp_path / "a.rrd")
    assert (verdict.same, verdict.full, verdict.changes, verdict.notes) == (True, frames, [], [])
    replay = Replay(tmp_path / "a.rrd")
    assert {0, frames} <= replay.states.keys()
    for frame in replay.states.keys() - {frames}:
        simulation = replay.simulation_at(frame)
        simulation.step(min(3, frames - frame))
        assert state_hash(simulation.world) == hashes[simulation.frame]


def test_any_frame_can_be_gone_to_and_on_from(tmp_path: Path) -> None:
    """Also those between snapshots and between recorded frames, and with sleepers."""
    hashes = record(load_text(BALLS), tmp_path / "a.rrd", 300)
    for frame in (0, 1, 119, 120, 121, 299, 300):
        simulation = Replay(tmp_path / "a.rrd").simulation_at(frame)
        assert state_hash(simulation.world) == hashes[frame]
    simulation = Replay(tmp_path / "a.rrd").simulation_at(250)
    assert simulation["right"].motion.asleep
    simulation.step(50)
    assert state_hash(simulation.world) == hashes[300]


def test_settings_of_the_command_line_are_replayed(tmp_path: Path) -> None:
    """With them the world is another than its file alone makes."""
    loaded = load_text(BALLS, dt=1 / 90, collision="fcl", integrator="semi_implicit", seed=7, gravity=(0.0, -1.6, 0.0))
    record(loaded, tmp_path / "a.rrd", 60)
    assert replayed(tmp_path / "a.rrd").same
    assert Replay(tmp_path / "a.rrd").loaded().simulation.settings == loaded.simulation.settings


def test_nothing_beside_the_recording_is_needed(tmp_path: Path) -> None:
    """The files a world names travel along, wherever they lay; nothing of them is written beside the recording."""
    box = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"
    (tmp_path / "worlds").mkdir()
    (tmp_path / "tip.obj").write_text(box)
    body = "{name: tip, collider: {convex: {file: ../tip.obj}}, body: {}, transform: {position: [0, 1, 0]}}"
    (tmp_path / "worlds" / "a.yaml").write_text(f"carom: 1\nentities: [{body}]\n")
    record(load_world(tmp_path / "worlds" / "a.yaml"), tmp_path / "a.rrd", 70)
    (tmp_path / "tip.obj").unlink()
    (tmp_path / "worlds" / "a.yaml").unlink()
    assert Replay(tmp_path / "a.rrd").files == {"../tip.obj": box.encode()}
    assert replayed(tmp_path / "a.rrd").same
    assert sorted(path.name for path in tmp_path.iterdir()) == ["a.rrd", "worlds"]


def test_files_that_named_files_name_travel_along(tmp_path: Path) -> None:
    """A .gltf with its buffer and a picture beside it, in a folder whose name has a blank."""
    folder = tmp_path / "a model"
    folder.mkdir()
    for name, content in trimesh.exchange.gltf.export_gltf(trimesh.Scene(trimesh.creation.icosphere(2))).items():
        (folder / name).write_bytes(content)
    model = json.loads((folder / "model.gltf").read_text())
    model["images"] = [{"uri": "a%20picture.png"}, {"uri": "gone.png"}]
    (folder / "a picture.png").write_bytes(b"picture")
    (folder / "model.gltf").write_text(json.dumps(model))
    body = "{name: ball, collider: {convex: {file: a model/model.gltf}}, body: {}, transform: {position: [0, 2, 0]}}"
    (tmp_path / "a.yaml").write_text(f"carom: 1\nentities: [{body}, {{name: floor, collider: {{plane: {{}}}}}}]\n")
    record(load_world(tmp_path / "a.yaml"), tmp_path / "a.rrd", 70)
    shutil.rmtree(folder)
    held = json.loads(Replay(tmp_path / "a.rrd").files["a model/model.gltf"])
    assert [image["uri"] for image in held["images"]] == ["data:image/png;base64,cGljdHVyZQ==", "gone.png"]
    assert replayed(tmp_path / "a.rrd").same


def test_what_was_written_between_two_steps_is_written_again(tmp_path: Path) -> None:
    """Poses, velocities, names, and forces in every step: any frame is what it was, to the bit."""

    def meddle(simulation: Any) -> None:
        """Push one, now and then throw the other, who sleeps meanwhile, and call it something else."""
        simulation["left"].external_force.force = (0.1 * simulation.frame, 3.0, 0.0)
        if simulation.frame % 40 == 0:
            with simulation.world.edit(Motion) as motion, simulation.world.edit(Transform) as transform:
                motion.linear[2], motion.asleep[2] = (0.0, 0.0, 0.01 * simulation.frame), False
                transform.position[2, 1] += 0.5
            with simulation.world.edit(Name) as name:
                name.text[2] = f"thrown in {simulation.frame}"

    hashes = record(load_text(BALLS), tmp_path / "a.rrd", 200, dict.fromkeys(range(200), meddle))
    verdict = replayed(tmp_path / "a.rrd")
    assert (verdict.same, verdict.full, verdict.last) == (True, 200, 200)
    replay = Replay(tmp_path / "a.rrd")
    for frame in (41, 59, 119, 161, 199):
        assert state_hash(replay.simulation_at(frame).world) == hashes[frame]


def test_to_open_a_component_wakes_as_it_did(tmp_path: Path) -> None:
    """Also where nothing was written."""

    def look(simulation: Any) -> None:
        """Open what is not written."""
        with simulation.world.edit(Transform):
            pass

    hashes = record(load_text(BALLS), tmp_path / "a.rrd", 200, {150: look, 190: look})
    assert Replay(tmp_path / "a.rrd").recording.edits() == {151: "Transform", 191: "Transform"}
    assert state_hash(Replay(tmp_path / "a.rrd").simulation_at(199).world) == hashes[199]


def test_a_component_exchanged_between_two_steps_is_told(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """With the frame, the entity and the column; all around it is the same."""

    def push(simulation: Any) -> None:
        """Give a velocity, between frames 150 and 151."""
        simulation.world.attach(simulation.world.find("left"), Motion(linear=(0.0, 0.0, 3.0)))

    record(load_text(BALLS), tmp_path / "a.rrd", 300, {150: push})
    (parting,) = replayed(tmp_path / "a.rrd").partings
    assert (parting.first, parting.last, parting.seen, parting.entity) == (120, 151, None, "")
    found = parting.difference
    assert found is not None
    assert (found.frame, found.entity, found.component, found.column) == (151, "left", "Motion", "linear")
    assert main(["replay", str(tmp_path / "a.rrd")]) == 1
    told = capsys.readouterr().out
    pattern = (
        r"PATH: frames 0 to 300 simulated again: "
        r"not the same; the first is what was recorded, the second what came out now\n"
        r"  from 1 s to 1\.25833 s \(frames 120 to 151\):\n"
        r"    code outside the step changed who lives before frame 151\n"
        r"    frame 151: Motion\.linear\[2\] of entity 'left' is \S+ in the first and \S+ in the second, "
        r"\d+ ulps apart\n"
    )
    assert re.fullmatch(pattern.replace("PATH", re.escape(str(tmp_path / "a.rrd"))), told), told


def test_edits_in_quick_succession_are_told_with_the_frame_in_which_they_show(tmp_path: Path) -> None:
    """Only the first leaves a snapshot; who goes is told, and what was written meanwhile is the same."""

    def push(simulation: Any) -> None:
        """Give a velocity."""
        simulation["right"].motion.linear = (0.0, 1.0, 0.0)

    def remove(simulation: Any) -> None:
        """Take one away."""
        simulation.world.despawn(simulation.world.find("left"))

    record(load_text(BALLS), tmp_path / "a.rrd", 130, {10: push, 20: push, 30: remove})
    verdict = replayed(tmp_path / "a.rrd")
    told = [(parting.first, parting.last, parting.seen, parting.entity) for parting in verdict.partings]
    assert told == [(11, 120, 32, "left")]
    assert [parting.edits for parting in verdict.partings] == [{21: "Motion", 31: "who lives"}]
    assert str(verdict.partings[0].difference) == "frame 120: entity 'left' lives only in the second"


def test_what_a_step_itself_changes_is_no_edit(tmp_path: Path) -> None:
    """A world whose sensor gives another layer to who enters."""
    loaded = load_world("trap")
    record(loaded, tmp_path / "a.rrd", 240)
    assert Replay(tmp_path / "a.rrd").recording.edits() == {}


def test_an_edit_before_the_first_step_is_told(tmp_path: Path) -> None:
    """The recording then begins with what its world file does not make; all after it is as recorded."""
    loaded = load_text(BALLS)
    loaded.simulation["right"].motion.linear = (0.0, 1.0, 0.0)
    record(loaded, tmp_path / "a.rrd", 130)
    (parting,) = replayed(tmp_path / "a.rrd").partings
    assert parting.text(1 / 120) == (
        "from 0 s to 0 s (frames 0 to 0):\n"
        "    frame 0: Motion.linear[1] of entity 'right' is 1.0 in the first and 0.0 in the second, "
        "4607182418800017408 ulps apart"
    )


def test_a_force_of_python_is_told_as_another_step(tmp_path: Path) -> None:
    """It is in no file, so that the replay does without."""
    loaded = load_text(BALLS)
    loaded.simulation.force_function(lambda world, rows: np.ones((len(rows), 3)), name="blow")
    record(loaded, tmp_path / "a.rrd", 60)
    verdict = replayed(tmp_path / "a.rrd")
    assert not verdict.same
    assert verdict.changes == ["the step was another: systems only then: blow; only here: none"]


def test_other_versions_and_processors_are_told(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Beside the verdict, which they need not change."""
    record(load_text(BALLS), tmp_path / "a.rrd", 4)
    here = about.versions_here()
    other = {"version_numba": "0.1", "processor": "abacus"}
    monkeypatch.setattr(about, "versions_here", lambda: here | other)
    verdict = replayed(tmp_path / "a.rrd")
    path = tmp_path / "a.rrd"
    assert verdict.text() == (
        f"{path}: frames 0 to 4 simulated again: the same, bit for bit\n"
        f"  changed: processor was {here['processor']}, here it is abacus\n"
        f"  changed: numba was {here['version_numba']}, here it is 0.1"
    )


def test_a_recording_of_before_the_step_was_recorded_is_replayed(tmp_path: Path) -> None:
    """Nothing is said of the step."""
    record(load_text(BALLS), tmp_path / "a.rrd", 4)
    replay = Replay(tmp_path / "a.rrd")
    del replay.stated["schedule"]
    verdict = retrace(replay, replay.loaded(), 4)
    assert (verdict.same, verdict.changes) == (True, [])


def test_some_frames_are_recorded_again_in_every_step(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """What comes out is a recording like any other, which begins in the middle."""
    hashes = record(load_text(BALLS), tmp_path / "a.rrd", 300)
    part = tmp_path / "made" / "part.rrd"
    assert main(["replay", str(tmp_path / "a.rrd"), "--from", "130", "--to", "142", "--out", str(part)]) == 0
    assert capsys.readouterr().out == (
        f"{tmp_path / 'a.rrd'}: frames 130 to 142 simulated again: the same, "
        f"bit for bit up to frame 130, then in every recorded pose, rounded to float32\n  recording  {part}\n"
    )
    again = Replay(part)
    assert again.recording.frames == list(range(130, 143))
    assert (again.title, again.source) == ("two balls", BALLS)
    assert [(saved.frame, saved.hash) for saved in again.states.values()] == [(130, hashes[130]), (142, hashes[142])]
    assert main(["replay", str(part)]) == 0
    assert capsys.readouterr().out == f"{part}: frames 130 to 142 simulated again: the same, bit for bit\n"


def test_frames_that_were_not_recorded_are_refused(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """On the command line and in Python."""
    path = tmp_path / "a.rrd"
    record(load_text(BALLS), path, 20)
    assert main(["replay", str(path), "--from", "10", "--to", "30"]) == 2
    assert capsys.readouterr().err == f"frames 10 to 30 cannot be simulated again; {path} holds frames 0 to 20\n"
    assert main(["replay", str(path), "--out", str(path)]) == 2
    assert capsys.readouterr().err == f"{path} is the recording itself; write another file\n"
    with pytest.raises(CaromError, match=re.escape(f"{path} does not hold frame 21, but frames 0 to 20")):
        Replay(path).simulation_at(21)


def test_a_snapshot_that_was_tampered_with_is_refused(tmp_path: Path) -> None:
    """By its checksum, by its hash, and one of a later version by that."""
    path = tmp_path / "a.rrd"
    record(load_text(BALLS), path, 200)
    replay = Replay(path)
    saved = replay.states[120]
    name = f"{path}, the snapshot of frame 120,"
    damaged = saved.state[:-1] + bytes([saved.state[-1] ^ 1])
    later = saved.state.replace(b"carom snapshot 2 ", b"carom snapshot 3 ", 1)
    for state, digest, message in (
        (damaged, saved.hash, f"{name} is damaged: its bytes are not those that were saved; save it anew"),
        (later, saved.hash, f"{name} is of version 3, this carom reads version 2; update carom"),
        (saved.state, "0" * 32, f"{name} is damaged: its hash is {saved.hash}, recorded with it is {'0' * 32}"),
    ):
        replay.states[120] = SavedState(120, state, digest)
        for act in (lambda: replay.simulation_at(130), lambda: retrace(replay, replay.loaded(), 200)):
            with pytest.raises(SnapshotError) as refused:
                act()
            assert str(refused.value) == message


def test_a_world_file_that_no_longer_loads_is_refused(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """As any world file, saying in which recording it is."""
    path = tmp_path / "a.rrd"
    loaded = load_text(BALLS)
    loaded.source_text = "carom: 1\nentitys: []\n"
    record(loaded, path, 2)
    with pytest.raises(WorldError):
        Replay(path).loaded()
    assert main(["replay", str(path)]) == 2
    assert capsys.readouterr().err.startswith(f"{path}, its world file:2:1: entitys: unknown key; received 'entitys'")


def test_what_is_no_such_recording_is_refused(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """A file that is not there, one of something else, and one without a world file."""
    nowhere, text, python = (tmp_path / name for name in ("nowhere.rrd", "text.rrd", "python.rrd"))
    text.write_text("carom: 1\n")
    loaded = load_text(BALLS)
    loaded.source_text = ""
    record(loaded, python, 2)
    lost = f"no recording at {nowhere}; make one with: carom run billiards --record {nowhere}\n"
    unsourced = (
        f"{python} holds no world file, so that it cannot be simulated again; "
        f"record a world file: carom run WORLD --record {python}\n"
    )
    for path, message in ((nowhere, lost), (python, unsourced)):
        assert main(["replay", str(path)]) == 2
        assert capsys.readouterr().err == message
    assert main(["replay", str(text)]) == 2
    assert capsys.readouterr().err.startswith(f"cannot read {text}: ")


KILLED = """
import sys
sys.path.insert(0, {folder!r})
from pathlib import Path
from test_replay import BALLS
from carom.tools.recorder import Recorder
from carom.worlds import load_text
loaded = load_text(BALLS)
recorder = Recorder(Path({path!r}), source=loaded.source_text)
loaded.simulation.observers.append(recorder)
recorder.begin(loaded.simulation)
while True:
    loaded.simulation.step()
    print(loaded.simulation.frame, flush=True)
"""


def test_a_recording_cut_by_a_kill_is_replayed_as_far_as_it_goes(tmp_path: Path) -> None:
    """Which is said; up to the last snapshot bit for bit, then by its poses."""
    path = tmp_path / "killed.rrd"
    code = KILLED.format(folder=str(Path(__file__).parent), path=str(path))
    with subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, text=True) as process:
        assert process.stdout is not None
        for line in process.stdout:
            if int(line) >= 310:
                break
        process.send_signal(signal.SIGKILL)
    verdict = replayed(path)
    assert verdict.same
    assert verdict.full >= 120
    assert verdict.notes == [
        f"{path} was not finished: the run that wrote it was killed; its last second may be missing"
    ]


def test_the_replay_stays_free_of_the_recording(tmp_path: Path) -> None:
    """A simulation of it is the user's own."""
    record(load_text(BALLS), tmp_path / "a.rrd", 40)
    replay = Replay(tmp_path / "a.rrd")
    mine = replay.simulation_at(20)
    mine["left"].motion.linear = (9.0, 0.0, 0.0)
    mine.step(20)
    other = replay.simulation_at(40)
    assert not np.array_equal(mine.world[Motion].linear, other.world[Motion].linear)
