"""Every library world runs to its end with all it expects, and notices when one of its quantities is off."""

from __future__ import annotations

import math
import re
from collections.abc import Callable

import numpy as np
import pytest

from carom.ecs.relations.impact import Impact
from carom.systems.simulation import Simulation
from carom.tools.witness import Witness
from carom.worlds import LoadedWorld, library, load_text, load_world
from carom.worlds.expectation import Outcome

JOINTED = (
    "spring_mass",
    "door",
    "double_pendulum",
    "spinning_top",
    "slider_crank",
    "newtons_cradle",
    "robot_arm",
    "chain",
    "whip",
    "bridge",
)
WEIGHT = r"gravity: \[0, (-[\d.]+), 0\]"


def run(world: LoadedWorld, *, to_first_failure: bool = False) -> list[Outcome]:
    """Run to the end, or to the first failure, and return what became of each expectation."""
    simulation = world.simulation
    simulation.observers += world.expectations
    witness = Witness(world)
    for item in (witness, *world.expectations):
        item.begin(simulation)
    while not world.run.finished(simulation):
        if to_first_failure and not all(item.held for item in world.expectations):
            break
        simulation.step()
    for item in (*world.expectations, witness):
        item.end(simulation)
    return [item.outcome() for item in world.expectations]


@pytest.mark.parametrize("name", library.names())
def test_a_world_of_the_library_is_a_lesson(name: str) -> None:
    """It lies in the folder of its group, says in a line what is seen, and in its first comment by what law."""
    loaded = load_world(name)
    assert [group for group, names in library.groups().items() if name in names] != ["library"]
    assert loaded.name and loaded.description and loaded.expectations
    assert len(library.lesson(loaded.source_text).splitlines()) >= 3


@pytest.mark.parametrize("collision", ["auto", pytest.param("fcl", marks=pytest.mark.slow)])
@pytest.mark.parametrize("name", library.names())
def test_expectations_hold(name: str, collision: str) -> None:
    """All expectations of a library world hold, with and without kernels in the place of FCL."""
    failed = [str(outcome) for outcome in run(load_world(name, collision=collision)) if not outcome.held]
    assert failed == []


