"""Kernels: hot loops over arrays, compiled by Numba; no World inside."""
