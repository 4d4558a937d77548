"""Groups stay where the contact table does: they hold what new ones would, to the last bit."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from heaps import add_walls, bin_of_balls, jointed_heap, stack_of_boxes, stirred_heap

from carom.ecs import Collider, Material, Motion, RigidBody, System, World, state_hash, system
from carom.ecs.column import Floats
from carom.ecs.components.flight import Flight
from carom.ecs.relations.contact import Contact
from carom.systems import grouping
from carom.systems.constants import MOST_WIDENED
from carom.systems.detection.answered import Answered
from carom.systems.grouping import group_contacts
from carom.systems.kernels import groups as of
from carom.systems.kernels.groups import MANIFOLD_ROWS, POINT_ROWS
from carom.systems.kernels.manifolds import find_manifolds
from carom.systems.kernels.refilling import refill_groups
from carom.systems.progress import Progress
from carom.systems.rehearsal import Rehearsal
from carom.systems.resting import Resting
from carom.systems.simulation import Simulation


def heap_of_all() -> Simulation:
    """Return solids and rounds of all kinds, with one to eight points each, that spin, roll and rub as they settle."""
    simulation, random = Simulation(sleeping=False), np.random.default_rng(3)
    simulation.add(collider={"plane": {}}, material={"spinning_friction": 0.1})
    add_walls(simulation, 1.1, 4.0)
    kinds: tuple[dict[str, Any], ...] = (
        {"box": {"size": (0.4, 0.3, 0.2)}},
        {"cylinder": {"radius": 0.15, "length": 0.3}},
        {"capsule": {"radius": 0.1, "length": 0.3}},
        {"convex": {"points": [(0.2, 0.0, 0.0), (-0.1, 0.0, 0.2), (-0.1, 0.0, -0.2), (0.0, 0.3, 0.0)]}},
        {"sphere": {"radius": 0.15}},
        {"sphere": {"radius": 0.12}},
    )
    for k in range(48):
        x, z = random.uniform(-0.7, 0.7, 2)
        simulation.add(
            name=f"body{k}",
            collider=kinds[k % 6],
            body={},
            material={
                "rolling_friction": 0.02 * (k % 3),
                "spinning_friction": 0.01 * (k % 2),
                "friction": 0.3 * (k % 4),
            },
            transform={"position": (x, 0.4 + 0.25 * (k // 3), z)},
        )
    return simulation


def slab_on_a_belt() -> Simulation:
    """Return a slab that rides against a wall on a belt, two balls and a table of several colliders."""
    simulation = Simulation(sleeping=False)
    simulation.add(name="belt", collider={"box": {"size": (8.0, 1.0, 8.0)}, "surface_velocity": (1.0, 0.0, 0.0)})
    simulation.add(collider={"box": {"size": (1.0, 2.0, 8.0)}}, transform={"position": (2.0, 1.0, 0.0)})
    slab = {"box": {"size": (1.0, 0.2, 1.0)}}
    simulation.add(name="slab", collider=slab, body={}, transform={"position": (0.0, 0.6, 0.0)})
    for z in (2.0, 2.2):
        place = {"position": (1.4, 0.6, z)}
        simulation.add(name=f"ball{z}", collider={"sphere": {"radius": 0.1}}, body={}, transform=place)
    table = simulation.add(collider=slab, body={}, transform={"position": (-1.0, 1.1, -2.0)})
    for x, z in ((1, 1), (1, -1), (-1, 1), (-1, -1)):
        leg = {"box": {"size": (0.1, 0.5, 0.1)}}
        simulation.add(collider=leg, parent={"entity": table, "position": (0.4 * x, -0.35, 0.4 * z)})
    return simulation


def rows_of_balls() -> Simulation:
    """Return balls on a tray that turns, single and three in a row, of which one is all but about their centre."""
    simulation = Simulation(sleeping=False)
    tray = {"box": {"size": (6.0, 0.2, 6.0)}}
    simulation.add(collider=tray, body={"type": "kinematic"}, motion={"angular": (0.02, 0.3, 0.03)})
    ball, rough = {"sphere": {"radius": 0.2}}, {"rolling_friction": 0.3}
    for k in range(3):
        place = {"position": (0.5 * k - 0.5, 0.32, 0.0)}
        simulation.add(collider=ball, body={}, transform=place, material=rough)
        heavy = {"mass": 1.0, "center_of_mass": (0.1 + 0.2, 0.27, 0.13)}  # which is not 0.3
        row = simulation.add(body=heavy, transform={"position": (0.7 * k - 0.8, 0.1, 0.5 + k)})
        for x in (0.1, 0.3, 0.5):
            simulation.add(collider=ball, parent={"entity": row, "position": (x, 0.27, 0.13)}, material=rough)
    return simulation


def ball_that_runs_on_another() -> Simulation:
    """Return two balls, of which the upper one's surface runs along the line between them until they are pushed."""
    simulation = Simulation(sleeping=False)
    simulation.add(collider={"plane": {}})
    simulation.add(collider={"sphere": {"radius": 0.5}}, body={}, transform={"position": (0.0, 0.5, 0.0)})
    runs = {"sphere": {"radius": 0.5}, "surface_velocity": (0.0, 1.0, 0.0)}
    simulation.add(collider=runs, body={}, transform={"position": (0.0, 1.5, 0.0)})
    simulation.add(
        collider={"box": {"size": (1.0, 0.4, 1.0)}},
        body={"type": "kinematic"},
        transform={"position": (-1.1, 0.5, 0.0)},
        motion={"linear": (0.1, 0.0, 0.0)},
    )
    return simulation


