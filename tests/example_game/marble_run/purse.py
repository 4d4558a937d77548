"""Purses and coins: what is worth points, and who collects them."""

from carom.ecs import Component, column
from carom.ecs.column import Booleans, Integers


class Coin(Component):
    """What can be taken, once."""

    worth: Integers = column(unit="1", doc="points for whoever takes it", dtype="int32", default=1)
    taken: Booleans = column(unit="1", doc="whether somebody has taken it", dtype="bool")


class Purse(Component):
    """Who takes coins."""

    points: Integers = column(unit="1", doc="worth of all coins taken", dtype="int32")
