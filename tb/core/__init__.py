"""Benches of rtl/core."""
