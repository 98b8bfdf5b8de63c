# SPDX-FileCopyrightText: 2026 The fcl_kios authors
# SPDX-License-Identifier: BSD-3-Clause
#
# For tests of pages, which source it: sets chromium and python, or skips the test without them.
chromium=$(command -v chromium || command -v chromium-browser || command -v google-chrome || true)
python=$(command -v python3 || true)
if [[ -z $chromium || -z $python ]]; then
  echo "skipped: no chromium or no python3; Debian's packages are chromium and python3"
  exit 77
fi
