"""Goldens of library worlds: what the same file leads to, to the last bit, and how it looks."""

from __future__ import annotations

from typing import Any

import pytest

from carom.worlds import load_world


@pytest.mark.parametrize(
    ("world", "frames"),
    [
        ("billiards", 240),
        ("blast", 60),
        ("bowling", 1248),
        ("bullet_holes", 23),
        ("camera_follow", 60),
        ("cannon", 240),
        ("dominoes", 1200),
        ("double_pendulum", 480),
        ("falling_ball", 3),
        ("gravity_well", 200),
        ("fireworks", 156),
        ("fountain", 144),
        ("golf", 120),
        ("jump", 78),
        ("line_of_sight", 600),
        ("mirror_room", 120),
        ("newtons_cradle", 480),
        ("parachute", 390),
        ("pong", 60),
        ("ship_in_water", 90),
        ("solar_system", 300),
        ("sand_storm", 144),
        ("trap", 420),
        ("vapour_trail", 108),
        ("whip", 240),
    ],
)
def test_a_world_leads_where_it_led_before(world: str, frames: int, carom_snapshot: Any) -> None:
    """State and picture after some frames are those of the golden; an update needs a line in the changelog."""
    loaded = load_world(world)
    loaded.simulation.step(frames)
    carom_snapshot.check(loaded, world)
