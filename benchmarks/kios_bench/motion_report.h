// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <string>
#include <vector>

#include "options.h"
#include "report.h"
#include "scenes/mesh.h"
#include "scenes/motions.h"

namespace kios::bench {

/// Reports distance, collide and build rows of two meshes along a motion. `frames` are thinned
/// evenly to options.frames, or to a few for options.quick.
void reportMotion(const std::string& scenario, const scenes::Mesh& a, const scenes::Mesh& b,
                  const std::vector<scenes::Frame>& frames, const Options& options, Report& report);

}  // namespace kios::bench
