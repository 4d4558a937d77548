"""Particles are seen as they are: in a recording number by number, in pictures by their size and colour in pixels."""

from __future__ import annotations

from collections.abc import Iterator
from math import pi
from pathlib import Path
from typing import Any

import numpy as np
import polars
import pytest
from sprays import emitting, positions

from carom.ecs.column import Floats, Integers
from carom.ecs.relations.particle import Particle
from carom.systems.observer import observed
from carom.systems.simulation import Simulation
from carom.tools.cameras import Camera
from carom.tools.look import Look
from carom.tools.painter import Painter
from carom.tools.particles import POINT_WIDTH, clouds, particle_batches, particle_marks
from carom.tools.reading import read
from carom.tools.recorder import Recorder
from carom.tools.recording import Recording
from carom.tools.renderer import Renderer
from carom.tools.view import View

SIZE = 240
ACROSS = Camera((0.0, 0.0, 5.0), height=2.4)  # 1 cm a pixel, at any distance
RED = (1.0, 0.0, 0.0)


@pytest.fixture(scope="module")
def renderer() -> Iterator[Renderer]:
    """Return a renderer without what mixes colours."""
    with Renderer(SIZE, SIZE, shadows=False, antialiasing=False) as made:
        yield made


def drawn(renderer: Renderer, simulation: Simulation, camera: Camera = ACROSS) -> Integers:
    """Return how red each pixel is beyond its green."""
    picture = Painter(simulation, Look()).picture(renderer, camera).astype(np.int64)
    return np.asarray(picture[..., 0] - picture[..., 1])


def hanging(draw: str, **words: Any) -> Simulation:
    """Return one particle in the middle that stays where it is, after a step."""
    stated = {"burst": 1, "gravity_scale": 0.0, "life": 100.0, "color": RED, "size": 0.4, "draw": draw}
    simulation = emitting(dt=1 / 60, **{**stated, **words})
    simulation.step()
    return simulation


def test_a_recording_holds_every_particle_of_every_frame(tmp_path: Path) -> None:
    """Who it is, where, of which colour, and as large as it covers what is behind it; frames without any show none."""
    simulation = emitting(
        dt=1 / 60, rate=90.0, start=0.1, duration=0.4, life=(0.1, 0.3), speed=2.0, cone=1.0,
        size=0.1, end_size=0.3, color=(1.0, 0.5, 0.0), end_color=(0.0, 0.5, 1.0, 0.0),
    )  # fmt: skip
    with observed(simulation, Recorder(tmp_path / "spray.rrd", every=1)):
        held: dict[int, Any] = {}
        for frame in range(1, 61):
            simulation.step()
            held[frame] = [positions(simulation).astype(np.float32), *clouds(simulation.world)]
            held[frame].append(simulation.world[Particle].number[: len(held[frame][0])].copy())
    table, series = Recording(tmp_path / "spray.rrd").table("particles").polars(), read(tmp_path / "spray.rrd").series
    looks = {name: series["/world/particles", f"Points3D:{name}"] for name in ("radii", "colors")}
    seen = 0
    for frame, (places, *cloud, numbers) in held.items():
        rows = table.filter(polars.col("frame") == frame)
        assert rows["number"].to_list() == numbers.tolist()
        assert set(rows["emitter.name"].to_list()) <= {"source"}
        assert (rows.select("position.x", "position.y", "position.z").to_numpy() == places).all()
        seen += len(places)
        assert len(cloud) == (1 if len(places) else 0)
        for look in cloud:
            radii, colors = (column.values[column.frames.index(frame)] for column in looks.values())
            assert (radii == (0.5 * look.diameters * np.sqrt(look.colors[:, 3])).astype(np.float32)).all()
            opaque = look.colors * (1.0, 1.0, 1.0, 0.0) + (0.0, 0.0, 0.0, 1.0)
            assert (np.stack([colors >> shift & 255 for shift in (24, 16, 8, 0)], axis=1) == shades(opaque)).all()
    assert seen > 400


