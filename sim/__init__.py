# SPDX-License-Identifier: Apache-2.0
"""Everything that runs the RTL: :func:`load` makes any module a NumPy-callable object."""

from polyshade.sim.model import Model, Run, SimulationError, load, netlists

__all__ = ["Model", "Run", "SimulationError", "load", "netlists"]
