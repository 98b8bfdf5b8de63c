// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fcl_kios/model/model.h"

namespace kios {

/// Holds the vertex of a model that lies farthest along a direction.
struct SupportPoint {
  int vertex = -1;
  double height = 0;  ///< n . vertex; no vertex is higher by more than 2^-47 |n| largestOf(model)
};

/// Takes n in the model's frame, not zero. Branch and bound in the model's tree.
template <typename S>
SupportPoint supportPoint(const Model<S>& model, const fcl::Vector3d& n);

}  // namespace kios