@pytest.mark.parametrize(
    ("name", "pattern", "factor", "offset"),
    [
        ("falling_ball", r"gravity: \[0, (-9), 0\]", 1.01, 0.0),
        ("bounce", WEIGHT, 1.01, 0.0),
        ("bounce", r"restitution: (0), color: brown", 1.0, 0.1),
        ("bounce", r"restitution: (0\.25)", 1.0, 0.1),
        ("bounce", r"restitution: (0\.5)", 1.0, 0.1),
        ("bounce", r"restitution: (0\.75)", 1.0, 0.1),
        ("bounce", r"restitution: (1), color: blue", 1.0, -0.1),
        ("bowling", WEIGHT, 1.01, 0.0),
        ("bowling", r"radius: 0\.109}}, body: {mass: (7)}", 1.05, 0.0),
        ("bowling", r"body: {mass: (1\.6)}", 1.05, 0.0),
        ("bowling", r"pin: {friction: 0, restitution: (0\.6)", 1.0, 0.1),
        ("bullet_holes", WEIGHT, 1.01, 0.0),
        ("bullet_holes", r"mass: (4) g", 1.05, 0.0),
        ("bullet_holes", r"material: {restitution: (0), friction: 0}", 1.0, 0.1),
        ("dominoes", WEIGHT, 1.01, 0.0),
        ("dominoes", WEIGHT, 0.99, 0.0),
        ("mirror_room", r"restitution: (1)", 1.0, -0.1),
        *[(name, WEIGHT, 1.01, 0.0) for name in ("slope", "rolling_race", "conveyor", "snapping_rope", "valleys")],
        ("rolling_race", r"mass: (1), inertia", 1.05, 0.0),
        *[("snapping_rope", rf"name: {name}, .*body: {{mass: (1)}}", 1.05, 0.0) for name in ("lost", "kept")],
        ("pong", r"restitution: (1)", 1.0, -0.1),
        ("cannon", WEIGHT, 1.01, 0.0),
        *[("cannon", rf"name: {group}_{mass}, prefab: shell, body: {{mass: ({mass})}}", 1.05, 0.0)
          for group in ("bare", "drag", "wind") for mass in (1, 2, 4)],
        ("head_on", r"elastic: {restitution: (1)", 1.0, -0.1),
        ("head_on", r"half: {restitution: (0\.5)", 1.0, 0.1),
        ("head_on", r"plastic: {restitution: (0)", 1.0, 0.1),
        *[("head_on", rf"name: {group}_right_{mass}, .*body: {{mass: ({mass})}}", 1.05, 0.0)
          for group in ("elastic", "half", "plastic") for mass in (1, 10, 1000)],
        ("jump", r"gravity: \[0, (-20), 0\]", 1.01, 0.0),
        ("jump", r"material: {restitution: (0), friction: 1}\n", 1.0, 0.1),
        ("jump", r"stone: {restitution: (0)", 1.0, 0.1),
        ("trap", WEIGHT, 1.01, 0.0),
        *[(name, WEIGHT, 1.01, 0.0) for name in ("fountain", "fireworks", "sand_storm")],
        ("fireworks", r"mass: (2) g", 1.05, 0.0),
        ("vapour_trail", r"mass: (1) g", 1.05, 0.0),
        ("sand_storm", r"size: \[1, 5, 14\]}}, life: 2 s, mass: (1) mg", 1.05, 0.0),
        ("line_of_sight", r"size: \[(1\.5), 1\.1", 1.02, 0.0),
        ("line_of_sight", r"12 s, position: \[(9), 0, -8", 1.01, 0.0),
        ("line_of_sight", r"name: sill, collider: {box: {size: \[10, (0\.6), 0\.2", 1.05, 0.0),
        ("camera_follow", r"2 s, position: \[4, 0\.9, (-4)\]", 1.01, 0.0),
        ("glider", WEIGHT, 1.01, 0.0),
        ("glider", r"mass: (1)}", 1.05, 0.0),
        ("ship_in_water", WEIGHT, 1.01, 0.0),
        ("ship_in_water", r"mass: (23370)", 1.05, 0.0),
        ("blast", WEIGHT, 1.01, 0.0),
        ("blast", r"mass: (5) kg", 1.05, 0.0),
        ("blast", r"mass: (8) kg", 1.05, 0.0),
        ("golf", WEIGHT, 1.01, 0.0),
        ("golf", r"mass: (45\.93) g", 1.05, 0.0),
        ("parachute", WEIGHT, 1.01, 0.0),
        ("parachute", r"body: {mass: (80) kg", 1.05, 0.0),
        ("orbit", r"mass: (100)\b", 1.05, 0.0),
        ("orbit", r"mass: (1)\b", 1.05, 0.0),
        ("orbit", r"constant: ([\d.]+)", 1.01, 0.0),
        ("gravity_well", r"strength: (1) m3/s2", 1.01, 0.0),
        ("binary_star", r"mass: (2)\b", 1.05, 0.0),
        ("binary_star", r"mass: (1)\b", 1.05, 0.0),
        ("binary_star", r"constant: ([\d.]+)", 1.01, 0.0),
        ("solar_system", r"sun: (1\.98841e30) kg", 1.05, 0.0),
        ("solar_system", r"G: (6\.6743e-11) m3", 1.01, 0.0),
        *[(name, WEIGHT, 1.01, 0.0) for name in JOINTED],
        *[("spring_mass", rf"mass: ({mass})", 1.05, 0.0) for mass in ("1(?=}, material)", "1(?=, gravity)", "3")],
        ("door", r"mass: (30)", 1.05, 0.0),
        ("door", r"restitution: (0\.5)", 1.0, 0.1),
        *[("double_pendulum", rf"mass: ({mass})}}", 1.05, 0.0) for mass in ("1", r"0\.6")],
        ("spinning_top", r"mass: (1),", 1.05, 0.0),
        *[("slider_crank", rf"mass: ({mass}),", 1.05, 0.0) for mass in ("3", r"0\.5", "2")],
        ("newtons_cradle", r"mass: (0\.5)", 1.05, 0.0),
        ("newtons_cradle", r"restitution: (1)", 1.0, -0.1),
        *[("chain", rf"mass: ({mass})}}\n    material: {look}", 1.05, 0.0)
          for mass, look in ((r"0\.5", "gold"), (r"0\.5", "iron"))],
        ("chain", r"mass: (50)", 1.05, 0.0),
        ("whip", r"mass: (0\.1)}\n    material", 1.05, 0.0),
        ("bridge", r"mass: (15)", 1.05, 0.0),
        ("bridge", r"mass: (60)", 1.05, 0.0),
        *[("robot_arm", rf"mass: ({mass})}}", 1.05, 0.0) for mass in (12, 4, 2, 3)],
    ],
)  # fmt: skip
def test_a_quantity_that_is_off_is_noticed(name: str, pattern: str, factor: float, offset: float) -> None:
    """Gravity off by 1 %, a mass by 5 % or a restitution by 0.1 makes an expectation fail."""
    text = library.find(name).read_text(encoding="utf-8")
    found = re.search(pattern, text)
    assert found is not None
    changed = text[: found.start(1)] + repr(float(found[1]) * factor + offset) + text[found.end(1) :]
    loaded = load_text(changed, name)
    loaded.simulation.checked = False  # what its systems touch is guarded where all holds
    assert not all(outcome.held for outcome in run(loaded, to_first_failure=True))


