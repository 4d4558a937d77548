"""Shapes of `full`: every collider as a solid of its size and pose, in the colours of every mode."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from carom.ecs import Collider, Transform
from carom.ecs.spatial import quaternion
from carom.systems.shapes import SHAPES
from carom.systems.simulation import Simulation
from carom.tools.coloring import Coloring
from carom.tools.reading import Written, read
from carom.tools.recorder import Recorder
from carom.tools.recorder.solids import SOLIDS, solid_of
from carom.tools.recorder.tracks.shapes import PATH, SCENES, packed

COLLIDERS: dict[str, dict[str, Any]] = {
    "ball": {"sphere": {"radius": 0.1}},
    "egg": {"ellipsoid": {"radii": (0.1, 0.2, 0.3)}},
    "box": {"box": {"size": (0.2, 0.4, 0.6)}, "position": (0.0, 0.1, 0.0), "rotation": (0.6, 0.0, 0.0, 0.8)},
    "capsule": {"capsule": {"radius": 0.1, "length": 0.4}},
    "cylinder": {"cylinder": {"radius": 0.1, "length": 0.4}},
    "cone": {"cone": {"radius": 0.1, "length": 0.4}},
}
SIZES = {
    "balls": {"half_sizes": [(0.1, 0.1, 0.1), (0.1, 0.2, 0.3)]},
    "boxes": {"half_sizes": [(0.1, 0.2, 0.3)]},
    "capsules": {"radii": [0.1], "lengths": [0.4]},
    "cylinders": {"radii": [0.1], "lengths": [0.4]},
    "bounding_boxes": {"half_sizes": [(0.1, 0.2, 0.1)]},
}


@pytest.fixture(scope="module")
def run(tmp_path_factory: pytest.TempPathFactory) -> tuple[Written, dict[int, dict[str, Any]]]:
    """Return what is recorded of one of each that turns, and poses and colours of each frame by name."""
    simulation = Simulation(dt=1 / 60, gravity=(0.0, 0.0, 0.0))
    simulation.add(name="floor", collider={"plane": {"offset": -5.0}})
    for place, (name, collider) in enumerate(COLLIDERS.items()):
        simulation.add(
            name=name, collider=collider, body={}, visual={"visible": name != "egg"},
            transform={"position": (2.0 * place, 0.0, 0.0)}, motion={"linear": (0, place, 0), "angular": (1, 2, 3)},
        )  # fmt: skip
    path = tmp_path_factory.mktemp("shapes") / "shapes.rrd"
    recorder = Recorder(path, every=1, detail="full")
    colorings, seen = {mode: Coloring(mode) for mode in SCENES}, {}
    recorder.begin(simulation)
    for frame in range(6):
        if frame:
            if frame == 3:
                simulation.world.despawn(simulation.world.find("ball"))
            simulation.step()
            recorder.observe(simulation)
        seen[frame] = known(simulation, colorings)
    recorder.end(simulation)
    return read(path), seen


def known(simulation: Simulation, colorings: dict[str, Coloring]) -> dict[str, Any]:
    """Return position and rotation of each collider's shape, and its colours."""
    world = simulation.world
    rows = world.row_numbers(Collider)
    colors = {mode: packed(coloring.colors(world, rows)) for mode, coloring in colorings.items()}
    found = {}
    for place, row in enumerate(rows.tolist()):
        turned, collider = world[Transform].rotation[[row]], world[Collider]
        position = world[Transform].position[[row]] + quaternion.rotate(turned, collider.position[[row]])
        rotation = quaternion.multiply(turned, collider.rotation[[row]])
        told = {mode: values[place] for mode, values in colors.items()}
        found[world.name(world.entity(row))] = (int(world.entity(row)), position, rotation, told)
    return found


def at(written: Written, solid: str, component: str, frame: int) -> Any:
    """Return what holds of a solid's instances in a frame."""
    found = written.series[f"/{PATH}/{solid}", component].at(frame)
    assert found is not None
    return found[1]


