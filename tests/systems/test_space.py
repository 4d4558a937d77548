"""What queries see: where everything is now, through filters; and what they refuse."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np
import pytest

from carom.ecs import (
    AccessError,
    DeclarationError,
    EntityError,
    RigidBody,
    Transform,
    World,
    state_hash,
    system,
)
from carom.ecs.spatial import quaternion
from carom.systems.queries.arguments import QueryError
from carom.systems.queries.space import ASKED, Space
from carom.systems.shapes import BY_NUMBER, SHAPES, Shape
from carom.systems.shapes.shape import Bounds, MassProperties, Surface, parameter
from carom.systems.simulation import Simulation

BALL: dict[str, Any] = {"sphere": {"radius": 0.5}}
DOWN = (0.0, -1.0, 0.0)


def met(simulation: Simulation, x: float, **filters: Any) -> str | None:
    """Return the name of the collider that a ray straight down at x meets first."""
    hit = simulation.space.cast_ray((x, 50.0, 0.0), DOWN, **filters)
    return None if hit is None else simulation.world.name(hit.collider)


def test_a_world_is_asked_before_its_first_step_and_after_edits() -> None:
    """Bodies are where they are now, carried ones where those who carry them are now."""
    simulation = Simulation()
    body = simulation.add(name="body", collider=BALL, body={}, transform={"position": (1.0, 2.0, 0.0)})
    part = simulation.add(name="part", collider=BALL, parent={"entity": body, "position": (3.0, 0.0, 0.0)})
    assert [met(simulation, x) for x in (0.0, 1.0, 4.0)] == [None, "body", "part"]
    simulation.world[body].transform.position = (11.0, 2.0, 0.0)
    simulation.world[body].transform.rotation = quaternion.from_axis_angle((0.0, 0.0, 1.0), np.pi)
    assert [met(simulation, x) for x in (1.0, 4.0, 8.0, 11.0)] == [None, None, "part", "body"]
    simulation.step(5)
    hit = simulation.space.cast_ray((8.0, 50.0, 0.0), DOWN)
    assert hit is not None
    assert hit.collider == part
    assert hit.entity == body
    assert hit.point[1] == pytest.approx(simulation.world[body].transform.position[1] + 0.5, abs=1e-12)
    simulation.world.despawn(part)
    assert met(simulation, 8.0) is None
    simulation.world[body].collider.size = (2.0, 0.0, 0.0, 0.0)
    simulation.world[body].collider.bound_radius = 2.0
    assert met(simulation, 12.9) == "body"


def test_asking_changes_nothing() -> None:
    """The same state, to the bit, with and without, now and later; carried entities are not moved either."""
    hashes = []
    for asks in (False, True):
        simulation = Simulation()
        simulation.add(collider={"plane": {}})
        body = simulation.add(name="body", collider=BALL, body={}, transform={"position": (0.0, 2.0, 0.0)})
        simulation.add(collider=BALL, parent={"entity": body, "position": (1.0, 0.0, 0.0)})
        simulation.step(3)
        simulation.world[body].transform.position = (5.0, 2.0, 0.0)
        for _ in range(20):
            if asks:
                simulation.space.cast_rays(np.full((5, 3), 9.0), DOWN)
            hashes.append(state_hash(simulation.world))
            simulation.step()
    assert hashes[:20] == hashes[20:]


def test_filters() -> None:
    """Layers by name, only some entities, without others; sensors where asked for, layer none never."""
    simulation = Simulation()
    simulation.layers({"high": None, "low": None})
    for name, y, words in (
        ("ghost", 9.0, {**BALL, "layer": "none"}),
        ("trigger", 8.0, {**BALL, "sensor": True}),
        ("top", 6.0, {**BALL, "layer": "high"}),
        ("middle", 4.0, {**BALL, "layer": "low"}),
        ("bottom", 2.0, BALL),
    ):
        simulation.add(name=name, collider=words, transform={"position": (0.0, y, 0.0)})
    named = {name: simulation.world.find(name) for name in ("trigger", "top", "middle", "bottom")}
    assert met(simulation, 0.0) == "top"
    assert met(simulation, 0.0, sensors=True) == "trigger"
    assert met(simulation, 0.0, layers="low") == "middle"
    assert met(simulation, 0.0, layers=["low", "default"]) == "middle"
    assert met(simulation, 0.0, layers="none") is None
    assert met(simulation, 0.0, only=named["bottom"]) == "bottom"
    assert met(simulation, 0.0, only=[named["bottom"], named["middle"]]) == "middle"
    assert met(simulation, 0.0, only=[]) is None
    assert met(simulation, 0.0, without=named["top"]) == "middle"
    assert met(simulation, 0.0, without=np.array([named["top"], named["middle"]])) == "bottom"
    assert met(simulation, 0.0, only=named["trigger"]) is None
    assert met(simulation, 0.0, only=named["trigger"], sensors=True) == "trigger"
    with pytest.raises(DeclarationError, match=r"^unknown layer 'hgh'; did you mean 'high'\?$"):
        simulation.space.cast_ray((0.0, 9.0, 0.0), DOWN, layers="hgh")
    simulation.world.despawn(named["top"])
    with pytest.raises(EntityError, match=r"^entity 2, generation 0, was despawned in frame 0$"):
        simulation.space.cast_ray((0.0, 9.0, 0.0), DOWN, without=named["top"])


def test_a_body_stands_for_all_that_belong_to_it() -> None:
    """A player's rays leave out the player; a part alone may be left out too."""
    simulation = Simulation()
    body = simulation.add(name="body", collider=BALL, body={}, transform={"position": (0.0, 2.0, 0.0)})
    part = simulation.add(name="part", collider=BALL, parent={"entity": body, "position": (0.0, 3.0, 0.0)})
    assert met(simulation, 0.0) == "part"
    assert met(simulation, 0.0, without=part) == "body"
    assert met(simulation, 0.0, without=body) is None
    assert met(simulation, 0.0, only=body) == "part"
    assert met(simulation, 0.0, only=part) == "part"


