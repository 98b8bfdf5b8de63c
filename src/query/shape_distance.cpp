// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <limits>
#include <vector>

#include "fcl_kios/query/shape_queries.h"
#include "model/prepared.h"
#include "query/float_solid.h"
#include "query/mesh_contacts.h"
#include "query/posed_solid.h"
#include "search/pair_query.h"
#include "search/search.h"
#include "shape/separating_slabs.h"
#include "shape/shape_solid.h"
#include "shape/triangle_shape.h"
#include "volume/instantiate.h"
#include "volume/rotation.h"
#include "volume/rounding.h"

namespace kios {
namespace {

/// Search for the triangle nearest to a solid: the least id of those whose computed distance is
/// bitwise the least. That does not depend on which are evaluated, and in which order, as long as
/// all are that may be as near: distances of single triangles are kept apart from the bounds that
/// leave others out by more than both are off.
template <typename S>
class NearestTriangle final : public engine::SolidEvaluator {
 public:
  NearestTriangle(const Model<S>& model, const PosedSolid<S>& posed, double rel_err, double abs_err,
                  double far_enough, SearchCounts& counts)
      : model_(model),
        posed_(posed),
        rel_err_(rel_err),
        abs_err_(abs_err),
        counts_(counts),
        slabs_(posed.solid()),
        slack_(rel_err == 0 && abs_err == 0 ? posed.kernelError(model.getBV(0).bv) : 0) {
    lowerTo(far_enough);
  }

  void run() {
    const engine::Tree& tree = treeOf(model_);
    engine::FloatSolid solid;
    if (makeFloatSolid(tree, posed_, /*any_slab=*/false, solid)) {
      tree_ = &tree;
      engine::kernels().solid({tree, solid, *this, counts_});
    } else {
      for (int id = 0; id < model_.num_tris && !test(id);) ++id;
    }
  }

  bool evaluate(std::uint32_t triangle, bool /*meets*/) override {
    return test(static_cast<int>(triangle));
  }

  double best() const { return best_; }
  int id() const { return id_; }  ///< -1 if none is nearer than far_enough
  const shape::TriangleShapeDistance& nearest() const { return nearest_; }

 private:
  /// True if nothing can be nearer.
  bool test(int id) {
    const shape::Triangle t = posed_.place(cornersOf(model_, id));
    if (slabs_.proveFarther(t, limit_ + slack_)) return best_ <= 0;
    const auto d = shape::distance(posed_.solid(), t, limit_ + slack_);
    const shape::Vec way = d.on_triangle - d.on_shape;
    if (posed_.solid().kind == shape::Kind::kConvex) {
      const auto* const added = slabs_.add(way);
      if (added && tree_) addSlab(slabInTree(*tree_, posed_, added->normal, added->offset));
    }
    if (!(d.distance < best_ || (d.distance == best_ && id < id_))) return best_ <= 0;
    nearest_ = d;
    id_ = id;
    lowerTo(d.distance);
    if (tree_ && posed_.solid().bounded() && d.distance > 0) {
      const double length = way.norm();
      if (length > 0) {
        const shape::Vec n = way / length;
        slab = slabInTree(*tree_, posed_, n, shape::extentAlong(posed_.solid(), n));
      }
    }
    return best_ <= 0;
  }

  void lowerTo(double distance) {
    best_ = distance;
    limit_ = engine::cullDistance(distance, rel_err_, abs_err_);
    cull_distance = limit_ < 0x1p127 ? roundUpFloat(limit_) : kInfinityFloat;
  }

  const Model<S>& model_;
  const PosedSolid<S>& posed_;
  const double rel_err_, abs_err_;
  SearchCounts& counts_;
  shape::SeparatingSlabs slabs_;  ///< of a convex shape, as other bounds cost less than GJK
  const double slack_;
  const engine::Tree* tree_ = nullptr;
  double best_, limit_;
  int id_ = -1;
  shape::TriangleShapeDistance nearest_;
};

}  // namespace

template <typename S>
S distanceShape(const Model<S>& model, const fcl::Transform3<S>& X_WM,
                const fcl::CollisionGeometry<S>& geometry, const fcl::Transform3<S>& X_WS,
                const fcl::DistanceRequest<S>& request, fcl::DistanceResult<S>& result,
                SearchCounts* counts) {
  requireErrorBounds(request);
  requireFinished(model);
  const double squared_errors = squaredRotationErrors(X_WS, X_WM);
  const bool done = request.isSatisfied(result);
  const bool limited = result.min_distance < std::numeric_limits<S>::max();
  if (limited && !done &&
      provenApart(model, X_WM, geometry, X_WS, squared_errors, result.min_distance)) {
    if (counts) ++counts->volume_tests;
    return result.min_distance;
  }
  const PosedSolid<S> posed(toSolid(geometry), X_WM, X_WS, model.getBV(0).bv, squared_errors);
  if (done) return result.min_distance;
  SearchCounts unused;
  NearestTriangle<S> search(model, posed, request.rel_err, posed.toUnits(request.abs_err),
                            limited ? posed.toUnits(result.min_distance) : kInfinity,
                            counts ? *counts : unused);
  search.run();
  if (search.id() < 0) return result.min_distance;
  constexpr int kNone = fcl::DistanceResult<S>::NONE;
  if (request.enable_nearest_points) {
    result.update(posed.fromUnits(search.best()), &model, &geometry, search.id(), kNone,
                  posed.toWorld(search.nearest().on_triangle),
                  posed.toWorld(search.nearest().on_shape));
  } else {
    result.update(posed.fromUnits(search.best()), &model, &geometry, search.id(), kNone);
  }
  return result.min_distance;
}

KIOS_INSTANTIATE_FUNCTION(distanceShape);

}  // namespace kios
