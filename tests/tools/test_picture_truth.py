"""Pictures are true: areas, depths and ids of a sphere, a box and a plane against closed forms, through both lenses."""

from __future__ import annotations

import math

import numpy as np
import pytest
from trimesh.creation import box, icosphere

from carom.tools.batch import LARGEST_ID, Batch
from carom.tools.cameras import Camera
from carom.tools.renderer import Renderer

WIDTH, HEIGHT = 320, 240
RADIUS = 0.8
BALL = icosphere(subdivisions=5, radius=RADIUS)
INNER = float(np.einsum("ij,ij->i", BALL.face_normals, BALL.triangles[:, 0]).min())  # of the ball within its facets
HALF = np.array((0.7, 0.4, 0.5))
BOX = box(extents=2.0 * HALF)
SQUARE = box(extents=(60.0, 60.0, 1.0))
LENSES = {
    "pinhole": Camera((1.2, 1.9, 4.1), (0.3, 0.1, 0.2), fov=math.radians(50.0)),
    "parallel": Camera((1.2, 1.9, 4.1), (0.3, 0.1, 0.2), height=3.1),
}


@pytest.fixture(params=LENSES)
def camera(request: pytest.FixtureRequest) -> Camera:
    """Return a camera that looks slantwise at a place beside the origin."""
    return LENSES[request.param]


def at(mesh: object, numbers: np.ndarray, *places: tuple[float, float, float]) -> Batch:
    """Return copies of a trimesh with those ids."""
    poses = np.tile(np.eye(4), (len(numbers), 1, 1))
    poses[:, :3, 3] = np.reshape(places or [(0.0, 0.0, 0.0)], (-1, 3))
    return Batch(mesh.vertices, mesh.faces, poses, np.ones((len(numbers), 4)), numbers)  # type: ignore[attr-defined]


def sights(camera: Camera) -> tuple[np.ndarray, np.ndarray]:
    """Return origins and directions (h, w, 3) of the rays through pixel centres, of length 1 along the camera's -z."""
    y = camera.reach * (1.0 - 2.0 * (np.arange(HEIGHT) + 0.5) / HEIGHT)
    x = camera.reach * WIDTH / HEIGHT * (2.0 * (np.arange(WIDTH) + 0.5) / WIDTH - 1.0)
    screen, turn = np.stack([*np.meshgrid(x, y), np.zeros((HEIGHT, WIDTH))], axis=-1), camera.pose()[:3, :3]
    if camera.height is None:
        ways = (screen / camera.distance - (0.0, 0.0, 1.0)) @ turn.T
        return np.broadcast_to(camera.position, ways.shape), ways
    return camera.position + screen @ turn.T, np.broadcast_to(-turn[:, 2], screen.shape)


def resolution(depth: np.ndarray, camera: Camera) -> np.ndarray:
    """Return twice the step of a depth buffer of 24 bits at ``depth`` (m), once each for rounding and interpolation.

    Where depth changes from pixel to pixel, OpenGL's grid of 1/256 pixel for corners adds a part of that.
    """
    near, far = camera.planes
    step = (far - near) / 2**24 if camera.height else depth**2 * (far - near) / (near * far * 2**24)
    slope = np.maximum(*(np.abs(np.gradient(depth, axis=axis)) for axis in (0, 1)))
    return 2.0 * step + 1e-6 * depth + slope / 128.0


def past_sphere(camera: Camera, radius: float) -> np.ndarray:
    """Return the depth (h, w) at which rays meet a sphere around the origin, infinite where they pass it."""
    starts, ways = sights(camera)
    a, b = (ways * ways).sum(-1), (starts * ways).sum(-1)
    under = b * b - a * ((starts * starts).sum(-1) - radius**2)
    return np.where(under > 0.0, (-b - np.sqrt(np.maximum(under, 0.0))) / a, np.inf)


def past_box(camera: Camera, half: np.ndarray) -> np.ndarray:
    """Return the depth (h, w) at which rays meet a box around the origin, infinite where they pass it."""
    starts, ways = sights(camera)
    with np.errstate(divide="ignore"):
        slabs = np.stack([(sign * half - starts) / ways for sign in (-1.0, 1.0)])
    entered, left = slabs.min(axis=0).max(axis=-1), slabs.max(axis=0).min(axis=-1)
    return np.where(entered < left, entered, np.inf)


