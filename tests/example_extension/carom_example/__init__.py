"""An extension of carom: importing it declares everything, one file each."""

from carom_example import damage, egg, health, tether

__all__ = ["damage", "egg", "health", "tether"]
