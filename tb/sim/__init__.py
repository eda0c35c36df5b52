# SPDX-License-Identifier: Apache-2.0
"""Tests of ``sim``: modules as NumPy-callable objects, and frames."""
