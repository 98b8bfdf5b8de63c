// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "fcl_kios/rays.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "fcl_kios/volume.h"
#include "model/prepared.h"
#include "search/mesh_pair.h"
#include "search/ray_search.h"
#include "search/search.h"
#include "triangle/ray_triangle.h"
#include "volume/errors.h"
#include "volume/instantiate.h"
#include "volume/rounding.h"

namespace kios {
namespace {

template <typename S>
void requireValid(const Ray<S>& ray) {
  const auto inRange = [](const fcl::Vector3<S>& v) {
    return v.allFinite() && double{v.cwiseAbs().maxCoeff()} <= kMaxCoordinate<S>;
  };
  constexpr const char* kRange = kCoordinateRange<S>;
  require(inRange(ray.origin), "the ray's origin", ray.origin.transpose(), kRange);
  require(inRange(ray.direction), "the ray's direction", ray.direction.transpose(), kRange);
  require(!ray.direction.isZero(0), "the ray's direction", "zero", "another");
  require(std::isfinite(ray.t_min), "the ray's t_min", ray.t_min, "finite");
  require(!std::isnan(ray.t_max), "the ray's t_max", ray.t_max, "a number or infinity");
  require(!(ray.t_min > ray.t_max), "the ray's t_max", ray.t_max, "at least t_min");
}

/// The ray in a frame at R, T in its own. Directions are enlarged first if need be, so that turning
/// them doesn't underflow.
///
/// Cofactors of R are off by 3 u, its determinant by 8 u and quotients by 14 u in all, u = 2^-53;
/// origin - T by u, sums of three products by 3 u more: 2^-48 = 32 u cover them.
template <typename S>
GivenRay mapped(const Ray<S>& ray, const fcl::Transform3<S>& X) {
  const fcl::Matrix3d inverse = X.linear().template cast<double>().inverse();
  const fcl::Vector3d from =
      ray.origin.template cast<double>() - X.translation().template cast<double>();
  fcl::Vector3d direction = ray.direction.template cast<double>();
  int exponent = 0;
  if (direction.cwiseAbs().maxCoeff() < 0x1p-400) {
    direction *= 0x1p600;
    exponent = -600;
  }
  const double t_max = std::min<double>(ray.t_max, std::numeric_limits<S>::max());
  return {detail::rotate<double>(inverse, from), detail::rotate<double>(inverse, direction),
          exponent, ray.t_min, t_max};
}

struct Found {
  TriangleHit hit;
  int triangle;
  bool operator<(const Found& o) const {
    return hit.t != o.hit.t ? hit.t < o.hit.t : triangle < o.triangle;
  }
};

/// The search for the first hits of one ray, by t and then by triangle.
class RayCast final : public engine::RayEvaluator {
 public:
  RayCast(const Mesh& mesh, const GivenRay& ray, std::size_t limit, bool any, SearchCounts& counts)
      : mesh_(mesh),
        given_(ray),
        line_(ray.origin, ray.direction, ray.exponent),
        ray_(ray, mesh.largest()),
        limit_(limit),
        any_(any),
        counts_(counts) {}

  std::vector<Found> run() {
    using engine::RayFit;
    const engine::Tree& tree = mesh_.tree();
    engine::FloatRay ray;
    const RayFit fit = engine::makeFloatRay(tree, line_, given_.t_min, given_.t_max, near_, ray);
    if (fit == RayFit::kMiss || limit_ == 0) return {};
    lengths_known_ = fit == RayFit::kServed;
    end = ray.end;
    engine::kernels().ray({tree, ray, *this, counts_});
    std::sort(found_.begin(), found_.end());
    return std::move(found_);
  }

  bool evaluate(std::uint32_t triangle) override {
    ++counts_.exact;
    Found found = {{}, static_cast<int>(triangle)};
    if (!ray_.hits(mesh_.triangle(triangle), found.hit)) return false;
    if (found_.size() == limit_) {  // a heap, the last hit on top
      if (!(found < found_.front())) return false;
      std::pop_heap(found_.begin(), found_.end());
      found_.pop_back();
    }
    found_.push_back(found);
    std::push_heap(found_.begin(), found_.end());
    if (found_.size() == limit_ && lengths_known_) {  // hits at a larger t don't matter
      const engine::Tree& tree = mesh_.tree();
      end = engine::toLength(tree, line_.lengthOf(found_.front().hit.t, near_.t, tree.exponent));
    }
    return any_;
  }

