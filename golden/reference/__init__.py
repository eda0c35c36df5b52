# SPDX-License-Identifier: Apache-2.0
"""The papers in float64, formula by formula: what the integer models are derived from and measured against."""
