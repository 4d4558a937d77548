"""Engines for one body: carom and its peers behind one small interface, z up, each as it comes."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, NamedTuple, Protocol

import numpy as np

from carom.ecs.column import Floats
from carom.ecs.spatial import quaternion
from carom.systems.simulation import Simulation

DT, DENSITY = 1.0 / 60.0, 1000.0
GROUND, MIDDLE = (50.0, 50.0, 0.5), (0.0, 0.0, -0.5)  # half extents of a box whose top is z = 0, m


@dataclass(frozen=True)
class Trial:
    """One body, a ball where ``half`` has one number, else a box; m, m/s, rad/s, m/s2. No gravity, no ground."""

    half: tuple[float, ...]
    position: tuple[float, float, float] = (0.0, 0.0, 0.0)
    linear: tuple[float, float, float] = (0.0, 0.0, 0.0)
    angular: tuple[float, float, float] = (0.0, 0.0, 0.0)
    friction: float = 0.0
    restitution: float = 0.0
    gravity: float = 9.81


class State(NamedTuple):
    """Where a body is and how fast: m, quaternion xyzw, m/s, rad/s, world frame."""

    position: Floats
    rotation: Floats
    linear: Floats
    angular: Floats


class Engine(Protocol):
    """What steps a trial."""

    def step(self) -> None:
        """Step by DT."""

    def state(self) -> State:
        """Return where the body is."""


class Carom:
    """Ours."""

    def __init__(self, trial: Trial) -> None:
        self.simulation = simulation = Simulation(dt=DT, gravity=(0.0, 0.0, -trial.gravity), checked=False)
        surface = {"friction": trial.friction, "restitution": trial.restitution, "density": DENSITY}
        if trial.gravity:
            ground = {"box": {"size": 2.0 * np.array(GROUND)}}
            simulation.add(collider=ground, material=surface, transform={"position": MIDDLE})
        size = 2.0 * np.array(trial.half)
        shape = {"sphere": {"radius": trial.half[0]}} if len(trial.half) == 1 else {"box": {"size": size}}
        motion = {"linear": trial.linear, "angular": trial.angular}
        place = {"position": trial.position}
        self.body = simulation.add(collider=shape, body={}, material=surface, transform=place, motion=motion)

    def step(self) -> None:
        """Step by DT."""
        self.simulation.step()

    def state(self) -> State:
        """Return where the body is."""
        found = self.simulation[self.body]
        place, motion = found.transform, found.motion
        return State(*(np.array(each) for each in (place.position, place.rotation, motion.linear, motion.angular)))


class Rapier:
    """Rapier, through its own Python package; in single precision."""

    def __init__(self, trial: Trial) -> None:
        import rapier3d

        self.world = rapier3d.PhysicsWorld(gravity=(0.0, 0.0, -trial.gravity))
        self.world.integration_parameters.dt = DT
        surface = {"friction": trial.friction, "restitution": trial.restitution}
        if trial.gravity:
            self.world.add_collider(rapier3d.Collider.cuboid(*GROUND, translation=MIDDLE, **surface))
        make = rapier3d.Collider.ball if len(trial.half) == 1 else rapier3d.Collider.cuboid
        speeds = {"linvel": trial.linear, "angvel": trial.angular}
        body = rapier3d.RigidBody.dynamic(translation=trial.position, **speeds)
        self.body = self.world.add_body(body, colliders=[make(*trial.half, **surface).density(DENSITY)])

    def step(self) -> None:
        """Step by DT."""
        self.world.step()

    def state(self) -> State:
        """Return where the body is."""
        body = self.world.rigid_bodies[self.body]
        turn = body.rotation
        three = [np.array((each.x, each.y, each.z)) for each in (body.translation, body.linvel, body.angvel)]
        return State(three[0], np.array((turn.i, turn.j, turn.k, turn.w)), three[1], three[2])


class PyBullet:
    """Bullet, through PyBullet; it multiplies friction and restitution of two surfaces."""

    def __init__(self, trial: Trial) -> None:
        import pybullet

        self.bullet = bullet = pybullet
        bullet.resetSimulation() if bullet.isConnected() else bullet.connect(bullet.DIRECT)
        bullet.setGravity(0.0, 0.0, -trial.gravity)
        bullet.setTimeStep(DT)
        surface = {"lateralFriction": trial.friction**0.5, "restitution": trial.restitution**0.5}
        if trial.gravity:
            ground = bullet.createMultiBody(0, bullet.createCollisionShape(bullet.GEOM_BOX, halfExtents=GROUND))
            bullet.resetBasePositionAndOrientation(ground, MIDDLE, (0.0, 0.0, 0.0, 1.0))
            bullet.changeDynamics(ground, -1, **surface)
        if ball := len(trial.half) == 1:
            shape = bullet.createCollisionShape(bullet.GEOM_SPHERE, radius=trial.half[0])
        else:
            shape = bullet.createCollisionShape(bullet.GEOM_BOX, halfExtents=trial.half)
        volume = 4.0 / 3.0 * np.pi * trial.half[0] ** 3 if ball else 8.0 * np.prod(trial.half)
        self.body = bullet.createMultiBody(DENSITY * float(volume), shape, basePosition=trial.position)
        bullet.changeDynamics(self.body, -1, linearDamping=0.0, angularDamping=0.0, **surface)
        bullet.resetBaseVelocity(self.body, trial.linear, trial.angular)

    def step(self) -> None:
        """Step by DT."""
        self.bullet.stepSimulation()

    def state(self) -> State:
        """Return where the body is."""
        place, speeds = self.bullet.getBasePositionAndOrientation(self.body), self.bullet.getBaseVelocity(self.body)
        return State(*(np.array(each) for each in (*place, *speeds)))


class MuJoCo:
    """MuJoCo; its contacts have no restitution."""

    def __init__(self, trial: Trial) -> None:
        import mujoco

        self.mujoco = mujoco
        rough = f'friction="{trial.friction} 0 0" condim="3"'
        ground = f'<geom type="box" pos="{text(MIDDLE)}" size="{text(GROUND)}" {rough}/>' if trial.gravity else ""
        kind = "sphere" if len(trial.half) == 1 else "box"
        self.model = mujoco.MjModel.from_xml_string(
            f'<mujoco><option timestep="{DT!r}" gravity="0 0 {-trial.gravity}"/><worldbody>{ground}'
            f'<body pos="{text(trial.position)}"><freejoint/>'
            f'<geom type="{kind}" size="{text(trial.half)}" density="{DENSITY}" {rough}/></body></worldbody></mujoco>'
        )
        self.data = mujoco.MjData(self.model)
        self.data.qvel[:] = (
            *trial.linear,
            *trial.angular,
        )  # turning in the body's own frame

    def step(self) -> None:
        """Step by DT."""
        self.mujoco.mj_step(self.model, self.data)

    def state(self) -> State:
        """Return where the body is."""
        place, speeds = self.data.qpos, self.data.qvel
        rotation = np.array(place[[4, 5, 6, 3]])
        return State(np.array(place[:3]), rotation, np.array(speeds[:3]), quaternion.rotate(rotation, speeds[3:]))


def text(numbers: tuple[float, ...]) -> str:
    """Return numbers as an attribute of XML."""
    return " ".join(repr(float(number)) for number in numbers)


#: By the module that each needs.
ENGINES: dict[str, Callable[[Trial], Any]] = {
    "carom": Carom,
    "rapier3d": Rapier,
    "pybullet": PyBullet,
    "mujoco": MuJoCo,
}
