# SPDX-License-Identifier: Apache-2.0
"""Polyshade's command line, tool set-up, synthesis and reports."""
