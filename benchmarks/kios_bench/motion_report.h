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

/// The frames thinned evenly to options.frames, or to a few for options.quick.
std::vector<scenes::Frame> chosenFrames(const std::vector<scenes::Frame>& frames,
                                        const Options& options);

/// Reports distance, collide and build rows of two meshes along the chosen frames of a motion.
void reportMotion(const std::string& scenario, const scenes::Mesh& a, const scenes::Mesh& b,
                  const std::vector<scenes::Frame>& frames, const Options& options, Report& report);

/// Reports distance rows of the same frames in a random order, so that no query profits from the
/// one before.
void reportShuffled(const std::string& scenario, const scenes::Mesh& a, const scenes::Mesh& b,
                    const std::vector<scenes::Frame>& frames, const Options& options,
                    Report& report);

}  // namespace kios::bench
