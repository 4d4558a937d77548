"""Shrinking: a world file made as small as it gets while the same expectation fails in it."""
