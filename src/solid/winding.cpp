// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "solid/winding.h"

#include <Eigen/LU>
#include <cmath>
#include <limits>
#include <utility>

#include "fcl_kios/solid/solids.h"
#include "fcl_kios/volume/separation.h"
#include "query/ray_walk.h"
#include "solid/solid_mark.h"
#include "volume/errors.h"
#include "volume/instantiate.h"
#include "volume/rounding.h"

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

template <typename S>
bool contains(const Model<S>& solid, const fcl::Transform3<S>& X_WM,
              const fcl::Vector3<std::common_type_t<S>>& point) {
  requireSolid(solid);
  require(point.allFinite() && double{point.cwiseAbs().maxCoeff()} <= kMaxCoordinate<S>,
          "the point", point.transpose(), kCoordinateRange<S>);
  const RelativePose<S> rigid(X_WM.linear(), X_WM.translation());  // or it throws
  const fcl::Matrix3d inverse = X_WM.linear().template cast<double>().inverse();
  const fcl::Vector3d from =
      point.template cast<double>() - X_WM.translation().template cast<double>();
  SearchCounts unused;
  return placeOf<S>(detail::rotate<double>(inverse, from), solid, unused).inside();
}

KIOS_INSTANTIATE_FUNCTION(placeOf);
KIOS_INSTANTIATE_FUNCTION(contains);

}  // namespace kios
