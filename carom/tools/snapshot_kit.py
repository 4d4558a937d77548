"""Snapshot kit: a pytest plugin that holds a world's state and picture to goldens kept beside the test."""
