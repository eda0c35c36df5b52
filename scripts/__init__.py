"""Polyshade's command line, tool set-up, synthesis and reports."""
