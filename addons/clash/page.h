// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "report.h"

namespace kios::clash_tool {

/// Makes one self-contained HTML page: the parts, and a list of the clashes, of which a click turns
/// the view to one. Meshes beyond `limit_megabytes` are left out, those of clashes last.
std::string page(const Report& report, double limit_megabytes);

}  // namespace kios::clash_tool