 private:
  const Mesh& mesh_;
  const GivenRay& given_;
  const RayLine line_;
  const ExactRay ray_;
  const std::size_t limit_;
  const bool any_;
  SearchCounts& counts_;
  bool lengths_known_ = false;  ///< in the tree
  RayLine::Near near_ = {};
  std::vector<Found> found_;
};

template <typename S>
std::vector<Found> cast(const Model<S>& model, const fcl::Transform3<S>& X_WM, const Ray<S>& ray,
                        std::size_t limit, bool any, SearchCounts* counts) {
  const Mesh mesh = meshOf(model);
  requireValid(ray);
  const RelativePose<S> rigid(X_WM.linear(), X_WM.translation());  // or it throws
  SearchCounts unused;
  const GivenRay given = mapped(ray, X_WM);
  return RayCast(mesh, given, limit, any, counts ? *counts : unused).run();
}

template <typename S>
RayHit<S> inWorld(const Found& found, const Model<S>& model, const fcl::Transform3<S>& X_WM) {
  const double* const w = found.hit.weights;
  const auto [p, q, r] = cornersInDouble(model, found.triangle);
  RayHit<S> hit;
  hit.t = roundedTo<S>(found.hit.t);
  hit.point = toWorld<S>(X_WM, p + w[1] * (q - p) + w[2] * (r - p));
  for (int i = 0; i < 3; ++i) hit.weights[i] = roundedTo<S>(w[i]);
  hit.triangle = found.triangle;
  hit.side = found.hit.side < 0 ? RaySide::kFront
                                : (found.hit.side > 0 ? RaySide::kBack : RaySide::kEdgeOn);
  return hit;
}

/// v rounded to S, not above (-infinity) or not below (+infinity) it.
template <typename S>
S outward(double v, S direction) {
  constexpr double kMax = std::numeric_limits<S>::max();
  const S rounded = roundedTo<S>(std::clamp(v, -kMax, kMax));
  return double{rounded} == v ? rounded : std::nextafter(rounded, direction);
}

}  // namespace

template <typename S>
std::optional<RayInterval<S>> rayInterval(const kIOS<S>& bv, const Ray<S>& ray) {
  requireValid(ray);
  const RayLine line(ray.origin.template cast<double>(), ray.direction.template cast<double>(), 0);
  double enter, exit;
  if (!rayInterval(bv, line, enter, exit)) return std::nullopt;
  constexpr S kMax = std::numeric_limits<S>::max();
  const S t_max = std::min(ray.t_max, kMax);
  const RayInterval<S> interval = {std::max(ray.t_min, std::min(outward<S>(enter, -kMax), kMax)),
                                   std::min(t_max, outward<S>(exit, kMax))};
  if (interval.enter > interval.exit) return std::nullopt;
  return interval;
}

template <typename S>
bool overlap(const Ray<S>& ray, const kIOS<S>& bv) {
  return rayInterval(bv, ray).has_value();
}

template <typename S>
std::optional<RayHit<S>> firstHit(const Model<S>& model, const fcl::Transform3<S>& X_WM,
                                  const Ray<S>& ray, SearchCounts* counts) {
  const auto found = cast(model, X_WM, ray, 1, false, counts);
  if (found.empty()) return std::nullopt;
  return inWorld(found[0], model, X_WM);
}

template <typename S>
bool anyHit(const Model<S>& model, const fcl::Transform3<S>& X_WM, const Ray<S>& ray,
            SearchCounts* counts) {
  return !cast(model, X_WM, ray, 1, true, counts).empty();
}

template <typename S>
std::vector<RayHit<S>> allHits(const Model<S>& model, const fcl::Transform3<S>& X_WM,
                               const Ray<S>& ray, std::size_t limit, SearchCounts* counts) {
  std::vector<RayHit<S>> hits;
  for (const auto& found : cast(model, X_WM, ray, limit, false, counts)) {
    hits.push_back(inWorld(found, model, X_WM));
  }
  return hits;
}

template std::optional<RayIntervald> rayInterval(const kIOS<double>&, const Rayd&);
template std::optional<RayIntervalf> rayInterval(const kIOS<float>&, const Rayf&);
template bool overlap(const Rayd&, const kIOS<double>&);
template bool overlap(const Rayf&, const kIOS<float>&);
KIOS_INSTANTIATE_FUNCTION(firstHit);
KIOS_INSTANTIATE_FUNCTION(anyHit);
KIOS_INSTANTIATE_FUNCTION(allHits);

}  // namespace kios
