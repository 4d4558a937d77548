"""What joints tell: words for where b is against a, and the names of the six ways."""

from __future__ import annotations

from carom.ecs import World
from carom.ecs.components.joint import LINE, SWING_TWIST, Joint
from carom.systems.freedom import AXES

WAYS = AXES
TURNS = 3  # the first way that is a turn
READINGS = {
    "length": ("position", "x"),
    "distance": ("position", "x"),
    "angle": ("position", "rotation_x"),
    "swing": ("position", "rotation_y"),
    "second_angle": ("position", "rotation_z"),
}


def readings(world: World, name: str) -> list[str]:
    """Return the words that an entity has as a joint: of what it measures along and about. No joint comes later."""
    entity = world.names_now().entities.get(name)
    if entity is None or not world.table(Joint).present[row := world.row(entity)]:
        return []
    joint = world[Joint]
    if joint.along[row] == LINE:
        return ["length"]
    return ["angle", "distance", "swing" if joint.about[row] == SWING_TWIST else "second_angle"]


def spelled_out(world: World, name: str, steps: list[str]) -> list[str]:
    """Return the column and the way that a word of a joint stands for; other steps as they are."""
    return list(READINGS[steps[0]]) if steps[0] in readings(world, name) and len(steps) == 1 else steps
