// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "solid/winding.h"

#include <cmath>
#include <limits>
#include <utility>

#include "query/ray_walk.h"
#include "volume/instantiate.h"

namespace kios {
namespace {

/// Adds up the crossings of a ray. The turned ray of RayCrossing meets no triangle that the ray as
/// given misses: as the angle vanishes, its hits tend to points of the ray and of the closed
/// triangle.
template <typename S>
class WindingCount final : public RayWalk<S> {
 public:
  WindingCount(const Model<S>& model, const GivenRay& ray, SearchCounts& counts)
      : RayWalk<S>(model, ray, counts), ray_(ray.origin, ray.direction, largestOf(model)) {}

  PointPlace run() {
    this->walk();
    return place_;
  }

  bool evaluate(std::uint32_t triangle) override {
    ++this->counts().exact;
    return place_.add(ray_.cross(this->cornersOf(triangle)));
  }

 private:
  const RayCrossing ray_;
  PointPlace place_;
};

}  // namespace

template <typename S>
PointPlace placeOf(const fcl::Vector3d& point, const Model<S>& model, SearchCounts& counts) {
  // Away from the model's centre, mostly along the coordinate in which the point lies farthest out,
  // so that the ray leaves the model soon.
  const fcl::Vector3d out = point - model.getBV(0).bv.center0.template cast<double>();
  fcl::Vector3d direction = windingDirection();
  int axis = 0;
  out.cwiseAbs().maxCoeff(&axis);
  std::swap(direction[2], direction[axis]);
  for (int c = 0; c < 3; ++c) direction[c] = std::copysign(direction[c], out[c]);
  const GivenRay ray = {point, direction, 0, 0, std::numeric_limits<S>::max()};
  return WindingCount<S>(model, ray, counts).run();
}

KIOS_INSTANTIATE_FUNCTION(placeOf);

}  // namespace kios
