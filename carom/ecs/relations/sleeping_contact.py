"""SleepingContact: where bodies that sleep touch each other and what stands."""

from carom.ecs.relations.contact import Contact


class SleepingContact(Contact):
    """What `Contact` held when the bodies fell asleep, kept for when they wake."""
