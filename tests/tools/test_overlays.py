"""Overlays show what the table holds: where, how long, and in which order."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest
from trimesh.creation import box, icosphere

from carom.ecs import ColliderPose, Transform
from carom.ecs.errors import CaromError
from carom.systems.simulation import Simulation
from carom.tools.cameras import Camera
from carom.tools.filming import photograph, shot_of
from carom.tools.look import Look, look_of
from carom.tools.marks import Arrows, Inset, Labels, Lines, Mark, Points
from carom.tools.overlays import OVERLAYS
from carom.tools.overlays.overlay import Scaling, Seen
from carom.tools.overlays.wireframe import edges_of
from carom.tools.painter import Painter
from carom.tools.renderer import Renderer
from carom.tools.round_numbers import last_round, next_round
from carom.tools.view import View
from carom.worlds import load_world

CAMERA = Camera((0.0, 0.0, 10.0), fov=math.radians(60.0))
VIEW = View(CAMERA, 160, 120)
TALL = 2.0 * 10.0 * math.tan(math.radians(30.0))  # of the picture at the target, m
GRAVITY = 9.81


def seen(simulation: Simulation) -> Seen:
    """Return a world as a picture of it would see it."""
    return Seen(simulation, (), simulation.world[Transform], simulation.time, VIEW)


def marks(key: str, simulation: Simulation) -> list[Mark]:
    """Return the marks of one overlay that has watched nothing."""
    return list(OVERLAYS[key]().marks(seen(simulation)))


def ball_at_rest() -> Simulation:
    """Return a ball of 2 kg on the ground, settled."""
    simulation = Simulation(dt=1 / 60, sleeping=False)
    simulation.add(collider={"plane": {}})
    simulation.add(
        name="ball", collider={"sphere": {"radius": 0.5}}, body={"mass": 2.0}, transform={"position": (1.0, 0.5, 0.0)}
    )
    simulation.step(60)
    return simulation


def test_a_contact_is_a_dot_with_an_arrow_along_its_impulse() -> None:
    """A ball at rest is pressed by m g dt, its largest impulse so far, along the normal from the lower row to it."""
    arrows, points, _ = marks("contacts", ball_at_rest())
    assert isinstance(points, Points) and isinstance(arrows, Arrows)
    assert points.positions == pytest.approx(np.array([[1.0, 0.0, 0.0]]), abs=1e-4)
    length = 0.15 * TALL * (2.0 * GRAVITY / 60.0) / 0.5  # 0.327 N s on a scale to 0.5
    assert arrows.starts == pytest.approx(points.positions)
    assert arrows.ends - arrows.starts == pytest.approx(np.array([[0.0, length, 0.0]]), abs=1e-3)


def test_velocities_are_arrows_on_one_scale() -> None:
    """From centres of mass, 4 m/s twice as long as 2 m/s, on a scale that ends at 5 m/s."""
    simulation = Simulation(gravity=(0.0, 0.0, 0.0))
    for x, speed in ((0.0, 2.0), (3.0, 4.0)):
        body = {"mass": 1.0, "center_of_mass": (0.0, 0.25, 0.0)}
        place, motion = {"position": (x, 0.0, 0.0)}, {"linear": (0.0, speed, 0.0)}
        simulation.add(collider={"sphere": {"radius": 0.5}}, body=body, transform=place, motion=motion)
    arrows, key = marks("velocities", simulation)
    assert isinstance(key, Inset)
    assert isinstance(arrows, Arrows)
    assert arrows.starts == pytest.approx(np.array([[0.0, 0.25, 0.0], [3.0, 0.25, 0.0]]))
    lengths = 0.25 * TALL * np.array([0.4, 0.8])
    assert (arrows.ends - arrows.starts)[:, 1] == pytest.approx(lengths)
    assert not (arrows.ends - arrows.starts)[:, [0, 2]].any()


def test_a_scale_stays_until_it_is_exceeded() -> None:
    """It ends at the next of 1, 2, 5 times a power of ten above the largest so far; of zeros nothing is drawn."""
    scaling, now = Scaling(0.5), seen(Simulation())
    lengths = [scaling.metres(np.array([[size, 0.0, 0.0]]), now)[0, 0] for size in (0.0, 3.0, 1.0, 20.0)]
    assert lengths == pytest.approx([0.0, 0.5 * TALL * 0.6, 0.5 * TALL * 0.2, 0.5 * TALL])


def test_the_key_of_a_scale_is_as_long_as_what_it_stands_for() -> None:
    """Its arrow has the length of the largest value on the scale; of nothing there is none."""
    scaling, now, color = Scaling(0.5), seen(Simulation()), (0.0, 1.0, 0.0)
    assert scaling.key("speed", "m/s", color, now) == []
    length = scaling.metres(np.array([[0.0, 5.0, 0.0]]), now)[0, 1] / VIEW.metres_per_pixel
    (key,) = scaling.key("speed", "m/s", color, now)
    assert isinstance(key, Inset)
    green = np.nonzero((key.picture[..., 1] > 200) & (key.picture[..., 0] < 100))
    assert np.ptp(green[1]) + 1 == pytest.approx(length, abs=2.0)


def test_round_numbers_enclose() -> None:
    """Between the last and the next round number lies every value, and round ones are their own."""
    for value, low, high in ((3.0, 2.0, 5.0), (0.2, 0.2, 0.2), (0.7, 0.5, 1.0), (99.0, 50.0, 100.0)):
        assert (last_round(value), next_round(value)) == pytest.approx((low, high))


def test_bounds_are_twelve_edges_of_what_the_broad_phase_has() -> None:
    """The edges of a box's bounds join its eight corners along the axes; the endless ground has none."""
    simulation = ball_at_rest()
    (lines,) = marks("bounds", simulation)
    assert isinstance(lines, Lines) and len(lines.starts) == 12
    pose, row = simulation.world[ColliderPose], simulation.world.row(simulation.world.find("ball"))
    lower, upper = pose.lower[row], pose.upper[row]
    along = lines.ends - lines.starts
    assert (np.count_nonzero(along, axis=1) == 1).all()
    assert np.sort(np.abs(along).sum(axis=1)) == pytest.approx(np.sort(np.repeat(upper - lower, 4)))
    corners = np.concatenate([lines.starts, lines.ends])
    assert (corners.min(axis=0).tolist(), corners.max(axis=0).tolist()) == (lower.tolist(), upper.tolist())


