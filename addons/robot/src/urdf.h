// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>

#include "description.h"

namespace kios::robot {

/// Reads a URDF with its meshes. Visual elements, inertias, transmissions and extensions are left
/// out. Throws std::invalid_argument with the file, the line and the element.
Description readUrdf(const std::string& file, const std::map<std::string, std::string>& packages);

/// Adds the allowed pairs and group states of an SRDF. Pairs may name what isn't there (yet), as in
/// MoveIt; a warning says so.
void readSrdf(const std::string& file, Description& robot);

/// Throws std::invalid_argument if a linkage can't serve the geometry.
std::shared_ptr<const Linkage> measure(const Geometry& geometry);

}  // namespace kios::robot
