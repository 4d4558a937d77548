"""Every world of the library holds what it expects, leads where it led to the last bit, and looks as it did."""

from __future__ import annotations

from typing import Any

import pytest
from lessons import run

from carom.systems.simulation import Simulation
from carom.worlds import library, load_world

FRAMES = {  # of goldens: when there is most to see
    "billiards": 240,
    "binary_star": 300,
    "blast": 60,
    "bounce": 80,
    "bowling": 1326,
    "bridge": 480,
    "bullet_holes": 23,
    "camera_follow": 60,
    "cannon": 480,
    "chain": 480,
    "chairoplane": 240,
    "conveyor": 240,
    "dominoes": 1200,
    "door": 240,
    "double_pendulum": 480,
    "falling_ball": 2,
    "fireworks": 156,
    "fountain": 144,
    "frames": 60,
    "glider": 720,
    "golf": 120,
    "gravity_well": 200,
    "head_on": 90,
    "heap": 600,
    "isochrone": 200,
    "jump": 78,
    "leaning_tower": 240,
    "lens": 60,
    "line_of_sight": 600,
    "mirror_image": 180,
    "mirror_room": 140,
    "newtons_cradle": 480,
    "orbit": 720,
    "parachute": 390,
    "pendulums": 120,
    "pillar": 372,
    "pong": 60,
    "robot_arm": 480,
    "rocket": 54,
    "rolling_race": 360,
    "sand_storm": 144,
    "ship_in_water": 90,
    "slider_crank": 360,
    "slope": 216,
    "snapping_rope": 336,
    "solar_system": 300,
    "spinning_top": 360,
    "spring_mass": 120,
    "swing_in_steps": 30,
    "trap": 420,
    "tumbling": 720,
    "valleys": 180,
    "vapour_trail": 108,
    "whip": 240,
}


@pytest.mark.parametrize("world", library.names())
def test_a_world_holds_what_it_expects_and_leads_where_it_led(world: str, carom_snapshot: Any) -> None:
    """State and picture in mid-run are those of the golden; an update needs a line in the changelog.

    Every bit of the state counts, whichever processor wrote the golden: bits hang on none.
    """
    loaded = load_world(world)

    def compare(simulation: Simulation) -> None:
        if simulation.frame == FRAMES[world]:
            carom_snapshot.check(loaded, world, tolerance=0.0)

    failed = [str(outcome) for outcome in run(loaded, each=compare) if not outcome.held]
    assert failed == []
    assert FRAMES[world] <= loaded.simulation.frame
