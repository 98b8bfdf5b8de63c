# SPDX-FileCopyrightText: 2026 The fcl_kios authors
# SPDX-License-Identifier: BSD-3-Clause
import numpy as np
import pytest

import fcl_kios
import shapes


@pytest.fixture(scope="session")
def torus():
    return fcl_kios.Mesh(*shapes.torus(60, 40))


@pytest.fixture(scope="session")
def ball():
    return fcl_kios.Mesh(*shapes.ball(24), solid=True)


@pytest.fixture(scope="session")
def block():
    return fcl_kios.Mesh(*shapes.box(), solid=True)


@pytest.fixture(scope="session")
def poses():
    return shapes.random_poses(300, 1.7, np.random.default_rng(7))