def test_axes_turn_with_their_body() -> None:
    """A body turned by 90 degrees about z has its x upward; the world's axes end in letters."""
    simulation, half = Simulation(), math.sqrt(0.5)
    simulation.add(body={"mass": 1.0}, transform={"position": (1.0, 2.0, 3.0), "rotation": (0.0, 0.0, half, half)})
    bodies, world, letters = marks("axes", simulation)
    assert isinstance(bodies, Arrows) and isinstance(world, Arrows) and isinstance(letters, Labels)
    assert bodies.ends - bodies.starts == pytest.approx(
        0.07 * TALL * np.array([[0.0, 1.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 0.0, 1.0]]), abs=1e-12
    )
    assert world.ends == pytest.approx(0.15 * TALL * np.eye(3))
    assert list(letters.texts) == ["x", "y", "z"]


def thrown(speed: float = 6.0) -> Simulation:
    """Return a ball that is thrown up and to the right."""
    simulation = Simulation(dt=1 / 60)
    place, motion = {"position": (-3.0, -1.0, 0.0)}, {"linear": (speed, speed, 0.0)}
    simulation.add(collider={"sphere": {"radius": 0.1}}, body={}, transform=place, motion=motion)
    return simulation


def test_a_trail_goes_through_the_discrete_parabola() -> None:
    """After every step the trail has x0 + v t + g t^2 / 2, and the pixels there are of its colour."""
    simulation = thrown()
    painter = Painter(simulation, Look(("trails",)))
    simulation.observers = [painter]
    painter.begin(simulation)
    simulation.step(60)
    with Renderer(160, 120) as renderer:
        picture = painter.picture(renderer, CAMERA)
    times = np.arange(61) / 60.0
    places = np.stack([-3.0 + 6.0 * times, -1.0 + 6.0 * times - 0.5 * GRAVITY * times**2, 0.0 * times], axis=1)
    at = np.floor(VIEW.pixels(places)[:, :2]).astype(int)[10:-3]  # the ball covers the end
    red, blue = picture[at[:, 1], at[:, 0]][:, [0, 2]].astype(int).T
    assert (blue - red > 60).all()
    background = picture[at[:, 1] - 12, at[:, 0]].astype(int)
    assert (background[:, 2] - background[:, 0] < 60).all()


