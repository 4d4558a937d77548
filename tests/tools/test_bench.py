"""A bench states every figure with its bound, and fails where one does not hold or a peer is missing."""

from __future__ import annotations

import json
import math
import sys
from collections.abc import Callable, Iterator
from types import ModuleType

import numpy as np
import pytest

from carom.ecs import Motion, RigidBody, Transform, World
from carom.tools.bench import BENCHES, hull_rows, narrow_rows
from carom.tools.bench.measure import Figure, compared, timed, timed_process
from carom.tools.bench.table_loops import by_numba, by_numpy, columns, scheduled
from carom.tools.bench.table_worlds import contiguous, fragmented
from carom.tools.cli import main


@pytest.fixture
def tiny(monkeypatch: pytest.MonkeyPatch) -> ModuleType:
    """Put in a bench of two figures, one above and one below its bound."""
    bench = ModuleType("carom.tools.bench.tiny")

    def figures() -> Iterator[Figure]:
        yield Figure("fast", "s", 1.0, 0.5, 2.0)
        yield Figure("speed", "x", 3.0, 5.0, 4.0, by="cpu", at_least=True)

    bench.figures = figures  # type: ignore[attr-defined]
    monkeypatch.setitem(sys.modules, bench.__name__, bench)
    monkeypatch.setitem(BENCHES, "tiny", "tiny")
    return bench


def test_bounds_hold_from_either_side_by_wall_or_cpu() -> None:
    """A bound is a most or a least, of the stated clock."""
    assert Figure("a", "s", 1.0, 9.0, 1.0).holds
    assert not Figure("a", "s", 1.1, 0.0, 1.0).holds
    assert Figure("a", "x", 1.0, 9.0, 5.0, by="cpu", at_least=True).holds
    assert not Figure("a", "x", 9.0, 1.0, 5.0, by="cpu", at_least=True).holds


def test_every_figure_is_printed_with_its_bound(tiny: ModuleType, capsys: pytest.CaptureFixture[str]) -> None:
    """The machine's line comes first."""
    assert main(["bench", "tiny"]) == 0
    machine, fast, speed = capsys.readouterr().out.splitlines()
    assert "Python" in machine and "numba" in machine
    assert fast.startswith("holds  fast ") and fast.endswith("at most 2 s by wall, median of 1")
    assert speed.startswith("holds  speed ") and speed.endswith("at least 4 x by cpu, median of 1")


