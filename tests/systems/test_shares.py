"""With whose surface contact points go: with who lies on a face, whatever shape that is a face of."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from carom.ecs.relations.contact import Contact
from carom.systems.shapes.convex import Convex
from carom.systems.shapes.geometry import hull_of
from carom.systems.simulation import Simulation

CORNERS = np.array([(x, y, z) for x in (-1.0, 1.0) for y in (-1.0, 1.0) for z in (-1.0, 1.0)])
HULL = {"shape": Convex(hull_of(CORNERS))}
DISC, PUCK, CONE = ({key: {"radius": r, "length": 2.0}} for key, r in (("cylinder", 1), ("cylinder", 0.5), ("cone", 1)))
BALL, BOX = {"sphere": {"radius": 0.3}}, {"box": {"size": (0.6, 0.6, 0.6)}}
LYING, UPSIDE_DOWN = (np.sqrt(0.5), 0.0, 0.0, np.sqrt(0.5)), (1.0, 0.0, 0.0, 0.0)
CAPSULE, DRUM = {"capsule": {"radius": 0.3, "length": 0.4}}, {"cylinder": {"radius": 0.3, "length": 0.6}}
EGG = {"ellipsoid": {"radii": (0.3, 0.3, 0.5)}}
FLAT, PEAK = np.ones((9, 9)), np.pad(np.ones((1, 1)), 4)
ABOVE, BELOW, NEITHER = 1.0, 0.0, 0.5  # with whom points go


def shares_of(below: dict[str, Any], above: dict[str, Any], *, first: bool) -> set[float]:
    """Return the shares of contacts between what lies still and who is above it; in the world that one is the first.

    They are those of the one above, likewise after five steps in which contacts are recycled.
    """
    simulation = Simulation(sleeping=False)
    still: dict[str, Any] = {"body": {"type": "kinematic"}, **below}
    who: dict[str, Any] = {"body": {"mass": 1.0}, "material": {"rolling_friction": 0.1}, **above}
    for one in (who, still) if first else (still, who):
        simulation.add(**{key: value for key, value in one.items() if value is not None})
    simulation.step()
    contact = simulation.world[Contact]
    found = contact.share[: contact.count].tolist()
    assert found
    simulation.step(5)
    found += contact.share[: contact.count].tolist()
    return {1.0 - share for share in found} if first else set(found)


def at(x: float, y: float, rotation: tuple[float, ...] = (0.0, 0.0, 0.0, 1.0)) -> dict[str, Any]:
    """Return the words of a place."""
    return {"position": (x, y, 0.0), "rotation": rotation}


@pytest.mark.parametrize("first", [False, True])
@pytest.mark.parametrize(
    ("below", "place", "above", "where", "share"),
    [
        (DISC, at(0.0, 0.0), BALL, at(0.4, 1.3), ABOVE),
        (DISC, at(0.0, 0.0), CAPSULE, at(0.4, 1.3, LYING), ABOVE),
        (DISC, at(0.0, 0.0), DRUM, at(0.4, 1.3, LYING), ABOVE),
        (DISC, at(0.0, 0.0), EGG, at(0.4, 1.3), ABOVE),
        (DISC, at(0.0, 0.0), BOX, at(0.2, 1.3), ABOVE),
        (DISC, at(0.0, 0.0), HULL, at(0.0, 2.0), BELOW),  # all of whose points are on the rim
        (DISC, at(0.0, 0.0), PUCK, at(0.4, 2.0), ABOVE),
        (PUCK, at(0.0, 0.0), DISC, at(0.4, 2.0), BELOW),
        (DISC, at(0.0, 0.0), DISC, at(0.0, 2.0), NEITHER),
        (CONE, at(0.0, 0.0, UPSIDE_DOWN), BALL, at(0.4, 1.3), ABOVE),
        (HULL, at(0.0, 0.0), BALL, at(0.4, 1.3), ABOVE),
        (HULL, at(0.0, 0.0), CAPSULE, at(0.4, 1.3, LYING), ABOVE),
        (HULL, at(0.0, 0.0), DISC, at(0.0, 2.0), ABOVE),
        (HULL, at(0.0, 0.0), HULL, at(0.0, 2.0), NEITHER),
        ({"box": {"size": (2.0, 2.0, 2.0)}}, at(0.0, 0.0), EGG, at(0.4, 1.3), ABOVE),
    ],
)
def test_points_go_with_who_lies_on_a_face(
    below: dict[str, Any],
    place: dict[str, Any],
    above: dict[str, Any],
    where: dict[str, Any],
    share: float,
    first: bool,
) -> None:
    """In whichever order they came, and after contacts have gone along with their shapes."""
    found = shares_of({"collider": below, "transform": place}, {"collider": above, "transform": where}, first=first)
    assert found == {share}


@pytest.mark.parametrize("heights", [FLAT, PEAK], ids=["flat", "peak"])
@pytest.mark.parametrize("collider", [PUCK, CONE], ids=["cylinder", "cone"])
def test_nobody_looks_for_ends_on_land(collider: dict[str, Any], heights: np.ndarray) -> None:
    """Of land points go with who is no land anyway (`goes_with_b`), on the top of a peak within the rim, too."""
    field = {"height_field": {"heights": heights.tolist(), "spacing": 0.5}}
    land = {"collider": field, "body": None, "transform": at(0.0, -1.0)}
    assert shares_of(land, {"collider": collider, "transform": at(0.0, 1.0)}, first=False) == {NEITHER}


def test_a_ball_on_an_edge_lies_on_no_face() -> None:
    """Over an edge its normal leads from that."""
    edge = {"collider": HULL, "transform": at(0.0, 0.0, (0.0, 0.0, np.sin(np.pi / 8), np.cos(np.pi / 8)))}
    ball = {"collider": BALL, "transform": at(0.0, np.sqrt(2.0) + 0.3)}
    assert shares_of(edge, ball, first=False) == {NEITHER}
