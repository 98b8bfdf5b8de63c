# SPDX-FileCopyrightText: 2026 The fcl_kios authors
# SPDX-License-Identifier: BSD-3-Clause
"""As python-fcl's."""
from fcl_kios.fcl import __version__
