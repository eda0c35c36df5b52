"""Tests of sim/scene, and the corpus of bad mesh files."""
