"""Plots over time: what they measure, and that their curves go where the numbers say."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from carom.ecs.errors import CaromError
from carom.systems.simulation import Simulation
from carom.tools.cameras import Camera
from carom.tools.film import Picture
from carom.tools.look import look_of
from carom.tools.marks import Inset
from carom.tools.overlays.overlay import Seen
from carom.tools.overlays.plot import COLORS, Plot, ends, thinned
from carom.tools.quantities import QUANTITIES, Quantity, quantity
from carom.tools.view import View
from carom.worlds import load_world
from carom.worlds.errors import WordError

GRAVITY = 9.81


def falling() -> Simulation:
    """Return a ball of 2 kg that falls from 3 m."""
    simulation = Simulation(dt=1 / 60)
    simulation.add(
        name="ball", collider={"sphere": {"radius": 0.5}}, body={"mass": 2.0}, transform={"position": (0.0, 3.0, 0.0)}
    )
    return simulation


def plotted(simulation: Simulation, plot: Plot) -> Picture:
    """Return the inset of a plot in a picture of 640 x 480 px."""
    view = View(Camera((0.0, 0.0, 5.0)), 640, 480)
    (inset,) = plot.marks(Seen(simulation, (), simulation.between(1.0), simulation.time, view))
    assert isinstance(inset, Inset)
    return inset.picture


def test_quantities_are_those_of_mechanics() -> None:
    """A ball that falls for 0.5 s has m g^2 t^2 / 2, m g h and m g t; nothing overlaps."""
    simulation = falling()
    simulation.step(30)
    read = {name: one.read(simulation.world) for name, one in QUANTITIES.items()}
    kinetic, potential = 0.5 * 2.0 * (GRAVITY * 0.5) ** 2, 2.0 * GRAVITY * (3.0 - 0.5 * GRAVITY * 0.25)
    assert read["energy"] == pytest.approx({"kinetic": kinetic, "potential": potential, "total": kinetic + potential})
    assert read["momentum"] == pytest.approx({"x": 0.0, "y": -2.0 * GRAVITY * 0.5, "z": 0.0})
    assert (read["overlap"], read["counts"]) == ({"deepest_mm": 0.0}, {"bodies": 1, "contacts": 0})


def test_values_of_expectations_are_quantities_too() -> None:
    """A vector has a curve for each axis, named like it."""
    world = falling().world
    assert quantity("ball.position", world).read(world) == {
        "ball.position.x": 0.0, "ball.position.y": 3.0, "ball.position.z": 0.0
    }  # fmt: skip
    speed = quantity("speed(ball)", world)
    assert (speed.title, speed.unit, speed.read(world)) == ("speed(ball)", "m/s", {"speed(ball)": 0.0})


def test_what_is_no_quantity_is_told() -> None:
    """With the names there are, the forms of values, and what may have been meant."""
    loaded = load_world("bounce")
    with pytest.raises(CaromError) as caught:
        look_of(loaded, plots=["enrgy"])
    assert str(caught.value) == (
        "bounce.yaml: plots: is no value of the world; received 'enrgy'; accepted: energy, momentum, overlap, counts, "
        "<entity>.<column>, speed(entity), spin(entity), kinetic_energy(entity), load(entity), "
        "error(entity), center_of_mass(entity, ...), count(entity, ...), distance(entity, entity) or "
        "sees(entity, entity); did you mean 'energy'?"
    )
    with pytest.raises(WordError):
        quantity("speed(nobody)", loaded.simulation.world)


def test_a_straight_line_is_straight_and_ends_in_the_corner() -> None:
    """What grows from 0 to 5 in proportion to time crosses the frame from corner to corner."""
    simulation = falling()
    plot = Plot(Quantity("frames", "1", lambda world: {"frames": float(world.frame)}))
    plot.watch(simulation.world)
    for _ in range(5):
        simulation.step()
        plot.watch(simulation.world)
    picture = plotted(simulation, plot).astype(int)
    color = np.rint(255.0 * COLORS[0]).astype(int)
    y, x = np.nonzero((np.abs(picture[..., :3] - color) < 40).all(axis=2) & (picture[..., 3] == 255))
    frame = np.argwhere((picture[..., :3] == (100, 106, 116)).all(axis=2))
    (top, left), (bottom, right) = frame.min(axis=0), frame.max(axis=0)
    across, upward = (x - left) / (right - left), (bottom - y) / (bottom - top)
    assert np.abs(across - upward).max() < 0.03
    assert (x.min() - left, right - x.max()) == (pytest.approx(0, abs=2), pytest.approx(0, abs=2))


def test_a_curve_begins_when_somebody_comes() -> None:
    """Who comes by an event has no speed before; the curve is in the second half."""
    simulation = falling()
    simulation.event(0.5, spawn={"name": "late", "body": {"mass": 1.0, "inertia": (1.0, 1.0, 1.0)}})
    plot = Plot(quantity("speed(late)", simulation.world))
    for _ in range(60):
        simulation.step()
        plot.watch(simulation.world)
    picture = plotted(simulation, plot).astype(int)
    _, x = np.nonzero((np.abs(picture[..., :3] - np.rint(255.0 * COLORS[0])) < 40).all(axis=2))
    frame = np.nonzero((picture[..., :3] == (100, 106, 116)).all(axis=2))[1]
    assert x.min() == pytest.approx(0.5 * (frame.min() + frame.max()), abs=6)


def test_scales_end_at_round_numbers_around_zero() -> None:
    """Whatever the values, zero is within; of nothing but zeros the scale is 0 to 1."""
    for values, wanted in (
        ([3.0, 4.0], (0.0, 5.0)),
        ([-0.3, 7.0], (-0.5, 10.0)),
        ([-3.0], (-5.0, 0.0)),
        ([0.0], (0.0, 1.0)),
        ([np.nan, 3.0, np.nan], (0.0, 5.0)),
        ([np.nan], (0.0, 1.0)),
    ):
        assert ends(np.array([values])) == pytest.approx(wanted)


def test_thinning_keeps_every_extreme() -> None:
    """Of 100,000 points over 200 pixels at most 800 are left, with the lowest and highest of each pixel."""
    generator = np.random.default_rng(3)
    points = np.column_stack([np.linspace(0.0, 200.0, 100_000, endpoint=False), generator.normal(size=100_000)])
    few = thinned(points)
    assert len(few) <= 800
    assert (np.diff(few[:, 0]) > 0.0).all()
    for all_of, kept in ((points, few),):
        column, kept_column = np.floor(all_of[:, 0]).astype(int), np.floor(kept[:, 0]).astype(int)
        for bound in (np.minimum, np.maximum):
            whole, part = np.zeros(200), np.zeros(200)
            bound.at(whole, column, all_of[:, 1])
            bound.at(part, kept_column, kept[:, 1])
            assert np.array_equal(whole, part)
    assert np.array_equal(thinned(points[:1]), points[:1])


def test_a_file_states_its_plots(tmp_path: Path) -> None:
    """Words under render hold unless others are given."""
    path = tmp_path / "world.yaml"
    path.write_text("carom: 1\nentities: [{name: ball, body: {mass: 1}}]\nrender: {plots: [energy, speed(ball)]}\n")
    loaded = load_world(path)
    assert look_of(loaded).plots == ("energy", "speed(ball)")
    assert look_of(loaded, plots=["counts"]).plots == ("counts",)
