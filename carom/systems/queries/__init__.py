"""Queries: what rays, points and shapes meet among the colliders of a world, asked at any time; see `Space`."""