def test_empty_batches_and_empty_worlds() -> None:
    """No rays are no hits, and of nothing there is nothing to meet."""
    simulation = Simulation()
    assert simulation.space.cast_ray((0.0, 0.0, 0.0), DOWN) is None
    assert simulation.space.cast_rays(np.zeros((0, 3)), DOWN).entity.shape == (0,)
    simulation.add(collider=BALL)
    assert simulation.space.cast_rays_all(np.zeros((0, 3)), np.zeros((0, 3))).ray.shape == (0,)
    assert simulation.space.cast_rays_any(np.zeros((2, 3)), DOWN).tolist() == [True, True]


def test_who_is_nowhere_is_met_by_nothing() -> None:
    """A collider whose position is no number hides nobody else."""
    simulation = Simulation()
    lost = simulation.add(name="lost", collider=BALL)
    simulation.add(name="there", collider=BALL)
    simulation.world[lost].transform.position = (np.nan, 0.0, 0.0)
    assert met(simulation, 0.0) == "there"


@pytest.mark.parametrize(
    ("arguments", "told"),
    [
        (
            ([(0.0, np.nan, 0.0), (0.0, 0.0, 0.0)], [(0.0, 0.0, 0.0), (0.0, 0.0, 0.0)], [1.0, -2.0]),
            [
                "cast_rays: origins: must be finite and at most 1e+100, received [0.0, nan, 0.0] in row 0",
                "cast_rays: directions: must have a direction, received a zero vector in rows 0, 1",
                "cast_rays: reach: must be 0 m or more, received -2.0 in row 1",
            ],
        ),
        (
            (np.zeros((9, 3)), np.full((9, 3), np.inf), np.nan),
            [
                "cast_rays: directions: must be finite, received [inf, inf, inf] in rows 0, 1, 2, 3, 4 and 4 more",
                "cast_rays: reach: must be 0 m or more, received nan in row 0",
            ],
        ),
        (
            (np.zeros((4, 2)), [(0.0, 1.0, 0.0), (1.0,)], "far"),
            [
                "cast_rays: origins: must have the shape (n, 3), received (4, 2)",
                "cast_rays: directions: must be numbers (n, 3), received [(0.0, 1.0, 0.0), (1.0,)]",
                "cast_rays: reach: must be numbers (n,), received 'far'",
            ],
        ),
        (
            (np.zeros((4, 3)), np.ones((3, 3))),
            [
                "cast_rays: rows: must be as many of each, or one for all, received 4, 3, 1",
            ],
        ),
    ],
)
def test_every_fault_is_told_at_once(arguments: tuple[Any, ...], told: list[str]) -> None:
    """What is wrong, in which rows, and what is accepted."""
    simulation = Simulation()
    simulation.add(collider=BALL)
    with pytest.raises(QueryError) as fault:
        simulation.space.cast_rays(*arguments)
    assert str(fault.value).splitlines() == told


