"""Merging: contacts that are kept and those found anew become one table."""

from __future__ import annotations

# mypy: disable-error-code="no-untyped-def,no-untyped-call"
from carom.systems.kernels.crew import part_of, shared
from carom.systems.kernels.rows import first_at


@shared("row_a", "row_b", "feature", "normal", "depth", "point", "by_fcl", "old")
def merge_contacts(
    crew, kept, old_a, old_b, old_feature, old_normal, old_depth, old_point, old_by_fcl,
    fresh_a, fresh_b, fresh_feature, fresh_normal, fresh_depth, fresh_point, fresh_by_fcl, fresh_old,
    row_a, row_b, feature, normal, depth, point, by_fcl, old,
):  # fmt: skip
    """Merge those of the old contacts that are ``kept`` and the fresh ones, of other pairs, both sorted by pair."""
    i, end = part_of(crew, len(kept))
    j, until = 0, len(fresh_a)
    if crew[1] > 0:
        j = first_at(fresh_a, fresh_b, old_a[kept[i]], old_b[kept[i]])
    if end < len(kept):
        until = first_at(fresh_a, fresh_b, old_a[kept[end]], old_b[kept[end]])
    for c in range(i + j, end + until):
        o = kept[i] if i < end else 0
        first = j == until
        if not first and i < end:
            first = old_a[o] < fresh_a[j] or (old_a[o] == fresh_a[j] and old_b[o] < fresh_b[j])
        if first:
            row_a[c], row_b[c], feature[c], by_fcl[c] = old_a[o], old_b[o], old_feature[o], old_by_fcl[o]
            depth[c], old[c] = old_depth[o], o
            for k in range(3):
                normal[c, k], point[c, k] = old_normal[o, k], old_point[o, k]
            i += 1
        else:
            row_a[c], row_b[c], feature[c], by_fcl[c] = fresh_a[j], fresh_b[j], fresh_feature[j], fresh_by_fcl[j]
            depth[c], old[c] = fresh_depth[j], fresh_old[j]
            for k in range(3):
                normal[c, k], point[c, k] = fresh_normal[j, k], fresh_point[j, k]
            j += 1
