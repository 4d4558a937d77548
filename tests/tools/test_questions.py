"""What a picture answers agrees with closed forms, and pixel by pixel with rays cast through the world."""

from __future__ import annotations

import math

import numpy as np
import pytest

from carom.ecs.errors import CaromError
from carom.systems.simulation import Simulation
from carom.tools.cameras import Camera
from carom.tools.filming import Shot, shot_of
from carom.tools.questions import Box, Sight
from carom.worlds import load_world

SHOT = Shot(Camera((0.0, 0.0, 10.0), fov=math.radians(40.0)), 320, 240)
FOCAL = SHOT.height / 2.0 / math.tan(math.radians(20.0))  # px


def simulation_of(*entities: dict) -> Simulation:
    """Return a simulation of static entities."""
    simulation = Simulation(gravity=(0.0, 0.0, 0.0))
    for words in entities:
        simulation.add(**words)
    return simulation


def box(name: str, size: tuple[float, float, float], at: tuple[float, float, float], **words: object) -> dict:
    """Return the words for a box."""
    return {"name": name, "collider": {"box": {"size": size}}, "transform": {"position": at}, **words}


def ray_ids(simulation: Simulation, shot: Shot, camera: Camera, **filters: object) -> np.ndarray:
    """Return the row (height, width) of the body that the ray through each pixel's centre meets first, -1 for none."""
    half = math.tan(camera.fov / 2.0)
    across = half * shot.width / shot.height * (2.0 * (np.arange(shot.width) + 0.5) / shot.width - 1.0)
    down = half * (1.0 - 2.0 * (np.arange(shot.height) + 0.5) / shot.height)
    eyes = np.stack([*np.meshgrid(across, down), np.full((shot.height, shot.width), -1.0)], axis=-1).reshape(-1, 3)
    pose = camera.pose()
    hits = simulation.space.cast_rays(camera.position, eyes @ pose[:3, :3].T, **filters)
    rows = [simulation.world.row(entity) if hit else -1 for entity, hit in zip(hits.entity, hits.hit, strict=True)]
    return np.reshape(rows, (shot.height, shot.width))


def test_a_box_before_another_hides_just_what_rays_say() -> None:
    """From an oblique camera: counts, share, occluders and boxes, all but exactly."""
    simulation = simulation_of(
        box("crate", (2.0, 2.0, 2.0), (0.0, 0.0, 0.0)),
        box("wall", (3.0, 1.5, 0.2), (2.1, 0.4, 2.0)),
        box("post", (0.3, 4.0, 0.3), (-0.6, 0.0, 1.8)),
        box("far", (9.0, 9.0, 0.5), (0.0, 0.0, -5.0)),
    )
    camera = Camera((2.5, 2.0, 9.0), (0.2, 0.0, 0.0), fov=math.radians(40.0))
    shot = Shot(camera, 320, 240)
    rows = {name: simulation.world.row(simulation.world.find(name)) for name in ("crate", "wall", "post", "far")}
    everything = ray_ids(simulation, shot, camera)
    with Sight(simulation, shot) as sight:
        for name, row in rows.items():
            others = [simulation.world.find(other) for other in rows if other != name]
            alone = ray_ids(simulation, shot, camera, without=others) == row
            assert (sight.silhouette(name) != alone).sum() <= 2  # OpenGL places corners on a grid of 1/256 px
            assert abs(sight.visible(name) - (everything == row).sum()) <= 2
            assert abs(sight.visible_share(name) - (everything == row).sum() / alone.sum()) < 1e-3
            down, across = np.nonzero(alone)
            truth = across.min(), down.min(), across.max() + 1, down.max() + 1
            assert np.abs(np.subtract(sight.box(name), truth)).max() <= 1
            hidden = everything[alone & (everything != row)]
            found = sight.occluders(name)
            assert set(found) == {other for other, at in rows.items() if (hidden == at).sum() > 2}
            for other, pixels in found.items():
                assert abs(pixels - (hidden == rows[other]).sum()) <= 2
        assert set(sight.occluders("crate")) == {"wall", "post"}
        assert 0.3 < sight.visible_share("crate") < 0.8


