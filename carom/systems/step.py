"""The frame, as one literal: order of writing is order of execution. ``carom explain`` prints it."""

from __future__ import annotations

from functools import lru_cache

from carom.ecs import Phase, Schedule, World
from carom.systems.awake import stirs
from carom.systems.detection.bounds import place_colliders
from carom.systems.detection.contacts import find_contacts
from carom.systems.events import carry_out_events
from carom.systems.finish import check_finite, clear_inputs
from carom.systems.forces.attraction import apply_attraction
from carom.systems.forces.buoyancy import apply_buoyancy
from carom.systems.forces.constant_push import apply_constant_push
from carom.systems.forces.damping import apply_damping
from carom.systems.forces.drag import apply_linear_drag, apply_quadratic_drag
from carom.systems.forces.gravity import apply_gravity
from carom.systems.forces.gravity_well import apply_gravity_well
from carom.systems.forces.law import choose_bodies
from carom.systems.forces.lift import apply_lift
from carom.systems.forces.magnus import apply_magnus
from carom.systems.forces.mutual_gravitation import apply_mutual_gravitation
from carom.systems.forces.springs import apply_springs
from carom.systems.forces.standing import forces_vary, laws_may_act
from carom.systems.forces.thruster import apply_thruster
from carom.systems.forces.vortex import apply_vortex
from carom.systems.forces.wind import apply_wind
from carom.systems.going_on import go_on, is_to_begin, is_to_end
from carom.systems.hierarchy import carry_children
from carom.systems.integration import clear_forces, kick, predict, sum_forces
from carom.systems.jointing import join_bodies, tell_joints
from carom.systems.keyframes import follow_keyframes
from carom.systems.particles.deaths import end_particles
from carom.systems.particles.emission import emit_particles, note_emitters
from carom.systems.particles.moving import move_particles
from carom.systems.particles.pieces import emits
from carom.systems.progress import Progress, begin_step, begin_substep
from carom.systems.response import drift, hand_impulses_over, hold, look_ahead, relax, settle, sort_out_contacts
from carom.systems.sensors import sense
from carom.systems.settings import Settings
from carom.systems.sleeping import fall_asleep, wake_disturbed
from carom.systems.touching import tell_contacts, tell_hits


def substeps(world: World) -> int:
    """Return how many substeps a step has."""
    return world[Settings].substeps


def is_in_step(world: World) -> bool:
    """Tell whether there is anything to do in this step, and substeps are left."""
    return stirs(world) and world[Progress].substep < world[Settings].substeps


STEP = Schedule(
    Phase(
        "events",
        begin_step,
        carry_out_events,  # what the world states for this time
    ),
    Phase(
        "begin",
        note_emitters,  # where sources of particles are
        wake_disturbed,  # who was changed from outside; where nobody is awake, the step ends here
    ),
    Phase(
        "detect",
        follow_keyframes,  # velocities of bodies on keyframes, for the whole step
        place_colliders,  # poses and bounds of all colliders, widened by what they may travel
        find_contacts,  # the contact table, and who may meet a sensor
        when=stirs,
    ),
    Phase(
        "substep",
        begin_substep,
        look_ahead,  # once more for all bodies that are faster now than was foreseen
        predict,  # arcs begin; bodies at the middle of the substep, if forces may vary in the step (verlet)
        Phase(
            "forces",
            clear_forces,
            apply_gravity,
            Phase(
                "laws",
                choose_bodies,  # whom laws with a region, layers or a time window act on
                apply_wind,  # before drags, which are relative to the medium
                apply_vortex,
                apply_mutual_gravitation,
                apply_gravity_well,
                apply_attraction,
                apply_thruster,
                apply_lift,
                apply_magnus,
                apply_buoyancy,
                apply_springs,
                apply_linear_drag,
                apply_quadratic_drag,
                when=laws_may_act,
            ),
            apply_damping,
            apply_constant_push,  # last: leaving its stroke depends on the forces before
            sum_forces,  # accelerations; bodies back at the start of the substep
            when=forces_vary,
        ),
        go_on,  # all that follows, and all further substeps, at once where nobody looks on
        Phase(
            "begin substep",
            join_bodies,  # which joints hold somebody
            sort_out_contacts,  # which pairs rest
            kick,  # each body's arc
            hold,  # velocities that respect joints and resting contacts
            when=is_to_begin,
        ),
        Phase(
            "end substep",
            drift,  # the flight along the arcs, with impacts at their exact times
            sense,  # who entered and left sensors on the way
            settle,  # origins placed, and how deep contacts have come to be
            relax,  # velocities without what pushed overlap out
            when=is_to_end,
        ),
        repeat=substeps,
        when=is_in_step,
    ),
    Phase(
        "finish",
        hand_impulses_over,  # of resting contacts, into their table
        tell_joints,  # how joints are loaded, and which break
        tell_contacts,  # who touches whom, who begins and ends to
        tell_hits,  # the impacts that are heard
        fall_asleep,  # islands that have been still for a while
        clear_inputs,
        carry_children,  # entities carried by others follow them
        Phase(
            "particles",
            emit_particles,  # each at its own time within the step
            move_particles,  # by the same forces as bodies, off planes and colliders
            end_particles,
            when=emits,
        ),
        check_finite,
    ),
)


@lru_cache(16)
def has_strangers(schedule: Schedule) -> bool:
    """Tell whether there are systems in a schedule that are not those of the frame."""
    own = {system for _, system in STEP}
    return any(system not in own for _, system in schedule)
