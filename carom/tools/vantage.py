"""Vantage: what a user should know of the place a picture is taken from."""

from __future__ import annotations

from carom.systems.simulation import Simulation
from carom.tools.filming import Shot
from carom.tools.rigs import Rig
from carom.tools.visible import visible_rows


def vantage_warnings(shot: Shot, simulation: Simulation) -> list[str]:
    """Return a line for a camera inside of bodies, and one where nothing is there to be seen, as the world is now."""
    world, found = simulation.world, []
    rows = visible_rows(world)
    camera = shot.camera(world)
    around = [entity for entity in simulation.space.point_inside(camera.position).tolist() if world.row(entity) in rows]
    if around:
        name = f"camera {shot.view.name}" if isinstance(shot.view, Rig) else "the camera"
        bodies = " and ".join(world.name(entity) or f"entity {entity}" for entity in around)
        found.append(f"{name} at {shown(camera.position)} m is inside {bodies}, which it sees through; move it out")
    if not len(rows):
        stated = "" if isinstance(shot.view, Rig) else ", and no camera is stated"
        found.append(
            f"nothing is there to be seen{stated}: pictures show the sky; give entities a collider or a visual"
        )
    return found


def shown(place: tuple[float, float, float]) -> str:
    """Return a place as a message shows it."""
    return f"[{', '.join(f'{number:g}' for number in place)}]"
