"""Tests of ``sim``: modules as NumPy-callable objects, and frames."""