Edit = Callable[[World], object]
HEAPS: dict[str, tuple[Callable[[], Simulation], int, int]] = {  # with so many steps, in so many of which groups stay
    "all kinds": (heap_of_all, 300, 30),
    "balls": (lambda: bin_of_balls(60, sleeping=False), 360, 60),
    "boxes": (lambda: stack_of_boxes(sleeping=False), 120, 60),
    "a paddle": (lambda: stirred_heap(sleeping=False), 120, 0),
    "joints": (lambda: jointed_heap(sleeping=False), 240, 20),
    "a belt": (slab_on_a_belt, 240, 0),
    "a tray": (rows_of_balls, 120, 20),
    "a ball on a ball": (ball_that_runs_on_another, 120, 0),
}


@pytest.fixture
def stays(monkeypatch: pytest.MonkeyPatch) -> list[int]:
    """Return a list that grows by one whenever groups stay."""
    found: list[int] = []

    def count(*arguments: Any) -> None:
        refill_groups(*arguments)
        found.append(1)

    monkeypatch.setattr(grouping, "refill_groups", count)
    monkeypatch.setattr(Rehearsal, "due", False)  # whose groups are others
    return found


@pytest.mark.parametrize("heap", HEAPS)
def test_groups_that_stay_hold_what_new_ones_would(heap: str, stays: list[int]) -> None:
    """But for where even balls are, which is measured before anybody asks, where all rest as when they were grouped."""
    make, steps, least = HEAPS[heap]
    simulation, looked = make(), 0
    world, resting = simulation.world, simulation.world[Resting]
    whole = ("asks", "index_a", "index_b", "first", "size", "points", "row")

    def held() -> dict[str, Any]:
        now = slice(resting.groups)
        lanes = resting.lanes.copy()
        for r in resting.row[now][resting.even[now]]:
            lanes[r + of.NORMAL : r + of.NORMAL + 3] = lanes[r + MANIFOLD_ROWS + of.DEPTH] = 0.0
        lanes[resting.row[now] + of.RESTS] = 0.0
        return {"lanes": lanes, "ends": +resting.ends} | {name: +getattr(resting, name)[now] for name in whole}

    def look(system: System) -> None:
        nonlocal looked
        if system.name == "find_contacts" and len(stays) > before:
            with world.faces(None):
                contact = world[Contact]
                first = resting.first[: resting.groups]
                rests = contact.resting[first] & (first >= 0)
                assert (resting.lanes[resting.row[: resting.groups] + of.RESTS] == rests).all()
                kept, looked = held(), looked + 1
                group_contacts(world, places=True, same=False)
                for name, values in held().items():
                    assert values.tobytes() == kept[name].tobytes(), name
                group_contacts(world, places=True, same=True)

    simulation.hearers.append(look)
    for _ in range(steps):
        before = len(stays)
        spoil(resting)
        simulation.step()
    assert looked >= least


def spoil(resting: Resting) -> None:
    """Write nonsense where groups hold sums that have been handed over, and what is found anew in each step."""
    lanes, now = resting.lanes, slice(resting.groups)
    for r, points, even, size in zip(
        resting.row[now], resting.points[now], resting.even[now], resting.size[now], strict=True
    ):
        rows = [of.RESTS, of.RUBBED, of.RUBBED + 1, of.RUBBED + 2] + ([] if even else [of.PART, of.BESIDE])
        lanes[[r + row for row in rows]] = 7.0
        for p in range(points):
            lanes[r + MANIFOLD_ROWS + POINT_ROWS * p + of.SUM] = 7.0
            lanes[r + MANIFOLD_ROWS + POINT_ROWS * p + of.WARM, size <= p] = 7.0


def hashes(make: Callable[[], Simulation], steps: int, edit: Edit) -> list[str]:
    """Return the state hash after each step, with an edit before the last twenty of them."""
    simulation, found = make(), []
    for step in range(steps):
        if step == steps - 20:
            edit(simulation.world)
        simulation.step()
        found.append(state_hash(simulation.world))
    return found


def write(world: World, kind: type[Any], name: str, column: str, value: Any) -> None:
    """Write one value of an entity as code outside does."""
    with world.edit(kind) as columns:
        getattr(columns, column)[world.row(world.find(name))] = value


