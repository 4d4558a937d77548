"""Particles: births, flight, bounces and deaths of points in tables of their own."""
