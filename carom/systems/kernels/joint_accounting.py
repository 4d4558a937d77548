"""What joints do to the energy of bodies."""

from __future__ import annotations

# mypy: disable-error-code="no-untyped-def,no-untyped-call"
from carom.systems.kernels import joint_groups as of
from carom.systems.kernels.accounting import gained, given
from carom.systems.kernels.joint_groups import KINDS, bound, slot, slots_of
from carom.systems.kernels.joint_motion import added, borne, moved
from carom.systems.kernels.kernel import kernel
from carom.systems.kernels.lanes import address, gather, load, planes, spread, store

HELD, DROVE, RUBBED, ENTRIES = 0, 1, 2, 3


@kernel("work")
def find_joint_work(groups, kinds, row, index_a, index_b, lanes, bodies, earlier, momenta, work):
    """Write what impulses of joints since ``earlier`` did to the bodies (J), as `find_work`.

    Three rows a group: locks and limits; springs, dampers and motors; friction.
    """
    lanes, bodies, earlier = address(lanes), planes(bodies), address(earlier)
    momenta, work, index_a, index_b = address(momenta), address(work), address(index_a), address(index_b)
    zero = spread(0.0)
    rest, nothing = (zero, zero, zero, zero, zero, zero, zero, zero), (zero, zero, zero)
    for g in range(groups):
        r, slots = row[g], slots_of(kinds[g])
        p_a, p_b = gather(momenta, index_a, g), gather(momenta, index_b, g)
        for entry in range(ENTRIES):
            push, twist = nothing, nothing
            for s in range(slots if entry == HELD or kinds[g] >= KINDS else 0):
                q, p = slot(r, s), bound(r, slots, s)
                if entry == HELD:
                    j = gained(q + of.HOLD, lanes, earlier)
                    locks = load(lanes, q + of.HELD) * j
                    push, twist = added(s, q, locks, push, twist, lanes)
                    if kinds[g] >= KINDS:
                        push, twist = borne(p, j - locks, push, twist, lanes)
                else:
                    j = gained(p + (of.DRIVE if entry == DROVE else of.RUB), lanes, earlier)
                    push, twist = borne(p, j, push, twist, lanes)
            a, b = moved(g, r, push, twist, rest, rest, index_a, index_b, lanes, bodies)
            store(work, ENTRIES * g + entry, given(p_a, a) + given(p_b, b))