def shades(colors: Floats) -> Integers:
    """Return colours in 0..255."""
    return np.asarray(np.rint(255.0 * colors).astype(np.int64))


def test_a_world_without_emitters_records_no_particles(tmp_path: Path) -> None:
    """There is no such table."""
    simulation = Simulation()
    recorder = Recorder(tmp_path / "empty.rrd", every=1)
    recorder.begin(simulation)
    simulation.step()
    recorder.end(simulation)
    assert "particles" not in Recording(tmp_path / "empty.rrd").tables()
    assert particle_batches(simulation.world) == []
    assert particle_marks(simulation.world, View(ACROSS, SIZE, SIZE)) == []


@pytest.mark.parametrize(("draw", "area"), [("sprites", pi * 20.0**2), ("spheres", pi * 20.0**2), ("boxes", 40.0**2)])
def test_a_particle_covers_as_many_pixels_as_its_size_says(renderer: Renderer, draw: str, area: float) -> None:
    """0.4 m at 1 cm a pixel: a disc, a ball and a box of 40 px."""
    assert np.count_nonzero(drawn(renderer, hanging(draw)) > 40) == pytest.approx(area, rel=0.04)


def test_points_are_as_large_at_any_distance(renderer: Renderer) -> None:
    """A dot of 3 px, whatever its size and wherever it is."""
    for away in (2.0, 20.0):
        seen = drawn(renderer, hanging("points"), Camera((0.0, 0.0, away)))
        assert (seen[seen > 0] / 255.0).sum() == pytest.approx(pi * (POINT_WIDTH / 2) ** 2, abs=1.5)


def test_sprites_are_smaller_farther_off(renderer: Renderer) -> None:
    """Twice as far they cover a quarter."""
    near, far = (
        np.count_nonzero(drawn(renderer, hanging("sprites"), Camera((0.0, 0.0, away))) > 60) for away in (2.0, 4.0)
    )
    assert far == pytest.approx(near / 4.0, rel=0.06)


def test_size_and_colour_run_over_life(renderer: Renderer) -> None:
    """After half of its life it is as large as the mean of both ends, and half as red and as clear."""
    words = {"life": 1.0, "size": 0.2, "end_size": 0.6, "end_color": (1.0, 0.0, 0.0, 0.0)}
    simulation = hanging("sprites", **words)
    whole = drawn(renderer, simulation)
    simulation.step(29)
    half = drawn(renderer, simulation)
    assert np.count_nonzero(half > 30) == pytest.approx(pi * 20.0**2, rel=0.03)
    assert half.max() == pytest.approx(0.5 * whole.max(), rel=0.05)
    simulation.step(31)
    assert drawn(renderer, simulation).max() <= 0


@pytest.mark.parametrize("draw", ["sprites", "spheres", "points"])
def test_bodies_hide_particles_behind_them(renderer: Renderer, draw: str) -> None:
    """Of a particle behind a box nothing is seen, of one in front all."""
    simulation = hanging(draw)
    simulation.add(
        visual={"box": {"size": (1.0, 1.0, 0.1)}, "color": (0.0, 0.0, 1.0)}, transform={"position": (0, 0, 1)}
    )
    assert np.count_nonzero(drawn(renderer, simulation) > 30) == 0
    behind = Camera((0.0, 0.0, -5.0), height=2.4)
    assert np.count_nonzero(drawn(renderer, simulation, behind) > 30) > 0


def test_near_sprites_are_drawn_over_far_ones(renderer: Renderer) -> None:
    """From either side the nearer of two is the one whose colour is seen, whoever was born first."""
    simulation = hanging("sprites")
    words = {"burst": 1, "gravity_scale": 0.0, "life": 100.0, "color": (0.0, 1.0, 0.0), "size": 0.4}
    simulation.add(emitter=words, transform={"position": (0.0, 0.0, 0.5)})
    simulation.step()
    assert drawn(renderer, simulation)[SIZE // 2, SIZE // 2] < -200
    assert drawn(renderer, simulation, Camera((0.0, 0.0, -5.0), height=2.4))[SIZE // 2, SIZE // 2] > 200