def test_a_trail_lasts_three_seconds_and_thins() -> None:
    """Its parts join the centres of every two steps; the oldest has gone, and what remains is thinner the older."""
    simulation = thrown(0.01)
    trail = OVERLAYS["trails"]()
    for _ in range(240):
        simulation.step()
        trail.watch(simulation.world)
    (lines,) = trail.marks(seen(simulation))
    assert isinstance(lines, Lines)
    assert len(lines.starts) == 180
    assert np.array_equal(lines.ends[:-1], lines.starts[1:])
    assert isinstance(lines.width, np.ndarray) and (np.diff(lines.width) > 0.0).all()
    assert lines.width[[0, -1]] == pytest.approx([0.6 + 2.0 / 180.0, 2.6])


def test_a_trail_ends_where_its_body_is_drawn() -> None:
    """Between two steps, that is part of the way; what comes later is not drawn yet."""
    simulation = thrown()
    trail = OVERLAYS["trails"]()
    for _ in range(5):
        trail.watch(simulation.world)
        simulation.advance(1 / 60)
    trail.watch(simulation.world)
    poses = simulation.between(0.25)
    (lines,) = trail.marks(Seen(simulation, (), poses, 4.25 / 60.0, VIEW))
    assert isinstance(lines, Lines) and len(lines.starts) == 5
    assert np.array_equal(lines.ends[-1], poses.position[0])
    assert lines.ends[-1, 0] == pytest.approx(-3.0 + 6.0 * 4.25 / 60.0)


def test_who_was_taken_away_leaves_no_trail_to_who_came() -> None:
    """A body in the row of another one is not joined to where that was."""
    simulation = thrown()
    trail = OVERLAYS["trails"]()
    trail.watch(simulation.world)
    simulation.world.despawn(simulation.world.entities(np.array([0])))
    simulation.add(body={"mass": 1.0}, transform={"position": (5.0, 0.0, 0.0)})
    trail.watch(simulation.world)
    (lines,) = trail.marks(seen(simulation))
    assert isinstance(lines, Lines) and not len(lines.starts)


def test_names_are_at_origins_the_nearest_first() -> None:
    """What has no name, or is not seen, has no label."""
    simulation, ball = Simulation(), {"sphere": {"radius": 0.5}}
    for name, z in (("far", -5.0), ("near", 2.0), (None, 0.0)):
        simulation.add(name=name, collider=ball, transform={"position": (0.0, 0.0, z)})
    simulation.add(name="hidden", collider=ball, visual=False)
    (label,) = marks("labels", simulation)
    assert isinstance(label, Labels)
    assert list(label.texts) == ["near", "far"]
    assert label.positions[:, 2].tolist() == [2.0, -5.0]
    assert label.rows is not None and label.rows.tolist() == [1, 0]


def test_edges_are_each_there_once_and_not_within_a_plane() -> None:
    """A cube has 12, though it is 12 triangles; a ball of f triangles has 3 f / 2."""
    cube, ball = box(extents=(1.0, 2.0, 3.0)), icosphere(subdivisions=2)
    edges = edges_of(cube.vertices, cube.faces)
    lengths = np.linalg.norm(cube.vertices[edges[:, 0]] - cube.vertices[edges[:, 1]], axis=1)
    assert sorted(lengths.tolist()) == [1.0] * 4 + [2.0] * 4 + [3.0] * 4
    assert len(edges_of(ball.vertices, ball.faces)) == 3 * len(ball.faces) // 2


