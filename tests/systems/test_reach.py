"""Laws that act on some only: regions, layers and time windows."""

from __future__ import annotations

import numpy as np
import pytest

from carom.ecs import Motion, restore_snapshot, state_hash, take_snapshot
from carom.ecs.errors import DeclarationError
from carom.systems.energy import potential_energy, total_energy
from carom.systems.forces.region import BoxRegion, Region, SphereRegion
from carom.systems.free_body import applied
from carom.systems.simulation import Simulation

BALL = {"sphere": {"radius": 0.1}}
STILL = {"dt": 1 / 240, "gravity": (0.0, 0.0, 0.0)}


def balls(*places: tuple[float, float, float], **settings: object) -> tuple[Simulation, list[int]]:
    """Return balls of 1 kg that rest in a world without gravity."""
    simulation = Simulation(**{**STILL, **settings})
    made = [simulation.add(collider=BALL, body={"mass": 1.0}, transform={"position": place}) for place in places]
    return simulation, made


def speeds(simulation: Simulation, entities: list[int]) -> list[float]:
    """Return how fast each goes along x."""
    return [float(simulation[entity].motion.linear[0]) for entity in entities]


def test_regions_hold_their_borders() -> None:
    """Faces and surfaces belong to them; a point is in or out whatever others there are."""
    box = Region(box=BoxRegion((2.0, 4.0, 6.0), (1.0, 0.0, 0.0)))
    sphere = Region(sphere=SphereRegion(5.0, (0.0, 1.0, 0.0)))
    points = np.array([[2, 2, 3], [2, 2, -3.001], [-0.001, 0, 0], [3, 1, 4], [3, 1, 4.001], [0, 6, 0]], np.float64)
    assert box.contains(points).tolist() == [True, False, False, False, False, False]
    assert sphere.contains(points).tolist() == [True, True, True, True, False, True]
    assert [bool(sphere.contains(point[None])[0]) for point in points] == sphere.contains(points).tolist()


def test_a_law_acts_where_its_region_is() -> None:
    """Decided by centres of mass in every substep: who flies through is pushed on the way within."""
    simulation, (inside, outside, passing) = balls((0.0, 0.0, 0.0), (0.0, 0.0, 1.5), (-3.0, 0.0, 0.0))
    simulation[passing].motion.linear = (4.0, 0.0, 0.0)
    simulation.force("constant_push", force=(0.0, 2.0, 0.0), region={"box": {"size": (2.0, 9.0, 2.0)}})
    simulation.step(240)
    assert simulation[inside].motion.linear == pytest.approx((0.0, 2.0, 0.0), abs=1e-12)
    assert simulation[outside].motion.linear.tolist() == [0.0, 0.0, 0.0]
    assert simulation[passing].motion.linear == pytest.approx((4.0, 2.0 * 2.0 / 4.0, 0.0), abs=2.0 / 960)


def test_a_law_acts_on_its_layers() -> None:
    """The collider may be one that the body carries; none is a layer too, which nobody meets."""
    simulation = Simulation(**STILL)
    simulation.layers({"leaf": None, "stone": None})
    leaf, stone, ghost = (
        simulation.add(collider=BALL | {"layer": layer}, body={"mass": 1.0}, transform={"position": (0.0, place, 0.0)})
        for place, layer in enumerate(("leaf", "stone", "none"))
    )
    tree = simulation.add(name="tree", body={"mass": 1.0}, transform={"position": (0.0, 5.0, 0.0)})
    simulation.add(collider=BALL | {"layer": "leaf"}, parent={"entity": tree, "position": (0.0, 0.5, 0.0)})
    simulation.force("constant_push", force=(1.0, 0.0, 0.0), layers=["leaf"])
    simulation.force("constant_push", force=(2.0, 0.0, 0.0), layers=["stone", "none"])
    simulation.step(240)
    assert speeds(simulation, [leaf, stone, ghost, tree]) == pytest.approx([1.0, 2.0, 2.0, 1.0], abs=1e-12)


@pytest.mark.parametrize("integrator", ["euler", "semi_implicit", "verlet"])
def test_a_window_gives_force_times_its_length(integrator: str) -> None:
    """A push from 0.5 s to 2 s, and one from 1 s on, give momenta to rounding: their times are those of substeps."""
    simulation, (ball,) = balls((0.0, 0.0, 0.0), integrator=integrator)
    simulation.force("constant_push", force=(2.0, 0.0, 0.0), during=(0.5, 2))
    simulation.force("constant_push", force=(0.0, 3.0, 0.0), during=(1.0, "end"))
    simulation.step(120)
    assert simulation[ball].motion.linear.tolist() == [0.0, 0.0, 0.0]
    simulation.step(480)
    assert simulation[ball].motion.linear == pytest.approx((3.0, 4.5, 0.0), abs=1e-12)


@pytest.mark.parametrize("during", [(1.0, 2.0), (0.1, 1.3)])
def test_who_sleeps_wakes_when_a_window_begins_or_ends(during: tuple[float, float]) -> None:
    """A box that sleeps on the ground feels 3 N come and go, which friction holds, and slides by 6 N."""
    runs = []
    for sleeping in (True, False):
        simulation = Simulation(dt=1 / 60, sleeping=sleeping)
        simulation.add(collider={"plane": {}}, material={"friction": 0.5})
        box = simulation.add(
            collider={"box": {"size": (1.0, 1.0, 1.0)}}, body={"mass": 1.0}, transform={"position": (0.0, 0.5, 0.0)}
        )
        simulation.force("constant_push", force=(3.0, 0.0, 0.0), during=during)
        simulation.force("constant_push", force=(6.0, 0.0, 0.0), during=(during[1] + 1.0, "end"))
        slept = []
        for _ in range(round(60 * (during[1] + 2.0))):
            simulation.step()
            slept.append(bool(simulation.world[Motion].asleep[simulation.world.row(box)]))
        runs.append(float(simulation[box].transform.position[0]))
        assert slept[round(60 * during[0]) - 2] is (sleeping and during[0] > 0.5)
        assert not slept[round(60 * (during[1] + 1.0))]
    assert runs[0] > 0.3
    assert runs[0] == pytest.approx(runs[1], abs=1e-6)


