"""Joints in the table: snapshots, caches, the ledger of energy, and the same bits without the JIT."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest
from heaps import hashes, jointed_heap

from carom.ecs import RigidBody, System, Transform, World, restore_snapshot, state_hash, system, take_snapshot
from carom.ecs.relations.joint_break import JointBreak
from carom.ecs.snapshot import SAVED
from carom.systems import resting
from carom.systems.chains import add_chain
from carom.systems.energy import total_energy
from carom.systems.kernels.packing import pack_bodies
from carom.systems.linkage import Linkage
from carom.systems.simulation import Simulation
from carom.systems.ties import Ties


@pytest.mark.parametrize("frame", [1, 40, 90])
def test_a_restored_snapshot_has_the_same_future(frame: int) -> None:
    """Warm starts and angles beyond a whole turn are state: here and in a fresh world not a bit differs."""
    simulation = jointed_heap(sleeping=True)
    simulation.step(frame)
    snapshot = take_snapshot(simulation.world)
    expected = hashes(simulation, 30)
    restore_snapshot(simulation.world, snapshot)
    assert hashes(simulation, 30) == expected
    elsewhere = jointed_heap(sleeping=True)
    elsewhere.step(3)
    restore_snapshot(elsewhere.world, snapshot)
    assert hashes(elsewhere, 30) == expected


def test_caches_can_be_dropped_at_any_time() -> None:
    """Groups, lanes and derived columns leave no trace in what follows."""
    kept, dropping = jointed_heap(), jointed_heap()
    for _ in range(60):
        dropping.world.add(Linkage())
        dropping.world.add(Ties())
        for kind, table in dropping.world.tables.items():
            for name, column in kind.columns.items():
                if column.role not in SAVED:
                    table.arrays[name][:] = -77 if column.dtype.kind in "if" else 0
        dropping.step()
        kept.step()
        assert state_hash(dropping.world) == state_hash(kept.world)


def test_every_joule_is_booked() -> None:
    """What joints, drives and their friction do is booked to rounding, and so is what is left when one breaks."""
    simulation = jointed_heap()
    ledger, broken = simulation.keep_ledger(), 0
    for _ in range(240):
        before = abs(total_energy(simulation.world))
        simulation.step()
        broken += simulation.world.count(JointBreak)
        rounding = 1e-13 * (before + sum(map(abs, ledger.entries.values())) + 1.0)
        assert sum(ledger.entries.values()) == pytest.approx(ledger.change, abs=rounding)
    assert broken == 1
    assert {"joints", "drives", "joint friction"} <= {name for name, work in ledger.since.items() if abs(work) > 1e-3}


@system(reads=(Transform,))
def look(world: World, dt: float) -> None:
    """Do nothing, which nobody can know."""


def swinging(*systems: System, center: tuple[float, float, float] = (0.0, 0.0, 0.0)) -> Simulation:
    """Return a chain far from anybody, of links with their centres where they are told, with further systems."""
    simulation = Simulation(dt=1.0 / 60.0)
    links = add_chain(simulation, "chain", (0.0, 0.0, 0.0), (3.0, 1.0, 0.5), 6, radius=0.04)
    with simulation.world.edit(RigidBody) as body:
        body.center_of_mass[simulation.world.slots.rows(links)] = center
    for one in systems:
        simulation.schedule = simulation.schedule.insert(one, after="settle")
    return simulation


@pytest.mark.parametrize("center", [(0.0, 0.0, 0.0), (0.01, 0.05, -0.02)])
def test_bodies_that_have_not_moved_are_not_packed_again_and_nobody_can_tell(
    center: tuple[float, float, float], monkeypatch: pytest.MonkeyPatch
) -> None:
    """With a system in the frame that might change anything all is found anew, more often, and not a bit differs."""
    packed: list[int] = []
    monkeypatch.setattr(resting, "pack_bodies", lambda *arguments: (packed.append(0), pack_bodies(*arguments))[1])
    expected, before = hashes(swinging(center=center), 60), len(packed)
    assert hashes(swinging(look, center=center), 60) == expected
    assert before < len(packed) - before == 60 * 8


def test_links_that_are_given_another_mass_have_it_at_once() -> None:
    """Though nothing has moved since they were packed: as in a world that begins there."""
    simulation, fresh = swinging(), swinging()
    simulation.step(10)
    with simulation.world.edit(RigidBody) as body:
        for name, factor in (
            ("mass", 3.0),
            ("inertia", 3.0),
            ("inverse_mass", 1.0 / 3.0),
            ("inverse_inertia", 1.0 / 3.0),
        ):
            getattr(body, name)[simulation.world.row_numbers(RigidBody)[2:4]] *= factor
    restore_snapshot(fresh.world, take_snapshot(simulation.world))
    assert hashes(simulation, 3) == hashes(fresh, 3)


def test_who_slept_on_a_joint_falls_freely_without_it() -> None:
    """By verlet's exact parabola, also while others are awake: nobody counts as held by what is no more."""
    simulation = Simulation(sleeping=True)
    ball = simulation.add(collider={"sphere": {"radius": 0.1}}, body={})
    simulation.add(
        body={"mass": 1.0, "gravity_scale": 0.0, "inertia": (1.0, 1.0, 1.0)}, motion={"linear": (1.0, 0.0, 0.0)}
    )
    rod = simulation.add(joint={"distance": {"b": ball, "anchor_a": (0.0, 1.0, 0.0)}})
    simulation.step(120)
    assert simulation[ball].motion.asleep
    before = float(simulation[ball].transform.position[1])
    simulation.world.despawn(rod)
    simulation.step(10)
    fallen = 0.5 * 9.81 * (10 / 60) ** 2
    assert simulation[ball].transform.position[1] - before == pytest.approx(-fallen, rel=1e-12)


PLAIN = """
from heaps import hashes, jointed_heap
print(*hashes(jointed_heap(), 6), sep="\\n")
"""


def test_kernels_do_the_same_without_the_jit() -> None:
    """Plain Python gives the same bits."""
    command, root = [sys.executable, "-c", PLAIN], Path(__file__).parents[2]
    environment = os.environ | {
        "NUMBA_DISABLE_JIT": "1",
        "PYTHONPATH": os.pathsep.join((str(root), str(root / "tests"))),
    }
    plain = subprocess.run(command, env=environment, cwd=root, capture_output=True, text=True, check=True)
    assert plain.stdout.split() == hashes(jointed_heap(), 6)
