"""Marble run: importing it declares everything the game adds to carom, one file each."""

from marble_run import purse, take_coins

__all__ = ["purse", "take_coins"]
