"""Blueprint: how a recording looks when it is opened."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any, Literal

import numpy as np

from carom.ecs import Collider, Motion, Transform, Visual, World
from carom.systems.compound import bounding_radii
from carom.tools.cameras import Camera, Vector, front
from carom.tools.recorder import about
from carom.tools.recorder.lanes import ROOT as LANES
from carom.tools.recorder.layout import Layout, Scene
from carom.tools.recorder.stream import TIME
from carom.tools.recorder.track import Track
from carom.tools.recorder.tracks.bodies import ROOT

BACKGROUND = (44, 50, 60)
STACKED = 4  # plots one below the other; there is room for one more, whose tabs are all others


def blueprint(
    world: World, camera: Camera, tracks: Iterable[Track], play: Literal["paused", "following"] = "paused"
) -> Any:
    """Return large views of the world, as tabs, beside the plots and texts of its tracks, on simulated time.

    It opens ``paused`` at the start, or ``following`` what comes.
    """
    import rerun.blueprint as rrb

    layout = Layout()
    for track in tracks:
        track.lay_out(world, layout)
    controls = rrb.EyeControls3D(position=camera.position, look_target=camera.target, eye_up=camera.up)
    first = Scene("World", [f"{ROOT}/**"], layout.overrides, grid=not has_scenery(world))
    scenes = [
        rrb.Spatial3DView(
            origin=ROOT,
            contents=[f"/{path}" for path in scene.contents],
            overrides=scene.overrides,
            name=scene.name,
            eye_controls=controls,
            line_grid=scene.grid,
            background=BACKGROUND,
        )
        for scene in (first, *layout.scenes)
    ]
    further = [rrb.Tabs(*layout.plots[STACKED:])] if layout.plots[STACKED:] else []
    curves = rrb.Vertical(*layout.plots[:STACKED], *further, name="Plots")
    lanes = [rrb.StateTimelineView(origin=LANES, name="States")] if layout.lanes else []
    texts = rrb.Tabs(*layout.texts, rrb.TextDocumentView(origin=about.PATH, name="About"))
    shares = [2.0, 0.5, 1.0] if lanes else [2.0, 1.0]
    return rrb.Blueprint(
        rrb.Horizontal(rrb.Tabs(*scenes), rrb.Vertical(curves, *lanes, texts, row_shares=shares), column_shares=[3, 1]),
        rrb.BlueprintPanel(state="collapsed"),
        rrb.SelectionPanel(state="collapsed"),
        rrb.TimePanel(timeline=TIME, state="collapsed", play_state=play),
        auto_views=False,
        auto_layout=False,
    )


def default_camera(world: World, up: Vector = (0.0, 1.0, 0.0)) -> Camera:
    """Return a camera that has everything bounded in view, from in front, above and a little to the right."""
    rows = world.row_numbers(Collider, Transform)
    reach = bounding_radii(world, rows)
    finite = np.isfinite(reach)
    axes = np.column_stack([np.cross(up, front(up)), up, front(up)])
    if not finite.any():
        return Camera(tuple(map(float, axes @ (3.0, 2.0, 4.0))), up=up)  # type: ignore[arg-type]
    positions, reach = world[Transform].position[rows][finite], reach[finite, None]
    lower, upper = (positions - reach).min(axis=0), (positions + reach).max(axis=0)
    target = (lower + upper) / 2.0
    distance = 0.9 * float(np.linalg.norm(upper - lower)) or 1.0  # of a single point
    away = axes @ (0.35, 0.55, 0.76) * distance
    return Camera(tuple(map(float, target + away)), tuple(map(float, target)), up)  # type: ignore[arg-type]


def has_scenery(world: World) -> bool:
    """Tell whether anything that never moves is drawn, which Rerun's grid would shine through."""
    return len(world.row_numbers(Visual, without=(Motion,))) > 0
