"""Components of carom's own, one file each."""
