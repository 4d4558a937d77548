"""Questions to a recording: every answer is what was simulated, and every wrong question is told in whole words."""

from __future__ import annotations

import builtins
import json
from pathlib import Path
from typing import Any

import numpy as np
import polars
import pytest

from carom.systems.energy import total_energy
from carom.systems.observer import observed
from carom.systems.simulation import Simulation
from carom.tools.asking import ask
from carom.tools.cli import main
from carom.tools.recorder import Recorder
from carom.tools.recorder.stream import Stamp, Stream
from carom.tools.recorder.tracks.booked import Booked
from carom.tools.recording import Recording

TABLES = "bodies, contacts, impacts, energy, overlap, counts, log, snapshots"


@pytest.fixture(scope="module")
def run(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, dict[int, float]]:
    """Return the recording of two balls, one of which comes late and goes, on a floor, and the energy of each step."""
    path = tmp_path_factory.mktemp("run") / "run.rrd"
    simulation = Simulation(dt=1 / 120)
    simulation.add(name="floor", collider={"plane": {}})
    step = {"box": {"size": (0.16, 0.1, 0.16)}}
    simulation.add(name="unseen", transform={"position": (0.45, 0, 0)}, collider=step, visual={"visible": False})
    ball(simulation, "first", 0.2)
    with observed(simulation, Recorder(path, every=2)):
        energies = {0: total_energy(simulation.world)}
        for frame in range(1, 61):
            if frame == 11:
                ball(simulation, "second", 0.15)
            if frame == 41:
                simulation.world.despawn(simulation.world.find("second"))
            simulation.step()
            energies[frame] = total_energy(simulation.world)
    return path, energies


def ball(simulation: Simulation, name: str, height: float) -> None:
    """Add a ball of 10 cm, each of another colour."""
    color = (height, 0.5, 0.5)
    where = {"position": (2.0 * height, height, 0.0)}
    simulation.add(
        name=name, transform=where, collider={"sphere": {"radius": 0.05}}, body={}, material={"color": color}
    )


def test_bodies_hold_the_pose_of_each_in_every_frame(run: tuple[Path, dict[int, float]]) -> None:
    """Of those that stand still and come and go too, as the reader of single frames returns them."""
    recording = Recording(run[0])
    table = recording.table("bodies").polars()
    for frame in recording.frames:
        rows = table.filter(polars.col("frame") == frame)
        poses, names = recording.poses(frame), recording.names(frame)
        assert rows["entity"].to_list() == sorted(poses)
        assert rows["name"].to_list() == [names[entity] for entity in sorted(poses)]
        for name, axes in (("position", "xyz"), ("rotation", "xyzw")):
            columns = rows.select(f"{name}.{axis}" for axis in axes).to_numpy()
            assert np.array_equal(columns, [getattr(poses[entity], name) for entity in sorted(poses)])
    assert set(table["shape"]) == {"plane", "sphere"}
    assert [len(table.filter(polars.col("frame") == frame)) for frame in (10, 12, 40, 42)] == [2, 3, 3, 2]


def test_contacts_hold_what_was_recorded_of_each_frame(run: tuple[Path, dict[int, float]]) -> None:
    """With the names of both sides."""
    recording = Recording(run[0])
    table = recording.table("contacts").polars()
    assert table.height > 10
    for frame in recording.frames:
        rows, expected = table.filter(polars.col("frame") == frame), recording.contacts(frame)
        for name in ("a", "b", "depth", "impulse", "speed"):
            assert np.array_equal(rows[name].to_numpy(), expected[name])
        for name in ("point", "normal"):
            received = rows.select(f"{name}.{axis}" for axis in "xyz").to_numpy()
            assert np.array_equal(received, expected[name].reshape(-1, 3))
    assert set(table["a.name"]) == {"floor", "unseen"}
    assert set(table["b.name"]) == {"first", "second"}