def test_it_is_no_state() -> None:
    """A world that is restored in the middle of a window and of a region goes on to the same bits."""
    simulation, _ = balls((-0.4, 0.0, 0.0), (0.0, 1.0, 0.0))
    simulation.force("constant_push", force=(5.0, 0.0, 0.0), region={"sphere": {"radius": 0.6}}, during=(0.1, 0.3))
    simulation.force("linear_drag", coefficient=0.5)
    simulation.step(30)
    kept = take_snapshot(simulation.world)
    simulation.step(120)
    reached = state_hash(simulation.world)
    restore_snapshot(simulation.world, kept)
    simulation.step(120)
    assert state_hash(simulation.world) == reached


def test_what_is_limited_holds_no_energy_but_the_ledger_knows_what_it_gave() -> None:
    """A well in a region or a window has no potential energy; what it did to bodies is booked under its name."""
    simulation, (ball,) = balls((2.0, 0.0, 0.0))
    simulation.force("gravity_well", strength=1.0, radius=0.5, region={"sphere": {"radius": 1.9}}, during=(0.0, 2.0))
    simulation[ball].motion.linear = (-1.0, 0.0, 0.0)
    ledger = simulation.keep_ledger()
    before = total_energy(simulation.world)
    simulation.step(240)
    assert potential_energy(simulation.world) == 0.0
    gained = total_energy(simulation.world) - before
    assert gained > 0.1
    assert ledger.since["gravity_well"] == pytest.approx(gained, rel=1e-3)
    assert sum(ledger.since.values()) == pytest.approx(gained, rel=1e-12)


def test_layers_hold_energy_as_entities_do() -> None:
    """Bodies do not change their layer on their way, so that what a well holds stays theirs."""
    simulation = Simulation(**STILL)
    simulation.layers({"ship": None})
    for layer, place in (("ship", 1.0), ("default", -1.0)):
        simulation.add(collider=BALL | {"layer": layer}, body={"mass": 2.0}, transform={"position": (place, 0.0, 0.0)})
    simulation.force("gravity_well", strength=3.0, layers=["ship"])
    assert potential_energy(simulation.world) == pytest.approx(-6.0, rel=1e-12)


def test_the_list_of_forces_on_a_body_shows_those_that_act_now() -> None:
    """At 0 s the first push acts, at 1 s the second, each on who is in its region; looking changes no bit."""
    runs = []
    for looks in (True, False):
        simulation, (inside, _) = balls((0.0, 0.0, 0.0), (5.0, 0.0, 0.0))
        for force, during in ((1.0, (0.0, 1.0)), (-1.0, (1.0, "end"))):
            simulation.force(
                "constant_push", force=(force, 0.0, 0.0), region={"sphere": {"radius": 2.0}}, during=during
            )
        seen = []
        for steps in (0, 240):
            simulation.step(steps)
            if looks:
                found = next(part for part in applied(simulation) if "constant push" in part.name)
                seen.append(found.force[:, 0].tolist())
        simulation.step(60)
        runs.append(state_hash(simulation.world))
        assert seen == ([[1.0, 0.0], [-1.0, 0.0]] if looks else [])
        assert float(simulation[inside].motion.linear[0]) == pytest.approx(0.75, abs=1e-12)
    assert runs[0] == runs[1]


@pytest.mark.parametrize(
    ("words", "fault"),
    [
        ({"region": {}}, "region: must state exactly one shape, box or sphere"),
        (
            {"region": {"sphere": {"radius": -1.0}}},
            "region.sphere.radius: must be finite and above 0 m, received -1",
        ),
        (
            {"region": {"box": {"size": (1.0, 0.0, 1.0)}}, "layers": ["laef"]},
            ("region.box.size: must be finite and above 0 m, received 0; layers.0: unknown layer; received 'laef'; "
            "accepted: none, default, leaf; did you mean 'leaf'?"),
        ),
        (
            {"region": {"ball": {}}},
            "region.ball: unknown key; received 'ball'; accepted: box, sphere",
        ),
        (
            {"during": (2.0, 1.0)},
            ("during: must start at 0 s or later and end after that; received (2.0, 1.0); "
            "accepted: (0.5, 2) in s, or (0.5, 'end') for good"),
        ),
        (
            {"during": 2.0},
            "during: is no time window; received 2.0; accepted: (0.5, 2) in s, or (0.5, 'end') for good",
        ),
    ],
)  # fmt: skip
def test_what_makes_no_sense_is_refused_and_adds_nothing(words: dict[str, object], fault: str) -> None:
    """Everything that is wrong at once, where it is, and what would be right."""
    simulation = Simulation()
    simulation.layers({"leaf": None})
    with pytest.raises(DeclarationError) as caught:
        simulation.force("wind", velocity=(1.0, 0.0, 0.0), **words)
    assert str(caught.value) == fault