def test_every_shape_has_a_solid_or_stands() -> None:
    """New shapes get their bounds; what has no end is drawn as it looks."""
    assert {key for key, shape in SHAPES.items() if solid_of(shape) is None} == {"plane", "mesh", "height_field"}


def test_instances_are_colliders_at_their_sizes(run: tuple[Written, dict[int, dict[str, Any]]]) -> None:
    """By their handles and names, also after one has gone."""
    written, seen = run
    of_solids = {"balls": ["ball", "egg"], "boxes": ["box"], "bounding_boxes": ["cone"]}
    for solid, names in (of_solids | {"capsules": ["capsule"], "cylinders": ["cylinder"]}).items():
        archetype = SOLIDS[solid].archetype
        for frame in seen:
            here = [name for name in names if name in seen[frame]]
            assert at(written, solid, "collider", frame).tolist() == [seen[frame][name][0] for name in here]
            assert at(written, solid, f"{archetype}:labels", frame) == here
            for field, sizes in SIZES[solid].items():
                expected = np.array(sizes[len(names) - len(here) :], np.float32)
                assert at(written, solid, f"{archetype}:{field}", frame) == pytest.approx(expected, rel=1e-6)


def test_solids_are_where_colliders_are(run: tuple[Written, dict[int, dict[str, Any]]]) -> None:
    """Rerun's capsules and cylinders are along z, and its capsules begin at one end."""
    written, seen = run
    for frame, world in seen.items():
        for solid, name in (("balls", "egg"), ("boxes", "box"), ("cylinders", "cylinder"), ("capsules", "capsule")):
            archetype = SOLIDS[solid].archetype
            place = at(written, solid, "collider", frame).tolist().index(world[name][0])
            _, position, rotation, _ = world[name]
            turned = at(written, solid, f"{archetype}:quaternions", frame)[place][None].astype(np.float64)
            if solid in ("cylinders", "capsules"):
                axis, theirs = quaternion.rotate(rotation, (0, 1, 0)), quaternion.rotate(turned, (0, 0, 1))
                assert theirs == pytest.approx(axis, abs=1e-6)
            else:
                assert np.array_equal(turned, rotation.astype(np.float32))
            if solid == "capsules":
                middle = at(written, solid, "Capsules3D:translations", frame)[place] + 0.2 * theirs
                assert middle == pytest.approx(position, abs=1e-6)
            else:
                assert np.array_equal(
                    at(written, solid, f"{archetype}:centers", frame)[place], position[0].astype("f4")
                )


def test_every_mode_of_colour_is_recorded(run: tuple[Written, dict[int, dict[str, Any]]]) -> None:
    """As pictures have it, for every instance in every frame, all modes over the same poses."""
    written, seen = run
    for frame, world in seen.items():
        for solid in SIZES:
            handles = at(written, solid, "collider", frame).tolist()
            known = {handle: told for handle, _, _, told in world.values()}
            for mode in SCENES:
                assert at(written, solid, mode, frame).tolist() == [known[handle][mode] for handle in handles]
    assert len({told["speed"] for _, _, _, told in seen[5].values()}) > 4


def test_a_legend_tells_what_colours_mean(run: tuple[Written, dict[int, dict[str, Any]]]) -> None:
    """Names with words for their colours, ends of scales, and when these change."""
    texts = run[0].series["/colours", "TextDocument:text"]
    first, last = (texts.at(frame) for frame in (0, 5))
    assert first is not None
    assert last is not None
    assert first[1][0].splitlines() == [
        "- **Shapes**: each its own, as it looks",
        "- **Sleep**: static gray, awake orange, eligible pale yellow, asleep slate blue",
        "- **Islands**: one for those that touch, directly or by way of others; gray for what cannot be pushed",
        "- **Layers**: none blue, default orange",
        "- **Speed**: speed from 0, dark blue, by green to 5 m/s, yellow",
        "- **Energy**: kinetic energy from 0, dark blue, by green to 200 J, yellow",
    ]
    assert last[0] == 0  # nobody is faster later on