def test_every_domino_of_a_falling_row_is_seen_as_rays_see_it() -> None:
    """Sixteen boxes that lean on each other, from the world's own camera: as many pixels, but for edges."""
    loaded = load_world("dominoes")
    simulation, shot = loaded.simulation, shot_of(loaded)
    simulation.step(round(1.2 / simulation.settings.dt))
    everything = ray_ids(simulation, shot, shot.camera(simulation.world))
    names = [name for name in simulation.world.names() if name != "floor"]
    shares = []
    with Sight(simulation, shot) as sight:
        for name in names:
            truth = (everything == simulation.world.row(simulation.world.find(name))).sum()
            assert abs(sight.visible(name) - truth) <= 4
            shares.append(sight.visible_share(name))
    assert len(names) == 16
    assert min(shares) < 0.85 and max(shares) > 0.95


@pytest.mark.parametrize("seed", range(4))
def test_what_is_hidden_is_hidden_by_somebody(seed: int) -> None:
    """Of any heap of turned boxes: what is visible and what each other hides make up the silhouette, to the pixel.

    What is visible of all of them together is what is not background.
    """
    generator = np.random.default_rng(seed)
    names = [f"box_{number}" for number in range(7)]
    simulation = simulation_of()
    for name in names:
        turn = generator.normal(size=4)
        place = {"position": generator.uniform(-2.0, 2.0, 3), "rotation": turn / np.linalg.norm(turn)}
        simulation.add(name=name, collider={"box": {"size": generator.uniform(0.3, 3.0, 3)}}, transform=place)
    with Sight(simulation, SHOT) as sight:
        outlines = {name: sight.silhouette(name) for name in names}
        for name, outline in outlines.items():
            assert sight.visible(name) + sum(sight.occluders(name).values()) == outline.sum()
        assert sum(map(sight.visible, names)) == np.any(list(outlines.values()), axis=0).sum()
        one, other = names[:2]
        assert sight.overlap(one, other) == (outlines[one] & outlines[other]).sum()


def test_a_ball_covers_its_ellipse() -> None:
    """A ball off the axis is seen as an ellipse of area pi f^2 sin^2 a cos a / (cos^2 b - sin^2 a)^(3/2) px.

    a is the half angle of the cone that touches it and b the angle between its axis and the camera's; the ball that
    is drawn has facets within it.
    """
    for x, y, radius in ((0.0, 0.0, 1.0), (2.5, 0.0, 1.0), (-2.0, 1.5, 1.2), (3.0, -2.0, 0.6)):
        simulation = simulation_of(
            {"name": "ball", "collider": {"sphere": {"radius": radius}}, "transform": {"position": (x, y, 0.0)}}
        )
        distance = math.sqrt(x * x + y * y + 100.0)
        sine, cosine = radius / distance, 10.0 / distance
        truth = math.pi * FOCAL**2 * sine**2 * math.sqrt(1.0 - sine**2) / (cosine**2 - sine**2) ** 1.5
        with Sight(simulation, SHOT) as sight:
            assert 0.985 * truth < sight.visible("ball") < 1.002 * truth
            assert sight.visible_share("ball") == 1.0
            assert sight.occluders("ball") == {}


