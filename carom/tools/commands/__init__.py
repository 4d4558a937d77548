"""Commands, one file each: ``declare`` states the arguments, ``execute`` returns the exit status.

The first line of a module is its help, after the colon. Imports of substance wait until ``execute``.
"""
