# SPDX-License-Identifier: Apache-2.0
"""Tests of sim/scene, and the corpus of bad mesh files."""
