"""Chains of files are those of Python, and tell what is wrong with them."""

from __future__ import annotations

import pytest

from carom.ecs import state_hash
from carom.systems.chains import WORLD, add_chain
from carom.systems.simulation import Simulation
from carom.worlds import WorldError, load_text

FILE = """carom: 1
entities:
  - {name: weight, body: {mass: 5}, transform: {position: [2, 1, 0]}}
  - name: bridge
    transform: {position: [0, 3, 0]}
    chain: {end: [4 m, 3, 0], count: 8, sag: 50 cm, b: world}
    collider: {box: {size: [0.05, 0.4, 1]}}
    body: {mass: 2}
    joint: {hinge: {axis: [0, 0, 1], friction: 0.1}}
  - {name: rope, transform: {position: [2, 3, 0]}, chain: {end: [2, 1, 0], count: 10, radius: 20 mm, b: weight}}
"""


def test_files_and_python_lay_the_same_chains() -> None:
    """To the last bit, also after half a second."""
    loaded, simulation = load_text(FILE).simulation, Simulation()
    simulation.add(name="weight", body={"mass": 5.0}, transform={"position": (2.0, 1.0, 0.0)})
    hinge = {"hinge": {"axis": (0.0, 0.0, 1.0), "friction": 0.1}}
    planks = {"collider": {"box": {"size": (0.05, 0.4, 1.0)}}, "body": {"mass": 2.0}}
    start, end = (0.0, 3.0, 0.0), (4.0, 3.0, 0.0)
    add_chain(simulation, "bridge", start, end, 8, sag=0.5, joint=hinge, b=WORLD, **planks)
    add_chain(simulation, "rope", (2.0, 3.0, 0.0), (2.0, 1.0, 0.0), 10, radius=0.02, b="weight")
    assert sorted(loaded.world.names()) == sorted(simulation.world.names())
    for one in (loaded, simulation):
        one.step(30)
    for name in ("bridge[3]", "rope[9]", "weight"):
        assert loaded[name].transform.position.tolist() == simulation[name].transform.position.tolist()
    again = load_text(FILE).simulation
    again.step(30)
    assert state_hash(again.world) == state_hash(loaded.world)


def test_joints_and_springs_may_name_links() -> None:
    """Also those that come before in the file."""
    text = FILE.replace(
        "entities:\n", "entities:\n  - {name: tie, spring: {a: 'rope[4]', b: 'bridge[1]', stiffness: 5}}\n"
    )
    simulation = load_text(text).simulation
    assert simulation["tie"].spring.a == simulation.world.find("rope[4]")


REFUSED = {
    ("b: weight", "b: wait"): (
        "10:102: entities.2.chain.b: unknown entity; received 'wait'; accepted: world, nobody, weight, bridge[0], "
        "bridge[1], bridge[2], bridge[3], bridge[4], bridge[5], bridge[6], bridge[7], rope[0], ...; "
        "did you mean 'weight'?"
    ),
    ("radius: 20 mm", "radius: 20 cm"): (
        "10:87: entities.2.chain.radius: must be above 0 and below half a link, 0.1 m; received 0.2; take fewer links"
    ),
    (", radius: 20 mm", ""): (
        "10:52: entities.2.chain: radius: state that of links that are capsules, or a collider of their own"
    ),
    ("count: 10", "sag: 1, count: 10"): (
        "10:76: entities.2.chain.sag: a chain from one point straight down to the other hangs to no side; leave it out"
    ),
    ("hinge: {axis: [0, 0, 1], friction: 0.1}", "rope: {}"): (
        "9:13: entities.1.joint.rope: holds no point, at which links meet; "
        "accepted: ball, fixed, generic, hinge, slider, universal"
    ),
    ("name: rope, transform: {", "transform: {"): (
        "10:40: entities.2.chain: has no name, after which its links are called; state name"
    ),
    ("{position: [2, 3, 0]}", "{position: [2, 3, 0], jitter: 1}"): (
        "10:63: entities.2.chain: says where its links are; remove transform.jitter"
    ),
}


@pytest.mark.parametrize("change", REFUSED)
def test_what_is_no_chain_is_refused(change: tuple[str, str]) -> None:
    """Whole messages, where the file says it."""
    with pytest.raises(WorldError) as refused:
        load_text(FILE.replace(*change))
    assert str(refused.value) == f"world.yaml:{REFUSED[change]}"
