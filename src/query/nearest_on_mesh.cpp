// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "query/nearest_on_mesh.h"

#include <algorithm>
#include <cmath>

#include "search/point_search.h"
#include "search/search.h"
#include "volume/error_bounds.h"

namespace kios {
namespace {

class NearestSearch final : public engine::PointEvaluator {
 public:
  NearestSearch(const Mesh& mesh, const Pointd& p, double within)
      : mesh_(mesh), p_(p), limit_(within) {}

  NearestOnMesh find(int start) {
    if (start >= 0) evaluate(static_cast<std::uint32_t>(start));
    const engine::Tree& tree = mesh_.tree();
    engine::FloatPoint point;
    if (engine::makeFloatPoint(tree, p_, point)) {
      in_floats_ = true;
      lowerCullDistance();
      engine::kernels().point({tree, point, *this});
    } else if (!(limit_ < std::ldexp(0.5 * engine::kFarthestPoint * tree.reach, tree.exponent))) {
      for (std::uint32_t t = 0; t < mesh_.numTriangles(); ++t) evaluate(t);
    }
    return best_;
  }

  /// All that may be computed to be as near as the best is evaluated.
  void evaluate(std::uint32_t triangle) override {
    const int id = static_cast<int>(triangle);
    if (id == best_.triangle) return;
    const NearestOnTriangle near = nearestOnTriangle(p_, mesh_.triangle(triangle));
    if (!(near.distance <= limit_)) return;
    if (near.distance == best_.distance && id > best_.triangle) return;
    best_ = {near.distance, 0, near.point, id};
    limit_ = near.distance;
    if (in_floats_) lowerCullDistance();
  }

 private:
  /// The kernel's pads have room for the rounding of computed distances.
  void lowerCullDistance() {
    const engine::Tree& tree = mesh_.tree();
    if (!(limit_ < std::ldexp(4 * engine::kFarthestPoint * tree.reach, tree.exponent))) return;
    cull_distance = std::min(cull_distance, roundUpFloat(std::ldexp(limit_, -tree.exponent)));
  }

  const Mesh& mesh_;
  const Pointd& p_;
  double limit_;  ///< what is computed to be farther doesn't matter
  bool in_floats_ = false;
  NearestOnMesh best_;
};

}  // namespace

double nearestError(const Mesh& mesh, double distance) {
  return error_bounds::triangleError<double>(error_bounds::extentOf(distance, mesh.radius(), 0));
}

NearestOnMesh nearestOnMesh(const Mesh& mesh, const Pointd& p, double within, int start) {
  NearestOnMesh near = NearestSearch(mesh, p, within).find(start);
  const double least = std::min(near.distance, within);
  near.lower = std::max(0.0, least - nearestError(mesh, least));
  return near;
}

}  // namespace kios