def test_a_figure_that_does_not_hold_makes_exit_1(
    tiny: ModuleType, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """Also as JSON, where every figure tells whether it holds."""
    monkeypatch.setattr(tiny, "figures", lambda: iter([Figure("slow", "s", 3.0, 0.5, 2.0)]))
    assert main(["bench", "tiny", "--json"]) == 1
    (figure,) = json.loads(capsys.readouterr().out)["figures"]
    assert figure["holds"] is False
    assert figure["bound"] == 2.0


def test_a_missing_peer_makes_exit_1_and_names_the_extra(
    tiny: ModuleType, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """Nothing is measured then."""
    monkeypatch.setattr(tiny, "PEERS", ("json", "no_such_engine"), raising=False)
    assert main(["bench", "tiny"]) == 1
    assert capsys.readouterr().err == "bench tiny compares with no_such_engine; run: pip install 'carom[peers]'\n"


def test_parts_of_a_bench_are_measured_alone(
    tiny: ModuleType, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """In the order asked for; a part that is not there is wrong usage, and told with those that are."""
    assert main(["bench", "tiny", "half"]) == 2
    assert capsys.readouterr().err == "bench tiny has no part half; it is measured as a whole\n"
    parts = {name: lambda name=name: iter([Figure(name, "mm", 1.0, 1.0, math.inf, "value")]) for name in "abc"}
    monkeypatch.setattr(tiny, "PARTS", parts, raising=False)
    assert main(["bench", "tiny", "d", "a", "e"]) == 2
    assert capsys.readouterr().err == "bench tiny has no part d, e; its parts are a, b, c\n"
    assert main(["bench", "tiny", "c", "a"]) == 0
    lines = capsys.readouterr().out.splitlines()[1:]
    assert [line.split() for line in lines] == [["holds", name, "1", "mm", "no", "bound"] for name in "ca"]


def test_timings_are_medians_of_wall_and_cpu() -> None:
    """In this process and of others."""
    assert timed(lambda: sum(range(1000)), 3).repeats == 3
    spent = timed_process([sys.executable, "-c", "pass"], 3)
    assert 0.0 < spent.cpu < 10.0 * spent.wall


def test_one_body_obeys_its_laws(capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> None:
    """Ours alone, where no other engine is: what the numbers of the docs say of it holds."""
    monkeypatch.setattr("carom.tools.bench.laws.find_spec", lambda name: None)
    assert main(["bench", "laws"]) == 0
    told = capsys.readouterr().out.splitlines()[1:]
    assert len(told) == 6 and all(line.startswith("holds") and ", carom " in line for line in told)


def test_the_benches_of_this_issue_are_there() -> None:
    """Each file of the registry is importable and has figures."""
    from importlib import import_module

    assert {"start", "break", "ecs", "detect", "contacts"} <= BENCHES.keys()
    for module in BENCHES.values():
        assert callable(import_module(f"carom.tools.bench.{module}").figures)


def test_two_are_compared_in_turns() -> None:
    """What the machine does meanwhile meets both; the first calls do not count."""
    order: list[str] = []
    ratio = compared(lambda: order.append("one"), lambda: order.append("other"), 3, 2)
    assert order == ["one", "other", *["one", "other", "other"] * 3]
    assert ratio.repeats == 3


@pytest.mark.parametrize("make", [contiguous, fragmented])
def test_what_the_table_is_compared_with_does_the_same(make: Callable[[int], World]) -> None:
    """The system and the loops by hand move the same rows by the same numbers, and nobody else."""
    results = []
    for loop in (scheduled, by_numba, by_numpy):
        world = make(1000)
        before, (position, velocity) = columns(world)[0].copy(), columns(world)
        step = loop(world)
        step(), step()
        results.append((position.copy(), velocity.copy()))
        moved = np.nonzero((position != before).any(axis=1))[0]
        assert moved.tolist() == world.row_numbers(Transform, Motion).tolist()
    for other in results[1:]:
        np.testing.assert_allclose(other[0], results[0][0], rtol=1e-14, atol=1e-15)
        np.testing.assert_allclose(other[1], results[0][1], rtol=1e-14, atol=1e-15)


def test_rows_with_gaps_are_those_of_three_sets_less_a_tenth() -> None:
    """As many move as in the contiguous world, and no two rows in three stand next to each other for long."""
    world = fragmented(9000)
    assert 8800 < world.count(Motion) < 9200
    assert world.count(Transform) == 13500
    assert 0.45 < world.count(RigidBody) / world.count(Motion) < 0.55
    assert np.count_nonzero(np.diff(world.row_numbers(Transform, Motion)) > 1) > 4000
    assert contiguous(9000).rows(Transform, Motion, RigidBody) == slice(0, 9000)


def test_kernels_are_raced_with_fcl_over_poses_that_touch(monkeypatch: pytest.MonkeyPatch) -> None:
    """In every row a kernel measures each pose, and is handed what it takes today."""
    monkeypatch.setattr(narrow_rows, "POSES", 20)
    monkeypatch.setattr(narrow_rows, "DRAWN", 4000)
    monkeypatch.setattr(narrow_rows, "REPEATS", 1)
    monkeypatch.setattr(narrow_rows, "CALLS", 1)
    rows = [*narrow_rows.figures(), *hull_rows.figures()]
    assert len(rows) == len(narrow_rows.PAIRS) + 3
    assert all(math.isfinite(row.cpu) and row.cpu > 0.0 for row in rows)
    for a, b in narrow_rows.PAIRS.values():
        measure, count, depth = narrow_rows.kernel_call(a, b, *narrow_rows.touching(a, b))
        measure()
        assert (count > 0).all()
        deepest = [points.max() for points in np.split(depth[: count.sum()], np.cumsum(count)[:-1])]
        assert 0.0 < min(deepest) <= max(deepest) < narrow_rows.DEEPEST
