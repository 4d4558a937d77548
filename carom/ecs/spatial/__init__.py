"""Mathematics of space over arrays: vectors, quaternions, trigonometry that is equal on every machine."""
