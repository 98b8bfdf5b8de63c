// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "fcl_kios/model/model.h"

namespace kios {

/// Balls in a solid, in its frame: none is nearer to the surface than its radius, and all centres
/// are inside. Proven.
struct InnerBalls {
  struct Ball {
    fcl::Vector3d center;
    double radius;
  };
  std::vector<Ball> balls;
  double gap = 0;  ///< about the mean distance of the surface from them
};

/// Returns balls that touch the surface, each where the ones before it leave most out.
template <typename S>
InnerBalls innerBalls(const Model<S>& model);

}  // namespace kios
