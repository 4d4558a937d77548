"""Relations of carom's own, one file each: tables with rows of their own."""
