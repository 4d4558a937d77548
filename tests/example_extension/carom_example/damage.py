"""Damage: blows wear down health."""

from carom.ecs import World, system
from carom.ecs.relations.impact import Impact
from carom.systems.places import placed
from carom_example.health import Health


@placed(before="clear_inputs")
@system(reads=(Impact,), writes=(Health,))
def take_damage(world: World, dt: float) -> None:
    """Take a point for every blow harder than the toughness of who is struck, from its guardian if it has one."""
    impact, health = world[Impact], world[Health]
    mortal = set(world.row_numbers(Health).tolist())
    for blow in range(impact.count):
        for entity in (impact.a[blow], impact.b[blow]):
            row = world.row(int(entity))
            if row in mortal and impact.impulse[blow] > health.toughness[row]:
                guardian = int(health.guardian[row])
                health.points[row if guardian < 0 else world.row(guardian)] -= 1
