"""What exists: the table. Columns, components, entities, world, queries, schedule, snapshots."""

from carom.ecs.column import column
from carom.ecs.component import Component, Relation, Resource
from carom.ecs.components.collider import Collider, ColliderPose
from carom.ecs.components.external_force import ExternalForce
from carom.ecs.components.force import Force
from carom.ecs.components.material import Combine, Material
from carom.ecs.components.motion import Motion
from carom.ecs.components.name import Name
from carom.ecs.components.parent import Parent
from carom.ecs.components.rigid_body import BodyType, RigidBody
from carom.ecs.components.transform import Transform
from carom.ecs.components.visual import Visual
from carom.ecs.difference import Difference, first_difference
from carom.ecs.entity import Entity, EntityView
from carom.ecs.errors import (
    AccessError,
    CaromError,
    DeclarationError,
    EntityError,
    NonFiniteError,
    SnapshotError,
)
from carom.ecs.phase import Phase
from carom.ecs.prefab import Prefab
from carom.ecs.query import Query
from carom.ecs.schedule import Schedule
from carom.ecs.snapshot import Snapshot, restore_snapshot, state_hash, take_snapshot
from carom.ecs.snapshot_bytes import bytes_from_snapshot, snapshot_from_bytes
from carom.ecs.snapshot_file import load_snapshot, save_snapshot
from carom.ecs.system import System, every, system
from carom.ecs.tags import Tag, tag
from carom.ecs.timings import Timings
from carom.ecs.world import World

__all__ = [
    "AccessError",
    "BodyType",
    "CaromError",
    "Collider",
    "ColliderPose",
    "Combine",
    "Component",
    "DeclarationError",
    "Difference",
    "Entity",
    "EntityError",
    "EntityView",
    "ExternalForce",
    "Force",
    "Material",
    "Motion",
    "Name",
    "NonFiniteError",
    "Parent",
    "Phase",
    "Prefab",
    "Query",
    "Relation",
    "Resource",
    "RigidBody",
    "Schedule",
    "Snapshot",
    "SnapshotError",
    "System",
    "Tag",
    "Timings",
    "Transform",
    "Visual",
    "World",
    "bytes_from_snapshot",
    "column",
    "every",
    "first_difference",
    "load_snapshot",
    "restore_snapshot",
    "save_snapshot",
    "snapshot_from_bytes",
    "state_hash",
    "system",
    "tag",
    "take_snapshot",
]
