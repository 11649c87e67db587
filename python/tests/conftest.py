import numpy as np
import pytest

import powercell as pc


@pytest.fixture
def rng():
    return np.random.default_rng(1)


@pytest.fixture
def square():
    return pc.Domain.box([0, 0], [1, 1])


@pytest.fixture
def cube():
    return pc.Domain.box([0, 0, 0], [1, 1, 1])


@pytest.fixture
def parts(tmp_path):
    """A folder that is not there yet, for what is computed out of core."""
    return tmp_path / "parts"