def test_plots_log_and_snapshots_are_tables(run: tuple[Path, dict[int, float]]) -> None:
    """Keyed by frame, times in s."""
    recording, energies = Recording(run[0]), run[1]
    energy = recording.table("energy").polars()
    assert dict(zip(energy["frame"], energy["total"], strict=True)) == {f: energies[f] for f in range(0, 61, 2)}
    assert energy["time"].to_list() == pytest.approx(np.arange(0, 61, 2) / 120, abs=1e-9)
    log = recording.table("log").polars()
    assert list(zip(log["time"], log["text"], strict=True)) == [(line.time, line.text) for line in recording.lines]
    assert recording.table("snapshots").polars()["hash"].to_list() == [state.hash for state in recording.saved_states()]


def test_a_curve_that_begins_later_stays_in_its_frames(tmp_path: Path) -> None:
    """An entry of the ledger is written from the block on in which it was first booked; before, it is NaN."""
    import rerun.blueprint

    simulation, booked = Simulation(), Booked()
    ledger = simulation.keep_ledger()
    stream = Stream("ledger")
    stream.to_file(tmp_path / "run.rrd", rerun.blueprint.Blueprint())
    for frame in range(4):
        ledger.since["gravity"] = frame
        if frame > 1:
            ledger.since["wind"] = -frame
        booked.sample(simulation, Stamp(frame, frame / 60), stream)
        booked.write(stream)
    stream.close()
    table = Recording(tmp_path / "run.rrd").table("ledger")
    rows = table.polars()
    assert rows["frame"].to_list() == [0, 1, 2, 3]
    assert rows["gravity"].to_list() == [0.0, 1.0, 2.0, 3.0]
    assert rows["wind"].fill_nan(None).to_list() == [None, None, -2.0, -3.0]
    assert table.arrow().schema.field("wind").metadata[b"unit"] == b"J"


def test_columns_carry_unit_and_meaning(run: tuple[Path, dict[int, float]]) -> None:
    """In Arrow, for whatever reads it."""
    field = Recording(run[0]).table("contacts").arrow().schema.field("depth")
    assert field.metadata == {b"unit": b"m", b"doc": b"overlap, negative for a gap"}


@pytest.mark.parametrize(
    ("question", "statement"),
    [
        ("contacts", "SELECT * FROM contacts"),
        ("contacts where impulse > 0.01 and speed < 1", "SELECT * FROM contacts WHERE impulse > 0.01 AND speed < 1"),
        ("bodies where name = 'position.x' or position.y < 0.1", 'select * from bodies where "position.y" < 0.1'),
        (
            "contacts where b.name = 'first' limit 2",
            "select * from contacts where contacts.\"b.name\" = 'first' limit 2",
        ),
    ],
)
def test_a_short_question_is_a_select(question: str, statement: str, run: tuple[Path, dict[int, float]]) -> None:
    """Columns with a dot need no quotes, and what is in quotes is left alone."""
    recording = Recording(run[0])
    answer = ask(recording, question)
    assert answer.height > 0
    assert answer.equals(ask(recording, statement))


def test_conditions_choose_rows(run: tuple[Path, dict[int, float]]) -> None:
    """Just those, in order of frame; whole SELECT statements join tables."""
    recording = Recording(run[0])
    table = recording.table("contacts").polars()
    chosen = ask(recording, "contacts where impulse > 0.01 and frame > 20")
    assert chosen.equals(table.filter((polars.col("impulse") > 0.01) & (polars.col("frame") > 20)))
    joined = ask(
        recording,
        "select b.frame, b.position.y, e.total from bodies b join energy e on b.frame = e.frame "
        "where b.name = 'first' order by b.frame",
    )
    assert joined["frame"].to_list() == recording.frames
    assert joined["total"].to_list() == [run[1][frame] for frame in recording.frames]


