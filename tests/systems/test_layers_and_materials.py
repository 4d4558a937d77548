"""Who meets whom by layers, and how materials of two combine."""

from __future__ import annotations

import pytest
from faults import error
from meetings import touching

from carom.ecs import DeclarationError
from carom.ecs.relations.contact import Contact
from carom.systems.layers import Layers


@pytest.mark.parametrize(
    ("one", "other", "meet"),
    [
        ("red", "red", True),
        ("red", "blue", True),
        ("blue", "red", True),
        ("blue", "blue", False),
        ("green", "red", False),
        ("green", "green", True),
        ("deaf", "red", False),
        ("none", "default", False),
        ("none", "none", False),
        ("default", "default", True),
        ("red", "default", False),
    ],
)
def test_both_sides_must_accept(one: str, other: str, meet: bool) -> None:
    """Green accepts red, but red does not accept green; none meets nobody, not even itself."""
    simulation = touching({"collider": {"layer": one}}, {"collider": {"layer": other}})
    assert simulation.world.count(Contact) == int(meet)


def test_a_collider_may_state_whom_it_meets() -> None:
    """``collides_with`` stands in for what its layer accepts."""
    picky = {"collider": {"layer": "red", "collides_with": ["green"]}}
    assert touching(picky, {"collider": {"layer": "red"}}).world.count(Contact) == 0
    assert touching(picky, {"collider": {"layer": "green"}}).world.count(Contact) == 1


@pytest.mark.parametrize(
    ("name", "message"),
    [
        ("grean", "unknown layer 'grean'; did you mean 'green'?"),
        ("x", "unknown layer 'x'; the layers are none, default, red, blue, green, deaf"),
    ],
)
def test_an_unknown_layer(name: str, message: str) -> None:
    """A near name is proposed, else all are listed."""
    with error(DeclarationError, message):
        touching({"collider": {"layer": name}}, {})
    with error(DeclarationError, message):
        touching({"collider": {"collides_with": ["red", name]}}, {})


def test_there_is_an_end_to_layers() -> None:
    """All 62 bits are layers of their own; one more is refused."""
    layers = Layers()
    layers.define({f"layer{k}": None for k in range(61)})
    bits = [layers.bit(f"layer{k}") for k in range(61)]
    assert len({*bits, layers.bit("default")}) == 62
    assert all(0 < bit < 2**62 for bit in bits)
    with pytest.raises(DeclarationError, match=r"^at most 62 layers fit, 'more' is one too many$"):
        layers.define({"more": None})


X, Y = 0.2, 0.8
RULES = {"average": 0.5, "sqrt": 0.4, "min": 0.2, "multiply": 0.16, "max": 0.8}


@pytest.mark.parametrize("quantity", ["friction", "restitution"])
@pytest.mark.parametrize("first", [*RULES, None])
@pytest.mark.parametrize("second", [*RULES, None])
def test_the_stronger_rule_combines(quantity: str, first: str | None, second: str | None) -> None:
    """Max > multiply > min > sqrt > average > the default, which is sqrt for friction and max for restitution."""
    stated = [
        {"material": {quantity: value if rule is None else {"value": value, "combine": rule}}}
        for value, rule in ((X, first), (Y, second))
    ]
    order = ["average", "sqrt", "min", "multiply", "max"]
    chosen = [rule for rule in (first, second) if rule is not None]
    rule = max(chosen, key=order.index) if chosen else {"friction": "sqrt", "restitution": "max"}[quantity]
    contact = touching(*stated).world[Contact]
    assert getattr(contact, quantity)[0] == pytest.approx(RULES[rule], rel=1e-15)
