// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fcl_kios/model/model.h"
#include "model/prepared.h"
#include "search/ray_search.h"
#include "tree/tree.h"
#include "triangle/ray_triangle.h"
#include "volume/ray_interval.h"

namespace kios {

/// The largest coordinate of a model, to rounding.
template <typename S>
double largestOf(const Model<S>& model) {
  const kIOS<S>& root = model.getBV(0).bv;
  return double{root.center0.cwiseAbs().maxCoeff()} + double{root.radius0};
}

/// Visits every triangle of a model that a ray in the model's frame may meet, those ahead first.
template <typename S>
class RayWalk : public engine::RayEvaluator {
 public:
  RayWalk(const Model<S>& model, const GivenRay& ray, SearchCounts& counts)
      : model_(model), ray_(ray), line_(ray.origin, ray.direction, ray.exponent), counts_(counts) {}

  void walk();

 protected:
  ~RayWalk() = default;

  TriangleVertices<double> cornersOf(std::uint32_t triangle) const {
    return cornersInDouble(model_, static_cast<int>(triangle));
  }
  /// Hits at a larger t don't matter from now on.
  void endAt(double t);

  const Model<S>& model_;
  SearchCounts& counts() { return counts_; }

 private:
  const GivenRay ray_;
  const RayLine line_;
  SearchCounts& counts_;
  const engine::Tree* tree_ = nullptr;  ///< if lengths in it are known
  RayLine::Near near_ = {};
};

}  // namespace kios
