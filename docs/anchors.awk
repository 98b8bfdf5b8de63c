# SPDX-FileCopyrightText: 2026 The fcl_kios authors
# SPDX-License-Identifier: BSD-3-Clause
#
# Doxygen's filter for pages: gives headings the names by which GitHub knows them, made unique by the
# page's, and lets links to them find these.
function anchor(title) {
  title = tolower(title)
  gsub(/[^a-z0-9 _-]/, "", title)
  gsub(/ /, "-", title)
  return title
}
FNR == 1 {
  page = FILENAME
  sub(/^.*\//, "", page)
  sub(/\.md$/, "", page)
}
/^```/ { code = !code }
!code {
  if ($0 ~ /^##+ /) {
    title = $0
    sub(/^#+ /, "", title)
    $0 = $0 " {#" page "-" anchor(title) "}"
  } else {
    gsub(/\]\(#/, "](#" page "-")
    while (match($0, /\]\([a-z-]+\.md#/)) {
      name = substr($0, RSTART + 2, RLENGTH - 6)
      $0 = substr($0, 1, RSTART - 1) "](#" name "-" substr($0, RSTART + RLENGTH)
    }
  }
}
{ print }
