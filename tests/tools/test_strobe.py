"""Stroboscopic pictures show a motion at every instant, later ones in front only where they are nearer."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from carom.systems.observer import observed
from carom.systems.simulation import Simulation
from carom.tools.cameras import Camera
from carom.tools.filming import Shot
from carom.tools.moments import every
from carom.tools.renderer import Renderer
from carom.tools.scene import Scene
from carom.tools.strobe import STIRRED, Strobe, chosen, overlaid

CAMERA = Camera((0.0, 0.0, 20.0))
SHOT = Shot(CAMERA, 320, 240)
TOLERANCE = np.full((4, 4), STIRRED)


def passing() -> Simulation:
    """Return a cube that comes nearer as it glides to the right, one that glides to the left, and one that stands."""
    simulation = Simulation(dt=0.1, gravity=(0.0, 0.0, 0.0))
    cube = {"collider": {"box": {"size": (0.5, 0.5, 0.5)}}}
    simulation.add(
        name="right", body={}, motion={"linear": (4.0, 0.0, 1.0)}, transform={"position": (-4, 1, 0)}, **cube
    )
    simulation.add(
        name="left", body={}, motion={"linear": (-4.0, 0.0, 0.0)}, transform={"position": (4, -1, 0)}, **cube
    )
    simulation.add(name="still", body={}, transform={"position": (0, 3, 0)}, **cube)
    return simulation


def instants(simulation: Simulation, count: int, steps: int) -> list[list]:
    """Return what is seen at so many instants, so many steps apart."""
    scene = Scene(simulation.world)
    found = [scene.batches()]
    for _ in range(count - 1):
        simulation.step(steps)
        found.append(scene.batches())
    return found


def test_what_moves_is_there_at_every_instant_and_what_stands_once() -> None:
    """All in one batch, at x = x0 + v t, the latest in its own colour, the others the paler the earlier they were."""
    simulation = passing()
    (batch,) = overlaid(instants(simulation, 5, 5), chosen(simulation.world, None), TOLERANCE)
    for name, start, speed in (("right", -4.0, 4.0), ("left", 4.0, -4.0)):
        own = np.nonzero(batch.ids == simulation.world.row(simulation.world.find(name)))[0]
        np.testing.assert_allclose(batch.poses[own, 0, 3], start + speed * np.arange(4, -1, -1) * 0.5, atol=1e-12)
        assert (np.diff(batch.colors[own, :3].min(axis=1)) > 0.02).all()
        assert (batch.colors[own, 3] == 1.0).all()
    assert (batch.ids == simulation.world.row(simulation.world.find("still"))).sum() == 1


def test_all_parts_of_a_body_leave_traces() -> None:
    """Of what is drawn as two meshes, both are there at every instant."""
    simulation = passing()
    parts = [[*seen, replace(seen[0], vertices=seen[0].vertices.copy())] for seen in instants(simulation, 5, 5)]
    for one in parts[1:]:
        one[1] = replace(one[1], vertices=parts[0][1].vertices)
    batches = overlaid(parts, chosen(simulation.world, None), TOLERANCE)
    assert [len(batch.ids) for batch in batches] == [11, 11]


def test_chosen_bodies_alone_leave_traces() -> None:
    """The others are where they are in the end."""
    simulation = passing()
    seen = instants(simulation, 4, 3)
    (batch,) = overlaid(seen, chosen(simulation.world, [simulation.world.find("left")]), TOLERANCE)
    counts = {
        name: int((batch.ids == simulation.world.row(simulation.world.find(name))).sum())
        for name in ("left", "right", "still")
    }
    assert counts == {"left": 4, "right": 1, "still": 1}


def test_a_chosen_body_moves_with_all_it_carries() -> None:
    """Parts of a body and what is fixed to it are chosen with it."""
    simulation = Simulation(dt=0.1, gravity=(0.0, 0.0, 0.0))
    hull = {"collider": {"box": {"size": (1, 1, 1)}}}
    ship = simulation.add(name="ship", body={}, motion={"linear": (5.0, 0.0, 0.0)}, **hull)
    simulation.add(name="mast", parent={"entity": ship, "position": (0, 1, 0)}, collider={"sphere": {"radius": 0.3}})
    simulation.add(name="rock", **hull)
    rows = np.nonzero(chosen(simulation.world, [ship]))[0]
    assert {simulation.world.name(simulation.world.entity(row)) for row in rows} == {"ship", "mast"}


def test_a_body_that_rests_is_drawn_where_it_came_to_rest_once() -> None:
    """A ball that lies on the ground for half of the time is not drawn over and over."""
    simulation = Simulation(dt=1 / 60)
    simulation.add(name="floor", collider={"plane": {}})
    ball = simulation.add(
        name="ball", body={}, transform={"position": (0, 0.6, 0)}, collider={"sphere": {"radius": 0.1}}
    )
    found = overlaid(instants(simulation, 11, 6), chosen(simulation.world, None), TOLERANCE)
    heights = np.concatenate([batch.poses[batch.ids == simulation.world.row(ball), 1, 3] for batch in found])
    landing = np.sqrt(2 * 0.5 / 9.81)
    assert len(heights) == 2 + int(landing / 0.1)
    assert abs(heights[0] - 0.1) < 1e-3


def test_what_is_nearer_hides_what_is_farther_whichever_was_first() -> None:
    """The depth of the overlay is the least of all instants', pixel by pixel; the same holds for its ids."""
    simulation = passing()
    seen = instants(simulation, 8, 3)
    with Renderer(SHOT.width, SHOT.height) as renderer:
        depths = np.array([renderer.depth(batches, CAMERA) for batches in seen])
        ids = np.array([renderer.ids(batches, CAMERA) for batches in seen])
        overlay = overlaid(seen, chosen(simulation.world, None), TOLERANCE)
        assert np.array_equal(renderer.depth(overlay, CAMERA), depths.min(axis=0))
        nearest = np.take_along_axis(ids, depths.argmin(axis=0)[None], axis=0)[0]
        assert np.array_equal(renderer.ids(overlay, CAMERA), nearest)
    assert len(np.unique(nearest)) == 4


@pytest.mark.parametrize("steps", [0, 7])
def test_a_strobe_cut_short_shows_what_there_was(tmp_path: Path, steps: int) -> None:
    """The picture is written however the run ends."""
    simulation, strobe = passing(), Strobe(SHOT, tmp_path / "strobe.png", every(0.2))
    with observed(simulation, strobe):
        simulation.step(steps)
    with Image.open(tmp_path / "strobe.png") as image:
        assert image.size == (320, 240)
