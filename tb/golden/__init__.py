"""Tests of ``golden``: hand-computed numbers, and exact fractions."""
