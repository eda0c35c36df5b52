# SPDX-License-Identifier: Apache-2.0
"""Technology files against the generic modules in whose place they stand."""