def test_a_ball_half_behind_a_wall_is_half_seen() -> None:
    """The wall's edge runs through the ball's middle, between two columns of pixels: each half has as many."""
    simulation = simulation_of(
        {"name": "ball", "collider": {"sphere": {"radius": 1.0}}}, box("wall", (4.0, 4.0, 0.2), (2.0, 0.0, 3.0))
    )
    with Sight(simulation, SHOT) as sight:
        whole = sight.silhouette("ball")
        assert sight.visible("ball") == whole[:, : SHOT.width // 2].sum()
        assert sight.occluders("ball") == {"wall": int(whole[:, SHOT.width // 2 :].sum())}
        assert abs(sight.visible_share("ball") - 0.5) < 0.01


def test_a_body_is_all_its_parts_and_a_part_is_itself() -> None:
    """A bar of two boxes; what is in front of it is told as one body too."""
    simulation = simulation_of(box("back", (8.0, 6.0, 0.1), (0.0, 0.0, -2.0)))
    bar = simulation.add(name="bar", body={"mass": 1.0}, visual=False, collider={"sphere": {"radius": 0.01}})
    for name, x in (("left", -1.0), ("right", 1.0)):
        simulation.add(
            **box(name, (1.0, 1.0, 1.0), (0.0, 0.0, 0.0))
            | {"transform": {}, "parent": {"entity": bar, "position": (x, 0.0, 0.0)}}
        )
    with Sight(simulation, SHOT) as sight:
        parts = sight.visible("left"), sight.visible("right")
        assert min(parts) > 500
        assert sight.visible(bar) == sum(parts)
        assert sight.occluders("back") == {"bar": sum(parts)}
        assert sight.occluders("bar") == {}


def test_what_is_translucent_hides_nothing_and_is_seen_itself() -> None:
    """A pane before a crate; behind the crate, the pane's own pixels are hidden by it."""
    for depth, hidden in ((2.0, False), (-2.0, True)):
        simulation = simulation_of(
            box("crate", (2.0, 2.0, 2.0), (0.0, 0.0, 0.0)),
            box("pane", (3.0, 3.0, 0.1), (0.0, 0.0, depth), visual={"color": (0.5, 0.7, 1.0, 0.3)}),
        )
        with Sight(simulation, SHOT) as sight:
            assert sight.visible_share("crate") == 1.0
            assert (sight.visible_share("pane") < 1.0) is hidden
            assert ("crate" in sight.occluders("pane")) is hidden


def test_sides_and_overlaps_are_those_of_the_picture() -> None:
    """Boxes and overlaps follow from the pinhole, whatever is in front; a roll of the camera turns them."""
    simulation = simulation_of(
        box("red", (1.0, 1.0, 0.01), (-1.0, 1.0, 0.0)),
        box("blue", (1.0, 1.0, 0.01), (1.0, -1.0, 0.0)),
        box("band", (3.0, 1.0, 0.01), (0.0, 1.0, -1.0)),
    )
    near = 10.0 - 0.005
    with Sight(simulation, SHOT) as sight:
        left, right = (160 + FOCAL * x / near for x in (-1.5, -0.5))
        top, bottom = (120 - FOCAL * y / near for y in (1.5, 0.5))
        assert sight.box("red") == Box(*(math.floor(edge + 0.5) for edge in (left, top, right, bottom)))
        assert sight.left_of("red", "blue") and not sight.left_of("blue", "red")
        assert sight.above("red", "blue") and not sight.above("blue", "red")
        assert sight.overlap("red", "blue") == 0
        assert (
            sight.overlap("red", "band")
            == sight.overlap("band", "red")
            == (sight.silhouette("red") & sight.silhouette("band")).sum()
            > 500
        )
    rolled = Shot(Camera((0.0, 0.0, 10.0), up=(1.0, 0.0, 0.0), fov=math.radians(40.0)), 320, 240)
    with Sight(simulation, rolled) as sight:
        assert sight.left_of("red", "blue")
        assert not sight.above("red", "blue")


def test_answers_are_of_now() -> None:
    """A ball that rolls off the picture is seen less and less, and then not at all."""
    simulation = Simulation(dt=0.1, gravity=(0.0, 0.0, 0.0))
    simulation.add(name="ball", body={}, collider={"sphere": {"radius": 0.5}}, motion={"linear": (10.0, 0.0, 0.0)})
    simulation.add(**box("stone", (1.0, 1.0, 1.0), (-2.0, 0.0, 0.0)))
    with Sight(simulation, SHOT) as sight:
        assert sight.visible("ball") > 500
        simulation.step(10)
        assert sight.visible("ball") == 0
        assert sight.box("ball") is None
        assert sight.visible_share("ball") == 0.0
        assert not sight.left_of("stone", "ball") and not sight.left_of("ball", "stone")


def test_who_has_nothing_to_show_cannot_be_asked_for() -> None:
    """Nor can who does not exist."""
    simulation = simulation_of(box("crate", (1.0, 1.0, 1.0), (0.0, 0.0, 0.0)), {"name": "mark"})
    with Sight(simulation, SHOT) as sight:
        with pytest.raises(CaromError) as caught:
            sight.visible("mark")
        assert str(caught.value) == "sight: nothing is drawn of 'mark'; give it a collider or a visual"
        with pytest.raises(CaromError):
            sight.visible("crat")
