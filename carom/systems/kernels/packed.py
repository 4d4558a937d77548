"""Whether the geometries of all colliders are packed."""

from __future__ import annotations

# mypy: disable-error-code="no-untyped-def"
from carom.systems.kernels.kernel import kernel


@kernel()
def are_packed(rows, shape, geometry, numbers, known):
    """Tell whether the geometry of every collider among ``rows`` that is of these shapes is known."""
    for i in rows:
        for number in numbers:
            if shape[i] == number and not known[geometry[i]]:
                return False
    return True
