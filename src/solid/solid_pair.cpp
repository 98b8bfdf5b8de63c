// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "solid/solid_pair.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include <Eigen/Geometry>
#include "query/nearest_on_mesh.h"
#include "query/pair_search.h"
#include "solid/containment.h"
#include "solid/tuning.h"
#include "volume/errors.h"
#include "volume/rounding.h"
#include "volume/unit_vector.h"

namespace kios {
namespace {

using Vec = fcl::Vector3d;

}  // namespace

Vec normalOf(const TriangleVerticesd& t) {
  const Vec n = (t[1] - t[0]).cross(t[2] - t[0]);
  const double length = n.norm();
  // Squares beyond this lose digits, or are none.
  return length > 0x1p-450 && length < 0x1p450 ? Vec(n / length) : unitVector(n);
}

SolidPair::SolidPair(const Mesh& a, const fcl::Transform3d& X_WA, const Mesh& b,
                     const fcl::Transform3d& X_WB, double squared_errors, SearchCounts& counts,
                     bool swapped, bool moves_a)
    : X_WA_(X_WA),
      X_WB_(X_WB),
      squared_errors_(squared_errors),
      counts_(counts),
      swapped_(swapped),
      moves_a_(moves_a),
      frame_(a, X_WA, b, X_WB, squared_errors),
      size_(a.radius() + b.radius()),
      rounding_(frame_.distanceError(size_)) {
  requireSolid(a);
  requireSolid(b);
  if (!(size_ >= 0x1p-300 && size_ <= 0x1p300)) {  // lengths are squared
    refuse("solids larger than 2^300 or smaller than 2^-300 have no depth; scale them.");
  }
}

MeshPair SolidPair::moved(const Vec& translation) const {
  fcl::Transform3d X_WA = X_WA_, X_WB = X_WB_;
  if (moves_a_) {
    X_WA.translation() -= translation;
  } else {
    X_WB.translation() += translation;
  }
  return {frame_.a, X_WA, frame_.b, X_WB, squared_errors_};
}

SolidPair::Overlap SolidPair::overlapAfter(const Vec& translation, std::size_t limit) {
  ++tests_;
  Overlap result;
  const MeshPair frame = moved(translation);
  if (frame.rootBound(0) > 0) return result;
  for (const auto& ids : searchContacts(frame, limit, counts_)) {
    result.contacts.push_back({frame.triangleA(ids.a), frame.triangleB(ids.b)});
  }
  if (!result.contacts.empty()) return result;
  if (const auto p = containedPoint(frame, counts_)) {  // on one's surface, in the other
    const Vec on_b = nearestOnMesh(b(), toB(frame.X_AB, *p), kInfinity).point;
    result.to_wall = nearestOnMesh(a(), *p, kInfinity).point - frame.X_AB * on_b;
  }
  return result;
}

const SolidPair::Overlap& SolidPair::overlap() {
  if (!overlap_) overlap_ = overlapAfter(Vec::Zero(), tuning::kContacts);
  return *overlap_;
}

Separation SolidPair::test(const Vec& translation, double reach) {
  ++tests_;
  const MeshPair moved = this->moved(translation);
  Separation result;
  result.moved = (moved.X_AB.T() - frame_.X_AB.T()).norm();
  engine::PairQuery query;
  query.rel_err = 0.1;
  query.far_enough = std::max(reach, 8 * rounding_);
  const DistanceBracketResultd answer = bracketDistance(moved, query);
  counts_ += answer.counts;
  result.gap = answer.lower_bound;
  if (!(result.gap > 0) || containedPoint(moved, counts_)) return result;
  result.apart = true;
  if (answer.triangle_a < 0) return result;
  const Vec on_a = answer.point_a, between = answer.point_b - on_a;
  const double length = between.norm();
  if (!(length > 64 * rounding_)) {
    // The difference has lost its digits; the faces' normals have not.
    const Vec n =
        normalOf(moved.triangleA(answer.triangle_a)) - normalOf(moved.triangleB(answer.triangle_b));
    if (!(n.norm() > 0x1p-20)) return result;
    result.normal = inWorld(n.normalized());
  } else {
    result.normal = inWorld(between / length);
  }
  result.on_a = X_WA_ * on_a;
  result.on_b = result.on_a + inWorld(between);
  result.nearest = true;
  return result;
}

SolidPair inOrder(const Mesh& mesh1, const fcl::Transform3d& X_W1, const Mesh& mesh2,
                  const fcl::Transform3d& X_W2, double squared_errors, SearchCounts& counts,
                  bool moves_second) {
  const auto sizes = [](const Mesh& m) { return std::pair(m.numTriangles(), m.numVertices()); };
  const auto compare = [](const auto& p, const auto& q) {  // < 0: p's first difference is larger
    const auto* const end = p.data() + p.size();
    const auto [x, y] = std::mismatch(p.data(), end, q.data());
    return x == end ? 0 : *x < *y ? 1 : -1;
  };
  int first = sizes(mesh1) == sizes(mesh2) ? 0 : sizes(mesh1) > sizes(mesh2) ? 1 : -1;
  if (first == 0) first = compare(mesh1.center(), mesh2.center());
  if (first == 0) first = compare(X_W1.matrix(), X_W2.matrix());
  for (std::size_t i = 0; i < mesh1.numVertices() && first == 0; ++i) {
    first = compare(mesh1.vertex(i), mesh2.vertex(i));
  }
  return first >= 0
             ? SolidPair(mesh1, X_W1, mesh2, X_W2, squared_errors, counts, false, false)
             : SolidPair(mesh2, X_W2, mesh1, X_W1, squared_errors, counts, true, moves_second);
}

}  // namespace kios