EDITS: dict[str, Edit] = {
    "friction": lambda world: write(world, Material, "body3", "friction", 0.9),
    "restitution": lambda world: write(world, Material, "body4", "restitution", 0.9),
    "rolling friction": lambda world: write(world, Material, "body1", "rolling_friction", 0.5),
    "belt": lambda world: write(world, Collider, "body0", "surface_velocity", (0.5, 0.0, 0.0)),
    "size": lambda world: write(world, Collider, "body10", "size", (0.14, 0, 0, 0)),
    "mass": lambda world: write(world, RigidBody, "body6", "inverse_mass", 0.1),
    "velocity": lambda world: write(world, Motion, "body7", "linear", (0.0, 2.0, 0.0)),
    "somebody goes": lambda world: world.despawn(world.find("body5")),
}


@pytest.mark.parametrize(
    ("heap", "edit"),
    [(heap, "nothing") for heap in HEAPS] + [("all kinds", edit) for edit in EDITS],
)
def test_no_bit_depends_on_whether_groups_stay(
    heap: str, edit: str, stays: list[int], monkeypatch: pytest.MonkeyPatch
) -> None:
    """Also where a shape, a material or a body becomes another after groups have stayed."""
    (make, steps, least), change = HEAPS[heap], EDITS.get(edit, lambda world: None)
    with monkeypatch.context() as forgetful:
        forgetful.setattr(Resting, "knows", lambda resting, world: False)
        expected = hashes(make, steps, change)
    assert not stays
    assert hashes(make, steps, change) == expected
    assert len(stays) >= least


def test_systems_of_others_may_change_anything() -> None:
    """One that makes all slippery in the middle of a step is heard of where so many leave that all is detected anew."""

    @system(reads=(Progress,), writes=(Material, Flight))
    def oil(world: World, dt: float) -> None:
        if world.frame == 11 and world[Progress].substep == 3:
            world[Material].friction[:] = 0.0
            world[Flight].reach[:] = 0.0

    simulation = Simulation(sleeping=False)
    simulation.add(collider={"plane": {}})
    for k in range(2 * MOST_WIDENED):
        place, ball = {"position": (1.0 * (k % 10), 0.1, 1.0 * (k // 10))}, {"sphere": {"radius": 0.1}}
        motion = {"linear": (0.1, 0.0, 0.0), "angular": (0.0, 0.0, -1.0)}
        simulation.add(collider=ball, body={}, transform=place, motion=motion)
    simulation.schedule = simulation.schedule.insert(oil, before="look_ahead")
    contact, answered = simulation.world[Contact], simulation.world[Answered]
    simulation.step(10)
    assert (contact.friction[: contact.count] == 0.5).all()
    before = answered.detections
    simulation.step()
    assert answered.detections == before + 2
    assert (contact.friction[: contact.count] == 0.0).all()


def test_a_material_that_is_edited_counts_from_the_next_step_on(stays: list[int]) -> None:
    """A box that stands on a slope of 20 degrees slides as soon as friction is 0.1."""
    simulation = Simulation(sleeping=False)
    slope = np.radians(20.0)
    turn = (0.0, 0.0, float(np.sin(slope / 2)), float(np.cos(slope / 2)))
    simulation.add(collider={"box": {"size": (20.0, 1.0, 2.0)}}, transform={"rotation": turn})
    up = np.array([-np.sin(slope), np.cos(slope), 0.0])
    place = {"position": tuple(up), "rotation": turn}
    simulation.add(name="box", collider={"box": {"size": (1.0, 1.0, 1.0)}}, body={}, transform=place)
    simulation.step(60)
    assert len(stays) > 50
    assert abs(simulation.world[Motion].linear).max() < 1e-3
    write(simulation.world, Material, "box", "friction", 0.02)
    write(simulation.world, Motion, "box", "linear", (0.0, 0.0, 0.0))
    simulation.step(60)
    row, friction = simulation.world.row(simulation.world.find("box")), np.sqrt(0.5 * 0.02)
    speed = 9.81 * (np.sin(slope) - friction * np.cos(slope)) * 1.0
    assert float(np.hypot(*simulation.world[Motion].linear[row, :2])) == pytest.approx(speed, rel=1e-3)


def test_manifolds_stay_where_the_same_points_begin_them() -> None:
    """Not where planes part or come together, nor where one comes to rest."""
    row_a, row_b, body, kind = np.zeros(3, np.int64), np.ones(3, np.int64), np.full(3, -1), np.full(3, -1)
    level, steep = np.tile([0.0, 1.0, 0.0], (3, 1)), np.array([[0.0, 1.0, 0.0], [0.0, 1.0, 0.0], [1.0, 0.0, 0.0]])
    resting, start, grouped = np.zeros(3, np.bool_), np.zeros(4, np.int64), np.zeros(3, np.bool_)

    def found(normal: Floats) -> tuple[int, bool]:
        number, *_, stay, few = find_manifolds(3, row_a, row_b, body, body, kind, normal, resting, grouped, start)
        return number, stay and few

    assert [found(steep), found(steep), found(level), found(level), found(steep)] == [
        (2, False), (2, True), (1, False), (1, True), (2, False)
    ]  # fmt: skip
    resting[2] = True
    assert found(steep) == (2, False)
    grouped[2] = True  # once it has been put into a group
    assert found(steep) == (2, True)
