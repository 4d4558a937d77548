"""Taking coins."""

from carom.ecs import Visual, World, system
from carom.ecs.relations.enter import Enter
from carom.systems.places import placed
from marble_run.purse import Coin, Purse


@placed(before="clear_inputs")
@system(reads=(Enter,), writes=(Coin, Purse, Visual))
def take_coins(world: World, dt: float) -> None:
    """Give the worth of a coin to the first with a purse who comes into it; nobody sees it any more."""
    enter, coin, purse = world[Enter], world[Coin], world[Purse]
    coins, purses = set(world.row_numbers(Coin).tolist()), set(world.row_numbers(Purse).tolist())
    for event in range(enter.count):
        where, who = world.row(int(enter.sensor[event])), world.row(int(enter.entity[event]))
        if where in coins and who in purses and not coin.taken[where]:
            coin.taken[where] = True
            purse.points[who] += coin.worth[where]
            world[Visual].visible[where] = False
