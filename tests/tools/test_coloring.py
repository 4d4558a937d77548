"""Colours tell what their mode says, for every row alike."""

from __future__ import annotations

import numpy as np
import pytest

from carom.ecs import Motion, Visual
from carom.systems.simulation import Simulation
from carom.tools.coloring import FEW, KINDS, MODES, SCALE, SLEEP, Coloring, Legend, hues, on_scale
from carom.tools.legends import legend_inset
from carom.tools.view import View

BALL = {"sphere": {"radius": 0.5}}
GREEN = (0.0, 1.0, 0.0, 0.5)


def scene() -> Simulation:
    """Return ground, a kinematic ball, two dynamic ones that touch, and one by itself that sleeps."""
    simulation = Simulation(dt=1 / 60)
    simulation.layers({"toys": None})
    simulation.add(name="ground", collider={"plane": {}})
    simulation.add(
        name="lift",
        collider=BALL,
        body={"type": "kinematic"},
        transform={"position": (-5.0, 3.0, 0.0)},
        visual={"color": (0.8, 0.8, 0.8)},
    )
    for name, x, mass in (("one", 0.0, 1.0), ("other", 0.999, 1.0), ("alone", 5.0, 2.0)):
        place = {"position": (x, 0.5, 0.0)}
        simulation.add(
            name=name, collider=BALL | {"layer": "toys"}, body={"mass": mass}, transform=place, visual={"color": GREEN}
        )
    return simulation


def colored(mode: str, simulation: Simulation) -> dict[str, list[float]]:
    """Return the colour of each entity by its name."""
    world = simulation.world
    rows = world.row_numbers(Visual)
    names = world.names_of(world.entities(rows)).tolist()
    return dict(zip(names, Coloring(mode).colors(world, rows).tolist(), strict=True))


def test_every_mode_gives_every_row_a_colour_and_keeps_alpha() -> None:
    """Colours are within 0..1, before the first step and after."""
    simulation = scene()
    for _ in range(2):
        for mode in MODES:
            colors = np.array(list(colored(mode, simulation).values()))
            assert colors.shape == (5, 4)
            assert ((colors >= 0.0) & (colors <= 1.0)).all()
            assert colors[:, 3].tolist() == [1.0, 1.0, 0.5, 0.5, 0.5]
        simulation.step()


def test_the_material_is_left_as_it_is() -> None:
    """Without a mode colours are those of the look, and there is no legend."""
    coloring, world = Coloring("material"), scene().world
    rows = world.row_numbers(Visual)
    assert np.array_equal(coloring.colors(world, rows), world[Visual].color[rows])
    assert coloring.legend is None


def test_kinds_and_sleep_are_named() -> None:
    """Static, kinematic and dynamic bodies, and those that sleep, have the colours of the legend."""
    simulation = scene()
    kinds = colored("kind", simulation)
    assert [kinds[name][:3] for name in ("ground", "lift", "one")] == [list(color) for color in KINDS.values()]
    simulation.step(2)
    world = simulation.world
    with world.edit(Motion) as motion:
        motion.asleep[world.row(world.find("alone"))] = True
        motion.still[[world.row(world.find(name)) for name in ("one", "other")]] = (0.0, 0.2)
    sleep = colored("sleep", simulation)
    wanted = [SLEEP["static"], SLEEP["awake"], SLEEP["eligible"], SLEEP["asleep"]]
    assert [sleep[name][:3] for name in ("ground", "one", "other", "alone")] == [list(color) for color in wanted]


def test_those_of_one_island_have_one_colour() -> None:
    """Two balls that touch are alike and unlike a third; what cannot be pushed is gray, as light as it is."""
    simulation = scene()
    simulation.step()
    island = colored("island", simulation)
    assert island["one"] == island["other"] != island["alone"]
    assert island["ground"][:3] == island["lift"][:3] == pytest.approx([0.65] * 3)


def test_layers_have_the_colours_of_their_order() -> None:
    """Default is the second layer there is, toys the third."""
    layer = colored("layer", scene())
    assert layer["ground"][:3] == FEW[1].tolist()
    assert layer["one"][:3] == FEW[2].tolist()


def test_speed_is_a_place_on_the_scale() -> None:
    """The scale ends at the next round number and keeps its end; what has no body is gray."""
    simulation = scene()
    world, coloring = simulation.world, Coloring("speed")
    rows = world.row_numbers(Visual)
    row = world.row(world.find("one"))
    ends = []
    for speed, share in ((3.0, 0.6), (1.0, 0.2), (0.0, 0.0)):
        with world.edit(Motion) as motion:
            motion.linear[row] = (0.0, speed, 0.0)
        colors = coloring.colors(world, rows)
        assert colors[rows.tolist().index(row), :3] == pytest.approx(on_scale(np.array([share]))[0])
        ends.append(coloring.legend)
    assert ends == [Legend("speed", unit="m/s", most=5.0)] * 3
    assert colors[0, :3] == pytest.approx([0.65] * 3)


def test_energy_is_that_of_motion_and_rotation() -> None:
    """Half m v^2 of 2 kg at 3 m/s is 9 J of a scale to 10 J; kinematic bodies have none to tell."""
    simulation = scene()
    world = simulation.world
    with world.edit(Motion) as motion:
        motion.linear[world.row(world.find("alone"))] = (3.0, 0.0, 0.0)
    energy = colored("energy", simulation)
    assert energy["alone"][:3] == pytest.approx(on_scale(np.array([0.9]))[0])
    assert energy["one"][:3] == SCALE[0].tolist()
    assert energy["lift"][:3] == pytest.approx([0.65] * 3)


def test_hues_of_neighbours_are_far_apart() -> None:
    """Of any eight numbers in a row, no two colours are near; a number keeps its colour."""
    colors = hues(np.arange(40))
    for first in range(32):
        eight = colors[first : first + 8]
        apart = np.linalg.norm(eight[:, None] - eight[None], axis=2)[np.triu_indices(8, 1)]
        assert apart.min() > 0.1
    assert np.array_equal(hues(np.array([7])), colors[[7]])


def test_a_legend_shows_the_scale_and_the_names() -> None:
    """The bar of a scale has the colours of both its ends; names stand beside squares of theirs."""
    view = View(None, 640, 480)  # type: ignore[arg-type]
    scale = legend_inset(Legend("speed", unit="m/s", most=5.0), view)
    names = legend_inset(Legend("body", tuple(KINDS), tuple(KINDS.values())), view)
    for inset, colors in ((scale, SCALE[[0, -1]]), (names, list(KINDS.values()))):
        opaque = inset.picture[inset.picture[..., 3] == 255][:, :3]
        for color in colors:
            assert (np.abs(opaque - np.rint(255.0 * np.array(color))) <= 1.0).all(axis=1).any()