def pixels_per_metre(camera: Camera) -> float:
    """Return the scale at the target, or at 1 m before a pinhole."""
    return HEIGHT / 2.0 / (camera.reach if camera.height else math.tan(camera.fov / 2.0))


def test_a_sphere_covers_the_area_of_its_silhouette(renderer: Renderer, camera: Camera) -> None:
    """A pinhole sees a cone of half angle asin(r / d) as an ellipse, parallel light a disc of its radius."""
    covered = int((renderer.ids([at(BALL, np.array([7]))], camera) == 7).sum())
    centre = np.linalg.inv(camera.pose())[:3, 3]
    distance = float(np.linalg.norm(centre))
    areas = []
    for radius in (INNER, RADIUS):
        sine, cosine = radius / distance, -centre[2] / distance
        ellipse = sine**2 * math.sqrt(1.0 - sine**2) / (cosine**2 - sine**2) ** 1.5
        areas.append(math.pi * (radius**2 if camera.height else ellipse) * pixels_per_metre(camera) ** 2)
    rounding = math.sqrt(2.0 * math.sqrt(math.pi * areas[1]))  # a pixel counts by its centre
    assert areas[0] - rounding < covered < areas[1] + rounding
    assert areas[1] - areas[0] < 0.002 * areas[1]


def test_every_ray_that_meets_a_sphere_shows_it_at_its_depth(renderer: Renderer, camera: Camera) -> None:
    """Ids and depths lie between those of the spheres within and around the facets, pixel by pixel."""
    drawn = [at(BALL, np.array([7]))]
    seen, depth = renderer.ids(drawn, camera) == 7, renderer.depth(drawn, camera)
    within, around = past_sphere(camera, INNER), past_sphere(camera, RADIUS)
    assert seen[np.isfinite(past_sphere(camera, INNER - 0.002))].all()
    assert not seen[np.isinf(past_sphere(camera, RADIUS + 0.002))].any()
    assert np.isinf(depth[~seen]).all()
    sure = np.isfinite(past_sphere(camera, 0.97 * RADIUS))
    least, most = around[sure], within[sure]
    off = np.maximum(least - depth[sure], depth[sure] - most)
    with np.errstate(invalid="ignore"):
        assert (off < resolution(around, camera)[sure]).all()
    assert sure.sum() > 3000


def test_a_box_covers_the_area_of_the_hull_of_its_corners(renderer: Renderer, camera: Camera) -> None:
    """By Gauss's formula, through either lens, and within what counting by centres allows."""
    covered = int((renderer.ids([at(BOX, np.array([3]))], camera) == 3).sum())
    clip = camera.projection(WIDTH / HEIGHT) @ np.linalg.inv(camera.pose())
    corners = np.column_stack([BOX.vertices, np.ones(8)]) @ clip.T
    x, y = (corners[:, :2] / corners[:, 3:]).T * np.array([[WIDTH / 2.0], [HEIGHT / 2.0]])
    hull = np.array(sorted_hull(np.column_stack([x, y])))
    after = np.roll(hull, -1, axis=0)
    area = 0.5 * abs(float((hull[:, 0] * after[:, 1] - hull[:, 1] * after[:, 0]).sum()))
    edges = float(np.linalg.norm(after - hull, axis=1).sum())
    assert abs(covered - area) < math.sqrt(edges)
    assert covered > 5000


def sorted_hull(points: np.ndarray) -> list[np.ndarray]:
    """Return the corners of the convex hull of points (n, 2), anticlockwise: Andrew's monotone chain."""
    ordered = points[np.lexsort(points.T[::-1])]
    chains = []
    for side in (ordered, ordered[::-1]):
        chain: list[np.ndarray] = []
        for point in side:
            while len(chain) > 1 and np.linalg.det(np.stack([chain[-1] - chain[-2], point - chain[-1]])) <= 0.0:
                chain.pop()
            chain.append(point)
        chains += chain[:-1]
    return chains


