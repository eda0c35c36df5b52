# SPDX-License-Identifier: Apache-2.0
"""What a design of somebody else's takes: register descriptions, plain Verilog, scripts for every flow."""
