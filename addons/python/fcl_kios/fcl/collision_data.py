# SPDX-FileCopyrightText: 2026 The fcl_kios authors
# SPDX-License-Identifier: BSD-3-Clause
"""As python-fcl's: requests, results and numbers, among all other names.
Imported by its whole name, as this may be fcl.collision_data."""
from fcl_kios.fcl import *  # noqa: F401,F403
