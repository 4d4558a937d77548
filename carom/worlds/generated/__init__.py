"""Models made from the registries: what components, shapes, force laws and settings declare is not written twice."""
