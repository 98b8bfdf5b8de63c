// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <limits>

#include "fcl_kios/detail/rigid.h"
#include "fcl_kios/triangle.h"
#include "fcl_kios/volume.h"
#include "search/float_frame.h"
#include "search/mesh.h"
#include "search/pair_query.h"
#include "search/root_body.h"
#include "volume/error_bounds.h"
#include "volume/rotation.h"
#include "volume/rounding.h"

namespace kios {

template <typename S, typename Pose>
TriangleVertices<S> transformed(const TriangleVertices<S>& t, const Pose& X) {
  return {X * t[0], X * t[1], X * t[2]};
}

/// A point of A's frame in the world, rounded once.
template <typename S>
fcl::Vector3<S> toWorld(const fcl::Transform3<S>& X_WA, const Pointd& p_A) {
  return roundedTo<S>(detail::transform<double>(X_WA.template cast<double>(), p_A));
}

/// Two meshes at a pose, in the common frame of all queries about them, which is A's, in double. It
/// is built once a query and handed down: poses are checked here and nowhere below, and the
/// rounding errors of this pair's distances are bounded here. The models must outlive it.
class MeshPair {
 public:
  /// Throws std::invalid_argument if a pose, in double or float, is not rigid.
  template <typename P>
  MeshPair(const Mesh& a, const fcl::Transform3<P>& X_WA, const Mesh& b,
           const fcl::Transform3<P>& X_WB)
      : MeshPair(a, X_WA, b, X_WB, squaredRotationErrors(X_WA, X_WB)) {}
  /// For rotations that were checked; see RelativePose.
  template <typename P>
  MeshPair(const Mesh& a, const fcl::Transform3<P>& X_WA, const Mesh& b,
           const fcl::Transform3<P>& X_WB, double squared_errors)
      : a(a),
        b(b),
        X_AB(X_WA, X_WB, squared_errors),
        floats_serve(engine::makeTreePose(a.tree(), b.tree(), X_AB, X_trees)) {}

  const Mesh a, b;
  const RelativePose<double> X_AB;
  engine::TreePose X_trees;  ///< if floats serve
  const bool floats_serve;   ///< false if floats can't tell of both

  /// Lower bound of the distance by the roots; any above `enough` will do. Where floats don't
  /// serve, by the central spheres, as volume/separation.cpp does.
  double rootBound(double enough) const {
    if (floats_serve) {
      return engine::rootBound(engine::rootOf(a), engine::rootOf(b), X_trees, enough);
    }
    const detail::PoseBounds& bounds = detail::boundsOf(X_AB);
    const double error = error_bounds::volumeError<double>(b.center().lpNorm<1>(),
                                                           bounds.T_norm1 + a.center().lpNorm<1>(),
                                                           a.radius(), b.radius()) +
                         bounds.stretch * b.radius();
    return (X_AB * b.center() - a.center()).stableNorm() - a.radius() - b.radius() - error;
  }

  TriangleVerticesd triangleA(int id) const { return a.triangle(static_cast<std::size_t>(id)); }
  TriangleVerticesd triangleB(int id) const {
    return transformed(b.triangle(static_cast<std::size_t>(id)), X_AB);
  }
  bool exist(const engine::TrianglePairIds& ids) const {
    return ids.a >= 0 && static_cast<std::size_t>(ids.a) < a.numTriangles() && ids.b >= 0 &&
           static_cast<std::size_t>(ids.b) < b.numTriangles();
  }
  TriangleDistanced distanceOf(const engine::TrianglePairIds& ids) const {
    return triangleDistance(triangleA(ids.a), triangleB(ids.b));
  }
  bool intersect(const engine::TrianglePairIds& ids) const {
    return trianglesIntersect(triangleA(ids.a), triangleB(ids.b));
  }

  /// Bounds the error of the computed distance of any two triangles against the exact one in this
  /// frame as it is stored, if either is at most d.
  double kernelError(double d) const {
    return error_bounds::triangleError<double>(error_bounds::extentOf(d, a.radius(), b.radius())) +
           kLeast;
  }
  /// Bounds the error against the distance in the exact common frame.
  double distanceError(double d) const {
    return kernelError(d) +
           error_bounds::frameError<double>(b.center().lpNorm<1>() + 1.8 * b.radius(),
                                            detail::boundsOf(X_AB).T_norm1);
  }

 private:
  /// Results round absolutely below.
  static constexpr double kLeast = std::numeric_limits<double>::min();
};

}  // namespace kios
