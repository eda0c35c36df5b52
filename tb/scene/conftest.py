# SPDX-License-Identifier: Apache-2.0
"""Random numbers that the run's seed reproduces."""

import numpy as np
import pytest

from tb.runner import SEED


@pytest.fixture
def rng() -> np.random.Generator:
    return np.random.default_rng(SEED)
