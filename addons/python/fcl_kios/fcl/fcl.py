# SPDX-FileCopyrightText: 2026 The fcl_kios authors
# SPDX-License-Identifier: BSD-3-Clause
"""As python-fcl's: what python-fcl compiles, among all other names.
Imported by its whole name, as this may be fcl.fcl."""
from fcl_kios.fcl import *  # noqa: F401,F403
