"""Benches, one file each: ``figures()`` yields what it measured.

``PEERS`` lists modules it compares with, ``PARTS`` what can be measured on its own, by name.
"""

BENCHES = {  # name on the command line: module
    "start": "starting",
    "break": "break_of_pool",
    "ecs": "table",
    "detect": "detect",
    "laws": "laws",
    "contacts": "contacts",
    "joints": "joints",
    "motion": "motion",
    "fields": "fields",
    "render": "render",
    "record": "record",
    "worlds": "worlds",
    "debug": "debug",
}
