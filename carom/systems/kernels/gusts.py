"""Kernels of gusts: noise as a sum of waves."""

from __future__ import annotations

# mypy: disable-error-code="no-untyped-def"
from carom.systems.kernels.kernel import kernel
from carom.systems.kernels.spatial import sine_cosine


@kernel("medium")
def add_gust(rows, size, time, rates, phases, medium):
    """Add ``size`` (m/s) times the sum of the sines of ``rates`` (3, n) times ``time`` and ``phases``, by axis."""
    for k in range(3):
        total = 0.0
        for j in range(rates.shape[1]):
            sine, _ = sine_cosine(rates[k, j] * time + phases[k, j])
            total += sine
        for i in rows:
            medium[i, k] += size * total
