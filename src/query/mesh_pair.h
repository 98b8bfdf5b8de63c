// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>

#include "fcl_kios/model/model.h"
#include "fcl_kios/triangle/distance.h"
#include "fcl_kios/volume/separation.h"
#include "model/kios_model.h"
#include "model/prepared.h"
#include "search/pair_query.h"
#include "search/root_body.h"
#include "volume/error_bounds.h"

namespace kios {

template <typename S>
TriangleVertices<S> cornersOf(const Model<S>& model, int triangle) {
  const engine::MeshView<S> mesh = viewOf(model);
  const auto t = static_cast<std::size_t>(triangle);
  return {mesh.corner(t, 0), mesh.corner(t, 1), mesh.corner(t, 2)};
}

template <typename S>
TriangleVertices<double> cornersInDouble(const Model<S>& model, int triangle) {
  const TriangleVertices<S> t = cornersOf(model, triangle);
  return {t[0].template cast<double>(), t[1].template cast<double>(), t[2].template cast<double>()};
}

template <typename S, typename Pose>
TriangleVertices<S> transformed(const TriangleVertices<S>& t, const Pose& X) {
  return {X * t[0], X * t[1], X * t[2]};
}

/// Two meshes at a pose, in the common frame of all queries about them, which is A's. It is built
/// once a query and handed down: models and poses are checked here and nowhere below, and the
/// rounding errors of this pair's distances are bounded here. The models must outlive it.
template <typename S>
class MeshPair {
 public:
  /// Throws std::invalid_argument if a model is not a finished mesh or a pose is not rigid.
  MeshPair(const Model<S>& a, const fcl::Transform3<S>& X_WA, const Model<S>& b,
           const fcl::Transform3<S>& X_WB)
      : a(a),
        b(b),
        X_AB((requireFinished(a), requireFinished(b), X_WA), X_WB),
        floats_serve(engine::makeTreePose(tree_a, tree_b, X_AB, X_trees)) {}
  /// For models and rotations that were checked; see RelativePose.
  MeshPair(const Model<S>& a, const fcl::Transform3<S>& X_WA, const Model<S>& b,
           const fcl::Transform3<S>& X_WB, double squared_errors)
      : a(a),
        b(b),
        X_AB(X_WA, X_WB, squared_errors),
        floats_serve(engine::makeTreePose(tree_a, tree_b, X_AB, X_trees)) {}

  const Model<S>&a, &b;
  const RelativePose<S> X_AB;
  const engine::Tree &tree_a = treeOf(a), &tree_b = treeOf(b);
  engine::TreePose X_trees;  ///< if floats serve
  const bool floats_serve;   ///< false if floats can't tell of both

  const kIOS<S>& rootA() const { return a.getBV(0).bv; }
  const kIOS<S>& rootB() const { return b.getBV(0).bv; }
  /// Lower bound of the distance by the roots; any above `enough` will do.
  double rootBound(double enough) const {
    if (!floats_serve) return separation(rootA(), rootB(), X_AB, enough);
    return engine::rootBound(engine::rootOf(rootA(), tree_a), engine::rootOf(rootB(), tree_b),
                             X_trees, enough);
  }

  TriangleVertices<S> triangleA(int id) const { return cornersOf(a, id); }
  TriangleVertices<S> triangleB(int id) const { return transformed(cornersOf(b, id), X_AB); }
  bool exist(const engine::TrianglePairIds& ids) const {
    return ids.a >= 0 && ids.a < a.num_tris && ids.b >= 0 && ids.b < b.num_tris;
  }
  TriangleDistance<S> distanceOf(const engine::TrianglePairIds& ids) const {
    return triangleDistance(triangleA(ids.a), triangleB(ids.b));
  }

  /// Bounds the error of the computed distance of any two triangles against the exact one in this
  /// frame as it is stored, if either is at most d.
  double kernelError(double d) const {
    return error_bounds::triangleError<S>(
               error_bounds::extentOf(d, rootA().radius0, rootB().radius0)) +
           kLeast;
  }
  /// Bounds the error against the distance in the exact common frame.
  double distanceError(double d) const {
    const kIOS<S>& root = rootB();
    return kernelError(d) + frameError(norm1(root.center0) + 1.8 * double{root.radius0});
  }
  /// Bounds it for these two triangles, which are smaller than the models.
  double distanceErrorOf(const engine::TrianglePairIds& ids) const {
    const auto p = triangleA(ids.a), local = cornersOf(b, ids.b), q = triangleB(ids.b);
    double largest = 0;
    fcl::Vector3<S> low = p[0], high = p[0];
    for (int k = 0; k < 3; ++k) {
      low = low.cwiseMin(p[k]).cwiseMin(q[k]);
      high = high.cwiseMax(p[k]).cwiseMax(q[k]);
      largest = std::max(largest, norm1(local[k]));
    }
    const double extent = (high - low).template cast<double>().stableNorm();
    return error_bounds::triangleError<S>(1.01 * extent) + frameError(largest) + kLeast;
  }

 private:
  static constexpr double kLeast = std::numeric_limits<S>::min();  // results round absolutely below

  static double norm1(const fcl::Vector3<S>& v) {
    return v.template cast<double>().template lpNorm<1>();
  }
  double frameError(double norm1) const {
    return error_bounds::frameError<S>(norm1, detail::boundsOf(X_AB).T_norm1);
  }
};

}  // namespace kios