def test_every_ray_that_meets_a_box_shows_it_at_its_depth(renderer: Renderer, camera: Camera) -> None:
    """Pixel by pixel, by slabs; only rays within a thousandth of an edge may go either way."""
    drawn = [at(BOX, np.array([3]))]
    seen, depth = renderer.ids(drawn, camera) == 3, renderer.depth(drawn, camera)
    inside, outside = np.isfinite(past_box(camera, HALF - 1e-3)), np.isinf(past_box(camera, HALF + 1e-3))
    assert seen[inside].all() and not seen[outside].any()
    assert (~inside & ~outside).sum() < 100
    assert np.isinf(depth[~seen]).all()
    truth = past_box(camera, HALF)
    with np.errstate(invalid="ignore"):
        close = np.abs(depth - truth) < resolution(truth, camera)
        beside = np.isfinite(np.gradient(truth, axis=0)) & np.isfinite(np.gradient(truth, axis=1))
    assert close[inside & beside].all()
    assert (inside & beside).sum() > 5000


def test_every_ray_that_meets_a_plane_shows_it_at_its_depth(renderer: Renderer, camera: Camera) -> None:
    """A wall through z = 0 fills the picture; each pixel's depth is that of its own ray."""
    drawn = [at(SQUARE, np.array([5]), (0.0, 0.0, -0.5))]
    starts, ways = sights(camera)
    truth = -starts[..., 2] / ways[..., 2]
    assert (renderer.ids(drawn, camera) == 5).all()
    assert (np.abs(renderer.depth(drawn, camera) - truth) < resolution(truth, camera)).all()


def test_the_ids_of_ten_thousand_bodies_are_exact(renderer: Renderer) -> None:
    """Two bodies in a pixel's breadth of each other keep their ids, up to the largest, and each is seen.

    Parallel light makes 100 by 100 cubes cells of a checkerboard, 2.4 pixels wide, whose ids the rays tell.
    """
    side, camera = 100, Camera((0.0, 0.0, 60.0), height=100.0)
    places = np.stack([*np.meshgrid(np.arange(side) - 49.5, np.arange(side) - 49.5), np.zeros((side, side))], axis=-1)
    numbers = np.random.default_rng(2).choice(LARGEST_ID + 1, side * side, replace=False)
    numbers[0] = LARGEST_ID
    ids = renderer.ids([at(box(extents=(1.0, 1.0, 1.0)), numbers, *places.reshape(-1, 3))], camera)
    starts, _ = sights(camera)
    cell = np.floor(starts[..., :2] + 50.0).astype(int)
    inside = ((cell >= 0) & (cell < side)).all(axis=-1)
    column, row = np.clip(cell, 0, side - 1).transpose(2, 0, 1)
    truth = np.where(inside, numbers.reshape(side, side)[row, column], -1)
    on_edge = (np.abs(starts[..., :2] - np.round(starts[..., :2])) < 1e-3).any(axis=-1)
    assert np.array_equal(ids[~on_edge], truth[~on_edge])
    assert set(ids[ids >= 0].tolist()) == set(numbers.tolist())


def test_several_cameras_see_what_each_sees_alone(renderer: Renderer) -> None:
    """To the bit, whichever come before, with shadows of one sun and with bodies that shine through."""
    bodies = at(BOX, np.arange(3), (0.0, 0.0, 0.0), (1.0, 0.5, -1.0), (-1.0, 0.2, 0.5))
    bodies.colors[1] = (0.2, 0.4, 0.9, 0.5)
    ground = at(SQUARE, np.array([9]), (0.0, 0.0, -1.2))
    cameras = [*LENSES.values(), Camera((-3.0, 2.0, 2.0)), Camera((3.0, 2.0, 2.0)), Camera((0.0, 1.0, 4.0))]
    alone = [renderer.picture([ground, bodies], camera) for camera in cameras]
    for order in (range(5), (4, 2, 3, 3, 0, 1)):
        pictures = renderer.pictures([ground, bodies], [cameras[number] for number in order])
        assert all(np.array_equal(picture, alone[number]) for picture, number in zip(pictures, order, strict=True))
    assert renderer.pictures([ground, bodies], []) == []
