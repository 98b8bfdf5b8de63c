// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <memory>

#include "engine/mesh.h"
#include "engine/tree.h"

namespace kios::engine {

/// Lengths of a mesh, and of a scene, for which floats keep clear of under- and overflow in every
/// kernel (squares of 2^-24 of a length, products of two squares).
constexpr double kLeastReach = 0x1p-36, kLargestReach = 0x1p40;

/// Builds the tree: weld, partition, collapse, assign the features, fit. The mesh must have finite
/// vertices that lie within kLargestReach of the origin.
template <typename S>
std::unique_ptr<Tree> prepare(const MeshView<S>& mesh, const Eigen::Vector3d& origin);

}  // namespace kios::engine