@pytest.mark.parametrize(
    ("question", "message"),
    [
        ("contacs", f"query: no table 'contacs'; accepted: {TABLES}; did you mean 'contacts'?"),
        (
            "energy where totel > 1",
            "query: no column 'totel'; accepted: frame, time, kinetic, potential, total; did you mean 'total'?",
        ),
        (
            "energy where total >",
            (
                "query: Expected: an expression, found: EOF; received 'energy where total >'; "
                "write it as TABLE, TABLE where CONDITION, or a SELECT"
            ),
        ),
    ],
)
def test_a_wrong_question_is_told(
    question: str, message: str, run: tuple[Path, dict[int, float]], capsys: pytest.CaptureFixture[str]
) -> None:
    """What was received, what is accepted; exit 2 and nothing printed."""
    assert main(["query", str(run[0]), question]) == 2
    assert capsys.readouterr() == ("", f"{message}\n")


def test_answers_are_text_csv_json_and_files(
    run: tuple[Path, dict[int, float]], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """All with the same rows."""
    question = "select frame, bodies from counts where frame < 3"
    assert main(["query", str(run[0]), question]) == 0
    assert [line.split() for line in capsys.readouterr().out.splitlines()] == [
        ["frame", "bodies"],
        ["0", "1.0"],
        ["2", "1.0"],
        ["2", "rows"],
    ]
    assert main(["query", str(run[0]), question, "--csv"]) == 0
    assert capsys.readouterr().out == "frame,bodies\n0,1.0\n2,1.0\n"
    rows = [{"frame": 0, "bodies": 1.0}, {"frame": 2, "bodies": 1.0}]
    assert main(["query", str(run[0]), question, "--json"]) == 0
    assert json.loads(capsys.readouterr().out) == rows
    readers: dict[str, Any] = {"parquet": polars.read_parquet, "csv": polars.read_csv, "json": polars.read_json}
    for suffix, read in readers.items():
        out = tmp_path / "deep" / f"counts.{suffix}"
        assert main(["query", str(run[0]), question, "--out", str(out)]) == 0
        assert capsys.readouterr().out == f"{out}: 2 rows\n"
        assert read(out).to_dicts() == rows


def test_without_a_question_the_tables_are_told(
    run: tuple[Path, dict[int, float]], capsys: pytest.CaptureFixture[str]
) -> None:
    """With rows, units and meanings."""
    assert main(["query", str(run[0])]) == 0
    told = capsys.readouterr().out
    assert "energy: 31 rows\n  frame        1      number of the step\n  time         s      simulated time\n" in told
    assert "  speed        m/s    closing speed along the normal\n" in told
    assert main(["query", str(run[0]), "--json"]) == 0
    assert [table["table"] for table in json.loads(capsys.readouterr().out)] == TABLES.split(", ")


def test_what_cannot_be_asked_is_told(
    run: tuple[Path, dict[int, float]], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """No file, no question to write the answer of, no recording."""
    lost = f"{tmp_path}/none.rrd"
    for words, message in (
        ([lost, "log"], f"no recording at {lost}; make one with: carom run billiards --record {lost}"),
        ([str(run[0]), "--csv"], "--csv: goes with a question, such as 'contacts'"),
        ([str(run[0]), "--out", "a.csv"], "--out: goes with a question, such as 'contacts'"),
    ):
        assert main(["query", *words]) == 2
        assert capsys.readouterr() == ("", f"{message}\n")
    (tmp_path / "text.rrd").write_text("hello, this is no recording")
    assert main(["query", f"{tmp_path}/text.rrd", "log"]) == 2
    assert capsys.readouterr().err.startswith(f"cannot read {tmp_path}/text.rrd: ")


def test_polars_is_named_where_it_is_missing(
    run: tuple[Path, dict[int, float]], monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """With the extra that brings it."""
    real = builtins.__import__

    def without(name: str, *rest: Any, **further: Any) -> Any:
        if name == "polars":
            raise ModuleNotFoundError(name=name)
        return real(name, *rest, **further)

    monkeypatch.setattr(builtins, "__import__", without)
    assert main(["query", str(run[0]), "log"]) == 2
    assert capsys.readouterr().err == "query: polars is not installed; run: pip install 'carom[dataframe]'\n"
