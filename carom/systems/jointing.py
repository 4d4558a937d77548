"""Jointing: the systems of joints beside the solver, which finds their impulses."""

from __future__ import annotations

from carom.ecs import Collider, Motion, RigidBody, Transform, World, system
from carom.ecs.components.flight import Flight
from carom.ecs.components.joint import Joint
from carom.systems.awake import Awake, stirs
from carom.systems.linkage import Linkage


@system(reads=(RigidBody, Transform, Motion, Collider, Awake), writes=(Joint, Flight, Linkage))
def join_bodies(world: World, dt: float) -> None:
    """Find the joints of bodies that are awake; the bodies count as touching, so they are stepped semi-implicitly."""
    linkage = world[Linkage]
    if linkage.structure != world.structure:
        linkage.find(world)
    if linkage.groups:
        world[Flight].touching[linkage.bodies] = True


@system(reads=(RigidBody, Awake), writes=(Joint, Linkage), when=stirs)
def tell_joints(world: World, dt: float) -> None:
    """Write how joints are loaded and where they are into their table; let those break that bear no more."""
    linkage = world[Linkage]
    if linkage.groups:
        linkage.hand_over(world, dt)
