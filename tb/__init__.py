# SPDX-License-Identifier: Apache-2.0
"""Benches of the RTL and tests of everything else, in folders that mirror what they test."""
