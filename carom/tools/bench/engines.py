"""Engines: carom and its peers behind one small interface, each given the same scene."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Protocol

import numpy as np

from carom.ecs import Motion, RigidBody, Transform
from carom.ecs.column import Floats, Integers
from carom.systems.joints.many import join_many
from carom.systems.shapes.geometry import Geometry
from carom.systems.shapes.height_field import HeightField
from carom.systems.simulation import Simulation
from carom.tools.bench.contact_scenes import Joints, Scene
from carom.tools.bench.joint_gaps import anchors

DT, GRAVITY, FRICTION, DENSITY = 1.0 / 60.0, 9.81, 0.5, 1000.0
ROUGH = {"friction": FRICTION, "restitution": 0.0, "density": DENSITY}
UPRIGHT = (np.sqrt(0.5), 0.0, 0.0, np.sqrt(0.5))  # turns local y, along which land rises, to z


class Engine(Protocol):
    """What steps a scene, without putting bodies to sleep."""

    def step(self) -> None:
        """Step by dt."""

    def poses(self) -> tuple[Floats, Floats]:
        """Return copies of all positions (n, 3) and rotations (n, 4)."""

    def velocities(self) -> tuple[Floats, Floats]:
        """Return copies of all velocities of centres of mass and angular velocities (n, 3), world frame."""


class Carom:
    """Ours."""

    def __init__(self, scene: Scene, threads: int) -> None:
        gravity = (0.0, 0.0, -GRAVITY)
        self.simulation = simulation = Simulation(
            dt=DT, gravity=gravity, threads=threads, sleeping=False, checked=False
        )
        for center, half in scene.walls:
            simulation.add(collider={"box": {"size": 2.0 * half}}, material=ROUGH, transform={"position": center})
        if scene.land is not None:
            vertices, faces = scene.land
            field = HeightField(Geometry(vertices[:, [0, 2, 1]] * [1.0, 1.0, -1.0], faces))
            simulation.add(collider={"shape": field}, material=ROUGH, transform={"rotation": UPRIGHT})
        bodies = [
            simulation.add(
                collider={**shape_of(scene, k), "layer": "none" if scene.joints else "default"},
                body={},
                material=ROUGH,
                transform={"position": scene.position[k], "rotation": scene.rotation[k]},
                motion={"linear": scene.linear[k], "angular": scene.angular[k]},
                visual=False,
            )
            for k in range(scene.count)
        ]
        if scene.joints:
            self._join(np.array(bodies, np.int64), scene.joints)
        self.rows = simulation.world.rows(RigidBody, Motion)

    def _join(self, bodies: Integers, joints: Joints) -> None:
        a, b, at = joints
        for k in np.nonzero(a < 0)[0]:
            self.simulation.add(joint={"ball": {"b": int(bodies[b[k]]), "at": at[k]}})
        between = a >= 0
        join_many(self.simulation.world, {"ball": {}}, bodies[a[between]], bodies[b[between]], at[between])

    def step(self) -> None:
        """Step by dt."""
        self.simulation.step()

    def poses(self) -> tuple[Floats, Floats]:
        """Return copies of all positions (n, 3) and rotations (n, 4)."""
        transform = self.simulation.world[Transform]
        return np.array(transform.position[self.rows]), np.array(transform.rotation[self.rows])

    def velocities(self) -> tuple[Floats, Floats]:
        """Return copies of all velocities of centres of mass and angular velocities (n, 3), world frame."""
        motion = self.simulation.world[Motion]
        return np.array(motion.linear[self.rows]), np.array(motion.angular[self.rows])


def shape_of(scene: Scene, k: int) -> dict[str, Any]:
    """Return the words of body k's collider."""
    x, y, _ = half = scene.half[k]
    if not scene.ball[k]:
        return {"box": {"size": 2.0 * half}}
    return {"capsule": {"radius": x, "length": 2.0 * (y - x)}} if y > x else {"sphere": {"radius": x}}