def test_the_blow_of_the_bowling_ball_hands_its_momentum_on() -> None:
    """In the blow's step ball and pin together lose what the lane's friction takes: 0.04 of all that bears them."""
    simulation = load_world("bowling").simulation
    step = simulation.settings.dt
    while not simulation.world.count(Impact):
        before = momentum(simulation, "ball", "pin_1")
        simulation.step()
    after = momentum(simulation, "ball", "pin_1")
    borne = after[1] - before[1] + (7.0 + 1.6) * 9.81 * step
    taken = math.hypot(*(after - before)[[0, 2]])
    assert 0.98 * 0.04 * borne < taken <= 0.04 * borne * (1.0 + 1e-9)
    assert taken < 0.003 * before[0]


def momentum(simulation: Simulation, *names: str) -> np.ndarray:
    """Return the sum of mass times velocity, kg m/s."""
    entities = [simulation[name] for name in names]
    return np.sum([entity.rigid_body.mass * entity.motion.linear for entity in entities], axis=0)


def stated(name: str, event: str) -> tuple[float, list[float]]:
    """Return time and point that a library world expects of an event."""
    for item in load_world(name).document["expect"]:
        if str(item.get("when", "")) == event:
            return item["time"]["is"], item["point"]["is"]
    raise AssertionError(f"{name} expects nothing of {event}")


def test_the_numbers_of_the_mirror_room_are_those_of_a_solution_event_by_event() -> None:
    """A thousand reflections, each at the plane met first, give the times and points of the file."""
    world = load_world("mirror_room").document
    planes = [entity["collider"]["plane"] for entity in world["entities"] if "plane" in entity["collider"]]
    ball = world["entities"][0]
    normals = np.array([plane["normal"] for plane in planes])
    normals /= np.linalg.norm(normals, axis=1)[:, None]
    offsets = np.array([plane["offset"] for plane in planes]) + ball["collider"]["sphere"]["radius"]
    position, velocity = np.array(ball["transform"]["position"]), np.array(ball["motion"]["linear"])
    time = 0.0
    for number in range(1, 1001):
        closing = -normals @ velocity
        waits = np.where(closing > 0.0, (normals @ position - offsets) / np.where(closing > 0.0, closing, 1.0), np.inf)
        first = int(np.argmin(waits))
        time, position = time + waits[first], position + velocity * waits[first]
        velocity = velocity - 2.0 * (velocity @ normals[first]) * normals[first]
        if number in (1, 10, 100, 1000):
            expected = stated("mirror_room", str({"impact": ["ball", "wall_*"], "nth": number}))
            point = position - ball["collider"]["sphere"]["radius"] * normals[first]
            np.testing.assert_allclose([time, *point], [expected[0], *expected[1]], rtol=0, atol=2e-9)


@pytest.mark.parametrize("mass", [1, 2, 4])
@pytest.mark.parametrize(
    ("group", "drag", "wind"), [("bare", 0.0, (0, 0, 0)), ("drag", 0.1, (0, 0, 0)), ("wind", 0.1, (-5, 0, 2))]
)
def test_the_numbers_of_the_cannon_are_roots_of_the_closed_forms(
    mass: int, group: str, drag: float, wind: tuple[float, ...]
) -> None:
    """Leaving the barrel and landing, found by bisection, give the times and places of the file."""
    force, gravity, rate = np.array([300.0, 400.0, 0.0]), np.array([0.0, -9.81, 0.0]), drag / mass
    lane = 2.0 * (["bare", "drag", "wind"].index(group) * 3 + [1, 2, 4].index(mass) - 4)
    start = np.array([0.0, 1.0, lane])

    def flight(begin: np.ndarray, velocity: np.ndarray, push: np.ndarray, time: float) -> tuple[np.ndarray, np.ndarray]:
        """Return position and velocity after a time of v' = push - rate v."""
        if rate == 0.0:
            return begin + velocity * time + push * time**2 / 2, velocity + push * time
        final, decay = push / rate, math.exp(-rate * time)
        return begin + final * time + (velocity - final) * (1 - decay) / rate, final + (velocity - final) * decay

    air = gravity + rate * np.array(wind)
    still = np.zeros(3)
    leave = root(lambda t: (flight(start, still, force / mass + air, t)[0] - start) @ force / 500.0 - 2.0, 1e-6, 1.0)
    muzzle = flight(start, still, force / mass + air, leave)
    land = root(lambda t: 0.1 - flight(*muzzle, air, t)[0][1], 1.0, 20.0)
    place = flight(*muzzle, air, land)[0] - [0.0, 0.1, 0.0]
    time, point = stated("cannon", str({"impact": [f"{group}_{mass}", "ground"]}))
    np.testing.assert_allclose([leave + land, *place], [time, *point], rtol=0, atol=1e-7)


def root(function: Callable[[float], float], low: float, high: float) -> float:
    """Return where an increasing function is 0, by bisection."""
    for _ in range(100):
        middle = (low + high) / 2
        low, high = (low, middle) if function(middle) > 0 else (middle, high)
    return (low + high) / 2
