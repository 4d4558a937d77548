"""Every quantity that a world of the library states is noticed by its expectations, or it is said why it cannot be."""

from __future__ import annotations

import pytest
from lessons import run
from quantities import quantities, turned

from carom.worlds import library

# What leaves all that is expected as it was, and why: world and path.
IMMATERIAL = {
    "mass falls out of what falls freely, flies by a field or turns": """
        falling_ball entities.ball.body.mass
        fireworks prefabs.shell.body.mass
        gravity_well entities.ship.body.mass
        pendulums prefabs.swing.body.mass
        rocket entities.stone.body.mass
        rocket entities.moonstone.body.mass
        trap entities.gate.body.mass
        tumbling prefabs.book.body.mass
        vapour_trail entities.jet.body.mass
        whip entities.stone.body.mass""",
    "mass falls out of what strikes, slides and rolls on what does not move": """
        bounce prefabs.ball.body.mass
        conveyor entities.light.body.mass
        conveyor entities.heavy.body.mass
        jump prefabs.figure.body.mass
        mirror_image prefabs.ball.body.mass
        mirror_room entities.ball.body.mass
        pillar prefabs.ball.body.mass
        pong entities.ball.body.mass
        rolling_race entities.sledge.body.mass
        rolling_race entities.ball.body.mass
        rolling_race entities.cylinder.body.mass
        slope prefabs.block.body.mass
        slope entities.rubber.body.mass""",
    "mass falls out where all have the same": "dominoes prefabs.domino.body.mass",
    "gravity and mass fall out of a balance": """
        leaning_tower gravity
        leaning_tower prefabs.plank.body.mass""",
    "nothing in it falls": "vapour_trail gravity",
    "it pulls others by less than is expected of their places": """
        solar_system entities.mercury.body.mass
        solar_system entities.venus.body.mass
        solar_system entities.earth.body.mass
        solar_system entities.mars.body.mass""",
    "no formula tells how sand goes on that lies and is blown about": "sand_storm entities.sand.emitter.mass",
    "of two restitutions the larger counts, and that is another's": """
        bowling materials.lane.restitution
        bowling materials.ball.restitution
        mirror_room entities.ball.material.restitution""",
    "no ball comes to it": "billiards materials.wood.restitution.value",
    "boulders lie against it, none strikes it": "trap entities.gate.material.restitution",
    "those who are pushed on strike again until they go together": """
        dominoes prefabs.domino.material.restitution
        dominoes entities.floor.material.restitution""",
}
SILENT = {line.strip(): why for why, lines in IMMATERIAL.items() for line in lines.splitlines() if line.strip()}
STATED = [
    (f"{name} {path}", name, kind, place)
    for name in library.names()
    for path, (kind, place) in quantities(library.find(name)).items()
]


def first_of_its_kind(index: int) -> bool:
    """Whether no other quantity before it is of this world and kind."""
    return STATED[index][1:3] not in [one[1:3] for one in STATED[:index]]


@pytest.mark.parametrize(
    ("stated", "name", "kind", "place"),
    [
        pytest.param(*one, id=one[0], marks=() if first_of_its_kind(index) else pytest.mark.slow)
        for index, one in enumerate(STATED)
    ],
)
def test_a_quantity_that_is_off_is_noticed(stated: str, name: str, kind: str, place: tuple[str | int, ...]) -> None:
    """Gravity off by 1 %, a mass by 5 %, a restitution by 0.1: one expectation fails, or all hold as is said."""
    outcomes = run(turned(name, place, kind), to_first_failure=True)
    assert all(outcome.held for outcome in outcomes) == (stated in SILENT), SILENT.get(stated)


def test_nothing_is_excused_that_is_not_there() -> None:
    """Each line of the list names a quantity of a world."""
    assert SILENT.keys() <= {stated for stated, *_ in STATED}