def test_a_wireframe_shows_what_is_behind() -> None:
    """The frame of a cube lets its middle through; an overlay of edges leaves it there and hides its far side."""
    simulation = Simulation()
    simulation.add(collider={"box": {"size": (2.0, 2.0, 2.0)}}, visual={"color": (1.0, 0.0, 0.0)})
    camera, middle = Camera((0.0, 0.0, 4.0)), (60, 80)
    with Renderer(160, 120) as renderer:
        sky = renderer.picture([], camera)
        frame = Painter(simulation, Look(wireframe=True)).picture(renderer, camera)
        plain, edged = (Painter(simulation, look).picture(renderer, camera) for look in (Look(), Look(("wireframe",))))
    assert frame[middle].tolist() == sky[middle].tolist()
    assert edged[middle].tolist() == plain[middle].tolist()
    half = 60.0 / math.tan(math.radians(22.5))
    near, far = (60 - half / 3.0, 60 - half / 5.0)  # rows of the upper edges, 3 m and 5 m away
    for row, in_frame, in_overlay in ((near, True, True), (far, True, False)):
        rows = slice(int(row) - 1, int(row) + 2)
        assert bool((frame[rows, 80] != sky[rows, 80]).any()) is in_frame
        assert bool((edged[rows, 80] != plain[rows, 80]).any()) is in_overlay


def test_a_file_states_its_look(tmp_path: Path) -> None:
    """Words under render hold unless others are given; pictures with and without differ."""
    path = tmp_path / "world.yaml"
    path.write_text(
        "carom: 1\nentities: [{name: ball, collider: {sphere: {radius: 1}}, body: {}}]\n"
        "render: {width: 160, height: 120, overlays: [labels, stamp], color: speed}\n"
    )
    loaded = load_world(path)
    assert look_of(loaded) == Look(("labels", "stamp"), "speed")
    assert look_of(loaded, ["axes"], "material", True) == Look(("axes",), "material", True)
    photograph(shot_of(loaded), loaded.simulation, tmp_path / "stated.png")
    photograph(shot_of(loaded, look=Look()), loaded.simulation, tmp_path / "plain.png")
    assert (tmp_path / "stated.png").read_bytes() != (tmp_path / "plain.png").read_bytes()


def test_unknown_names_are_told_all_at_once() -> None:
    """Each with what is accepted and what may have been meant."""
    loaded = load_world("bounce")
    with pytest.raises(CaromError) as caught:
        look_of(loaded, ["conacts", "stamp"], "sped")
    assert str(caught.value) == (
        "bounce.yaml: color: unknown mode of colour; received 'sped'; "
        "accepted: energy, entity, island, kind, layer, material, sleep, speed; did you mean 'speed'?\n"
        f"bounce.yaml: overlays: unknown overlay; received 'conacts'; accepted: {', '.join(sorted(OVERLAYS))}; "
        "did you mean 'contacts'?"
    )


def test_a_free_body_diagram_is_on_the_scale_of_the_weight() -> None:
    """Weight and normal force of a ball at rest are equally long; an impact is cut, but its label tells its size."""
    simulation = ball_at_rest()
    arrows, labels = marks("forces", simulation)
    assert isinstance(arrows, Arrows) and isinstance(labels, Labels)
    lengths = (arrows.ends - arrows.starts)[:, 1]
    assert lengths == pytest.approx(0.25 * TALL * (2.0 * GRAVITY / 20.0) * np.array([-1.0, 1.0]), rel=1e-3)
    assert sorted(labels.texts) == ["gravity 19.6 N", "normal 19.6 N"]
    falling = Simulation(dt=1 / 60)
    falling.add(collider={"plane": {}})
    body, place = {"mass": 2.0}, {"position": (0.0, 0.55, 0.0)}
    falling.add(collider={"sphere": {"radius": 0.5}}, body=body, transform=place, motion={"linear": (0.0, -9.0, 0.0)})
    falling.step()
    arrows, labels = marks("forces", falling)
    assert isinstance(arrows, Arrows) and isinstance(labels, Labels)
    assert np.linalg.norm(arrows.ends - arrows.starts, axis=1).max() == pytest.approx(0.4 * TALL)
    assert labels.texts[0].startswith("normal ") and labels.texts[0].endswith(" kN")
