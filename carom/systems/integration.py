"""Integration: from forces to the arc each body flies in a substep."""

from __future__ import annotations

from carom.ecs import ExternalForce, Force, Motion, RigidBody, Transform, World, system
from carom.ecs.components.flight import Flight
from carom.ecs.components.spring import Spring
from carom.systems.awake import Awake
from carom.systems.forces.law import Forces
from carom.systems.forces.standing import Standing
from carom.systems.kernels.flight import accelerate, predict_middle
from carom.systems.kernels.forces import clear_sums
from carom.systems.kernels.kicking import EULER, SEMI_IMPLICIT, VERLET, kick_bodies
from carom.systems.progress import Progress
from carom.systems.settings import Settings
from carom.systems.threads import Threads, crew_for

SCHEMES = {"euler": EULER, "semi_implicit": SEMI_IMPLICIT, "verlet": VERLET}


@system(
    reads=(RigidBody, Settings, Awake, Progress, Forces, ExternalForce, Spring, Threads),
    writes=(Transform, Motion, Flight, Standing),
)
def predict(world: World, dt: float) -> None:
    """Begin the arcs of bodies; move them to the middle of the substep, where verlet evaluates forces that vary."""
    transform, motion, flight, body = world[Transform], world[Motion], world[Flight], world[RigidBody]
    if world[Progress].substep == 1:
        world[Standing].judge(world)
    half = 0.5 * dt if in_the_middle(world) else 0.0
    rows = world[Awake].now(world)
    predict_middle(
        crew_for(world, len(rows)), rows, half, body.center_of_mass, body.freedom, flight.held,
        motion.linear_acceleration, motion.angular_acceleration,
        transform.position, transform.rotation, motion.linear, motion.angular,
        flight.center, flight.start_center, flight.start_position, flight.start_rotation,
        flight.start_linear, flight.start_angular,
        flight.angular_acceleration, flight.time, flight.turned, flight.touching,
    )  # fmt: skip


def in_the_middle(world: World) -> bool:
    """Tell whether forces are evaluated where bodies are in the middle of the substep."""
    return world[Settings].integrator == "verlet" and not world[Standing].stay


@system(reads=(RigidBody,), writes=(Force,))
def clear_forces(world: World, dt: float) -> None:
    """Start the sums of this substep from zero, of all bodies: forces act on those without `Force` of their own too."""
    force = world[Force]
    clear_sums(
        world.row_numbers(RigidBody),
        force.force,
        force.torque,
        force.drag,
        force.drag_flow,
        force.angular_drag,
        force.medium,
    )


@system(reads=(RigidBody, Force, ExternalForce, Awake, Settings), writes=(Transform, Motion, Flight, Standing))
def sum_forces(world: World, dt: float) -> None:
    """Divide forces and torques by mass and inertia; bodies return to the start of the substep."""
    transform, motion, flight = world[Transform], world[Motion], world[Flight]
    body, force, external = world[RigidBody], world[Force], world[ExternalForce]
    rows = world[Awake].now(world)
    accelerate(
        rows, in_the_middle(world), body.inverse_mass, body.inverse_inertia, body.principal_axes, body.freedom,
        force.force, force.torque, external.force, external.torque,
        flight.start_position, flight.start_rotation, flight.start_linear, flight.start_angular,
        transform.position, transform.rotation, motion.linear, motion.angular,
        flight.felt, flight.angular_acceleration,
    )  # fmt: skip
    world[Standing].rows = rows


@system(reads=(RigidBody, Force, Settings, Awake, Threads), writes=(Motion, Flight))
def kick(world: World, dt: float) -> None:
    """Set each body's arc by the integrator; bodies in contact are stepped semi-implicitly."""
    motion, flight, force, body = world[Motion], world[Flight], world[Force], world[RigidBody]
    rows = world[Awake].now(world)
    kick_bodies(
        crew_for(world, len(rows)), rows, dt, SCHEMES[world[Settings].integrator],
        body.inverse_mass, body.freedom, force.drag, force.drag_flow, force.angular_drag, flight.felt, flight.touching,
        motion.linear, motion.angular, flight.acceleration, flight.angular_acceleration,
        flight.decay, flight.angular_decay, flight.flow, motion.linear_acceleration, motion.angular_acceleration,
    )  # fmt: skip
