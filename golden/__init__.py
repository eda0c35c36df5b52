# SPDX-License-Identifier: Apache-2.0
"""Bit-exact NumPy models of Polyshade's hardware, one function a module, in the same folders and under the same names.

Integers in, integers out (``int64``); stateless; any array shape, with broadcasting; equal to the RTL in every bit.
Derived from the papers, not from the RTL. NumPy is the only dependency.
"""
