// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "solid/containment.h"

#include <Eigen/LU>
#include <cmath>
#include <limits>
#include <utility>

#include "fcl_kios/solids.h"
#include "query/nearest_on_mesh.h"
#include "search/ray_search.h"
#include "search/search.h"
#include "solid/solid_mark.h"
#include "volume/error_bounds.h"
#include "volume/errors.h"
#include "volume/instantiate.h"

namespace kios {
namespace {

/// The direction of the rays that count: along no edge or face of ordinary meshes, so that the
/// exact stages are rarely needed.
fcl::Vector3d windingDirection() { return {0.36602540378443865, 0.61803398874989485, 1}; }

/// Adds up the crossings of a ray. The turned ray of RayCrossing meets no triangle that the ray as
/// given misses: as the angle vanishes, its hits tend to points of the ray and of the closed
/// triangle.
class WindingCount final : public engine::RayEvaluator {
 public:
  WindingCount(const Mesh& mesh, const fcl::Vector3d& origin, const fcl::Vector3d& direction,
               SearchCounts& counts)
      : mesh_(mesh),
        line_(origin, direction, 0),
        ray_(origin, direction, mesh.largest()),
        counts_(counts) {}

  PointPlace run() {
    RayLine::Near near;
    engine::FloatRay ray;
    constexpr double kEndless = std::numeric_limits<double>::max();
    const engine::Tree& tree = mesh_.tree();
    if (engine::makeFloatRay(tree, line_, 0, kEndless, near, ray) == engine::RayFit::kMiss) {
      return place_;
    }
    end = ray.end;
    engine::kernels().ray({tree, ray, *this, counts_});
    return place_;
  }

  bool evaluate(std::uint32_t triangle) override {
    ++counts_.exact;
    return place_.add(ray_.cross(mesh_.triangle(triangle)));
  }

 private:
  const Mesh& mesh_;
  const RayLine line_;
  const RayCrossing ray_;
  SearchCounts& counts_;
  PointPlace place_;
};

/// Finds the place of p, in a's frame, in b as posed there: by all of b's triangles.
bool liesInPosed(const fcl::Vector3d& p, const MeshPair& frame) {
  const RayCrossing ray(p, windingDirection(), p.cwiseAbs().maxCoeff() + 2 * frame.b.largest());
  PointPlace place;
  const int num_triangles = static_cast<int>(frame.b.numTriangles());
  for (int t = 0; t < num_triangles && !place.on_surface; ++t) {
    place.add(ray.cross(frame.triangleB(t)));
  }
  return place.inside();
}

/// A point of a component, in a's frame, that lies in the other solid.
std::optional<fcl::Vector3d> pointInA(const MeshPair& frame, const SolidState::Vertices& of_b,
                                      SearchCounts& counts) {
  const fcl::Vector3d p = frame.X_AB * of_b[0];
  return placeOf(p, frame.a, counts).inside() ? std::optional(p) : std::nullopt;
}

// b's tree lies in b's frame, where a's vertices are known but for rounding: that doesn't matter
// unless b's surface is as near.
std::optional<fcl::Vector3d> pointInB(const MeshPair& frame, const SolidState::Vertices& of_a,
                                      SearchCounts& counts) {
  const Mesh& b = frame.b;
  const double T_norm1 = detail::boundsOf(frame.X_AB).T_norm1;
  for (const fcl::Vector3d& p : of_a) {
    const fcl::Vector3d y = toB(frame.X_AB, p);
    const double error =
        inverseError(frame.X_AB, p.lpNorm<1>()) +
        error_bounds::frameError<double>(2 * y.lpNorm<1>() + 4 * b.largest(), T_norm1);
    if (nearestOnMesh(b, y, error + 2 * nearestError(b, error)).lower > error) {
      return placeOf(y, b, counts).inside() ? std::optional(p) : std::nullopt;
    }
  }
  return liesInPosed(of_a.back(), frame) ? std::optional(of_a.back()) : std::nullopt;
}

}  // namespace

// The ray leads away from the mesh's centre, mostly along the coordinate in which the point lies
// farthest out, so that it leaves the mesh soon. Nothing winds round points out of the root's ball,
// of which floats may tell little.
PointPlace placeOf(const fcl::Vector3d& point, const Mesh& mesh, SearchCounts& counts) {
  const fcl::Vector3d out = point - mesh.center();
  if (out.lpNorm<Eigen::Infinity>() > mesh.radius() + 0x1p-40 * mesh.largest()) return {};
  fcl::Vector3d direction = windingDirection();
  int axis = 0;
  out.cwiseAbs().maxCoeff(&axis);
  std::swap(direction[2], direction[axis]);
  for (int c = 0; c < 3; ++c) direction[c] = std::copysign(direction[c], out[c]);
  return WindingCount(mesh, point, direction, counts).run();
}

fcl::Vector3d toB(const RelativePose<double>& X_AB, const fcl::Vector3d& p) {
  return detail::rotate<double>(X_AB.R().transpose(), p - X_AB.T());
}

// R y = R R^T (p - T), where R R^T differs from 1 by |E|, at most twice the stretch and a little
// more; |y - x| is that by at most |p - T|. Products and sums round by 2^-50 of their terms.
double inverseError(const RelativePose<double>& X_AB, double norm1) {
  const auto& bounds = detail::boundsOf(X_AB);
  return 2 * (norm1 + bounds.T_norm1) * (2.1 * bounds.stretch + 0x1p-48);
}

std::optional<fcl::Vector3d> containedPoint(const MeshPair& frame, SearchCounts& counts) {
  for (const auto& component : requireSolid(frame.b).components()) {
    if (const auto p = pointInA(frame, component, counts)) return p;
  }
  for (const auto& component : requireSolid(frame.a).components()) {
    if (const auto p = pointInB(frame, component, counts)) return p;
  }
  return std::nullopt;
}

std::array<Contained, 2> containedComponents(const MeshPair& frame) {
  SearchCounts counts;
  const auto contained = [&](const Mesh& mesh, const auto& findPoint) {
    const SolidState& solid = requireSolid(mesh);
    Contained found{false, true, false};
    for (std::size_t i = 0; i < solid.components().size(); ++i) {
      const bool in = findPoint(frame, solid.components()[i], counts).has_value();
      found.some |= in;
      found.all &= in;
      found.inwards |= in && solid.inwards()[i];
    }
    return found;
  };
  return {contained(frame.a, pointInB), contained(frame.b, pointInA)};
}

template <typename S>
bool contains(const Model<S>& solid, const fcl::Transform3<S>& X_WM,
              const fcl::Vector3<std::common_type_t<S>>& point) {
  const Mesh mesh = meshOf(solid);
  requireSolid(mesh);
  require(point.allFinite() && double{point.cwiseAbs().maxCoeff()} <= kMaxCoordinate<S>,
          "the point", point.transpose(), kCoordinateRange<S>);
  const RelativePose<S> rigid(X_WM.linear(), X_WM.translation());  // or it throws
  const fcl::Transform3d& X = X_WM.template cast<double>();
  const fcl::Vector3d from = point.template cast<double>() - X.translation();
  SearchCounts unused;
  return placeOf(detail::rotate<double>(X.linear().inverse(), from), mesh, unused).inside();
}

KIOS_INSTANTIATE_FUNCTION(contains);

}  // namespace kios
