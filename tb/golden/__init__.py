# SPDX-License-Identifier: Apache-2.0
"""Tests of ``golden``: hand-computed numbers, and exact fractions."""