class Rapier:
    """Rapier, through its own Python package; in single precision."""

    def __init__(self, scene: Scene, threads: int) -> None:
        import rapier3d

        self.world = rapier3d.PhysicsWorld(gravity=(0.0, 0.0, -GRAVITY))
        self.world.integration_parameters.dt = DT
        self.world.set_num_threads(threads)
        shape = rapier3d.Collider
        rough: dict[str, Any] = {"friction": FRICTION, "restitution": 0.0}
        for center, half in scene.walls:
            self.world.add_collider(shape.cuboid(*half.tolist(), translation=tuple(center.tolist()), **rough))
        if scene.land is not None:
            vertices, faces = scene.land
            self.world.add_collider(shape.trimesh(vertices.astype(np.float32), faces.astype(np.uint32), **rough))
        self.handles = [self._add(rapier3d, scene, k, rough) for k in range(scene.count)]
        if scene.joints:
            self._join(rapier3d, scene, scene.joints)

    def _add(self, rapier3d: Any, scene: Scene, k: int, rough: dict[str, Any]) -> Any:
        half, shape = scene.half[k].tolist(), rapier3d.Collider
        body = rapier3d.RigidBody.dynamic(
            translation=scene.position[k].tolist(),
            linvel=scene.linear[k].tolist(),
            angvel=scene.angular[k].tolist(),
            can_sleep=False,
        )
        if not scene.ball[k]:
            solid = shape.cuboid(*half, **rough)
        elif half[1] > half[0]:
            solid = shape.capsule_y(half[1] - half[0], half[0], **rough)
        else:
            solid = shape.ball(half[0], **rough)
        if scene.joints:
            solid = solid.collision_groups(rapier3d.InteractionGroups.none())
        body = body.rotation(tuple(rotation_vector(scene.rotation[k]).tolist()))
        return self.world.add_body(body, colliders=[solid.density(DENSITY)])

    def _join(self, rapier3d: Any, scene: Scene, joints: Joints) -> None:
        stands = self.world.add_body(rapier3d.RigidBody.fixed())
        for a, b, on_a, on_b in zip(joints.a.tolist(), joints.b.tolist(), *anchors(scene, joints), strict=True):
            ball = rapier3d.SphericalJointBuilder().local_anchor1(tuple(on_a)).local_anchor2(tuple(on_b))
            self.world.impulse_joints.insert(self.handles[a] if a >= 0 else stands, self.handles[b], ball.build())

    def step(self) -> None:
        """Step by dt."""
        self.world.step()

    def poses(self) -> tuple[Floats, Floats]:
        """Return copies of all positions (n, 3) and rotations (n, 4)."""
        bodies = self.world.rigid_bodies
        found = [(body.translation, body.rotation) for body in (bodies[handle] for handle in self.handles)]
        position = np.array([(place.x, place.y, place.z) for place, _ in found])
        return position, np.array([(turn.i, turn.j, turn.k, turn.w) for _, turn in found])

    def velocities(self) -> tuple[Floats, Floats]:
        """Return copies of all velocities of centres of mass and angular velocities (n, 3), world frame."""
        bodies = self.world.rigid_bodies
        found = [(body.linvel, body.angvel) for body in (bodies[handle] for handle in self.handles)]
        linear, angular = (np.array([(v.x, v.y, v.z) for v in of]) for of in zip(*found, strict=True))
        return linear, angular


def rotation_vector(rotation: Floats) -> Floats:
    """Return axis times angle of a unit quaternion."""
    turn: Floats = rotation * np.where(rotation[3] < 0.0, -1.0, 1.0)
    length = float(np.linalg.norm(turn[:3]))
    if length == 0.0:
        return np.zeros(3)
    vector: Floats = turn[:3] * (2.0 * np.arctan2(length, turn[3]) / length)
    return vector


#: By the module that each needs.
ENGINES: dict[str, Callable[[Scene, int], Engine]] = {"carom": Carom, "rapier3d": Rapier}
