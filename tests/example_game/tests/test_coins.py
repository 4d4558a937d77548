"""Marbles take coins."""

from pathlib import Path

from carom.worlds import load_world

SLOPE = Path(__file__).parents[1] / "worlds" / "slope.yaml"


def test_a_coin_is_taken_once(carom_snapshot):
    """After the first coin: the state, the marble's purse in it, and the picture without that coin."""
    world = load_world(SLOPE)
    game = world.simulation
    game.step(237)
    assert game["marble"].purse.points == 1
    assert game["copper"].coin.taken and not game["gold"].coin.taken
    carom_snapshot.check(world, "first_coin")
    game.step(60)
    assert game["marble"].purse.points == 1


def test_a_second_marble_takes_what_is_left(carom_snapshot):
    """Worlds of files can be changed before they run."""
    world = load_world(SLOPE)
    game = world.simulation
    game.add(
        name="second",
        collider={"sphere": {"radius": 0.1}},
        body={},
        purse={},
        material={"color": (0.8, 0.2, 0.2)},
        transform={"position": (1.2, -0.05, 0.6)},
    )
    game.step(400)
    assert [game[name].purse.points for name in ("marble", "second")] == [6, 1]
    carom_snapshot.check(world, "two_marbles")
