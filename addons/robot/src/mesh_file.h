// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "fcl_kios/model.h"

namespace kios::robot {

/// A mesh file, each coordinate times its scale, welded (loadMesh() in robot.h). If an odd number
/// of factors is negative, triangles are turned over, so that their outside stays outside. Appends
/// what the file leaves out. Throws std::invalid_argument with the file's name.
std::shared_ptr<Modeld> readMesh(const std::string& file, const fcl::Vector3d& scale,
                                 std::vector<std::string>& warnings);

/// The model of triangles that share no vertices yet: those of equal coordinates become one.
/// Triangles of fewer than three corners stay. Throws std::invalid_argument as makeModel().
std::shared_ptr<Modeld> weld(std::vector<fcl::Vector3d> vertices,
                             std::vector<fcl::Triangle> triangles);

}  // namespace kios::robot