def test_a_system_asks_in_checked_mode() -> None:
    """It declares what asking reads; whoever forgets is told by name."""
    heights: list[float] = []

    def feel(world: World, dt: float) -> None:
        """Feel how far the ground is below."""
        for row in world.row_numbers(RigidBody):
            hit = Space(world).cast_ray(world[Transform].position[row], DOWN, without=world.entity(row))
            assert hit is not None
            heights.append(hit.distance)
            Space(world).closest_points(world[Transform].position[row])
            Space(world).cast_shapes(BALL, world[Transform].position[row], DOWN, without=world.entity(row))

    simulation = Simulation(checked=True)
    simulation.add(collider={"plane": {}})
    simulation.add(collider=BALL, body={}, transform={"position": (0.0, 2.0, 0.0)})
    simulation.schedule = simulation.schedule.insert(system(reads=(RigidBody, *ASKED))(feel), after="begin_step")
    simulation.step(2)
    assert heights[0] == 2.0 > heights[1]
    forgetful = Simulation(checked=True)
    forgetful.add(collider=BALL, body={})
    forgetful.schedule = forgetful.schedule.insert(system(reads=(RigidBody, Transform))(feel), after="begin_step")
    with pytest.raises(AccessError, match=r"^system 'feel' touches Scene but declares only"):
        forgetful.step()


def test_shapes_of_extensions_are_met_as_they_are_drawn() -> None:
    """A ring of an extension's own: its triangles are met, its hole is not."""

    @dataclass(frozen=True)
    class Ring(Shape):
        """A ring."""

        key: ClassVar[str] = "ring_of_this_test"
        radius: float = parameter(unit="m", doc="radius of its middle", above=0.0)

        def mass_properties(self) -> MassProperties:
            return MassProperties(1.0, (0.0, 0.0, 0.0), (1.0, 1.0, 1.0), (0.0, 0.0, 0.0, 1.0))

        def bounds(self) -> Bounds:
            return Bounds((0.0, 0.0, 0.0), (1.5 * self.radius, 0.5 * self.radius, 1.5 * self.radius), 0.0)

        def support(self, directions: Any) -> Any:
            return np.asarray(directions)

        def fcl_geometry(self, margin: float = 0.0) -> Any:
            return None

        def surface(self) -> Surface:
            from trimesh.creation import torus

            ring = torus(self.radius, 0.25 * self.radius)
            return Surface(np.array(ring.vertices)[:, [0, 2, 1]], np.array(ring.faces)[:, ::-1], True)

    try:
        simulation = Simulation()
        for x, radius in ((0.0, 1.0), (9.0, 2.0), (20.0, 2.0)):
            simulation.add(name=f"at {x}", collider={"shape": Ring(radius)}, transform={"position": (x, 0.0, 0.0)})
        places = (0.0, 1.0, 9.0, 10.0, 11.0, 20.0, 22.0)
        assert [met(simulation, x) for x in places] == [None, "at 0.0", None, None, "at 9.0", None, "at 20.0"]
        hit = simulation.space.cast_shape(BALL, (0.0, 50.0, 0.0), DOWN)
        assert hit is None
        hit = simulation.space.cast_shape({"sphere": {"radius": 1.0}}, (0.0, 50.0, 0.0), DOWN)
        assert hit is not None
        assert hit.distance == pytest.approx(50.0 - np.sqrt(1.25**2 - 1.0), abs=0.02)  # the ring has corners
    finally:
        del SHAPES["ring_of_this_test"], BY_NUMBER[Ring.number]
