// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "solid/solid_pair.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>
#include "query/pair_search.h"
#include "solid/containment.h"
#include "solid/nearest_surface.h"
#include "volume/errors.h"
#include "volume/rounding.h"

namespace kios {
namespace {

using Vec = fcl::Vector3d;

}  // namespace

Vec normalOf(const TriangleVertices<double>& t) {
  const Vec n = (t[1] - t[0]).cross(t[2] - t[0]);
  const double length = n.norm();
  return length > 0 ? Vec(n / length) : Vec(Vec::Zero());
}

template <typename S>
SolidPair<S>::SolidPair(const Model<S>& a, const fcl::Transform3<S>& X_WA, const Model<S>& b,
                        const fcl::Transform3<S>& X_WB, SearchCounts& counts, bool moves_a)
    : a_(a),
      b_(b),
      X_WA_(X_WA.template cast<double>()),
      X_WB_(X_WB.template cast<double>()),
      counts_(counts),
      moves_a_(moves_a),
      squared_errors_(squaredRotationErrors(X_WA, X_WB)),
      frame_(meshOf(a), X_WA, meshOf(b), X_WB, squared_errors_),
      state_a_(requireSolid(a)),
      state_b_(requireSolid(b)),
      R_WA_(X_WA_.linear()),
      t_WA_(X_WA_.translation()) {
  R_AB_ = R_WA_.transpose() * X_WB_.linear();
  T_AB_ = R_WA_.transpose() * (X_WB_.translation() - t_WA_);
  size_ = frame_.a.radius() + frame_.b.radius();
  rounding_ = frame_.distanceError(size_);
  if (!(size_ >= 0x1p-300 && size_ <= 0x1p300)) {  // lengths are squared
    refuse("solids larger than 2^300 or smaller than 2^-300 have no depth; scale them.");
  }
}

template <typename S>
MeshPair SolidPair<S>::moved(const Vec& translation) const {
  fcl::Transform3d X_WA = X_WA_, X_WB = X_WB_;
  if (moves_a_) {
    X_WA.translation() -= translation;
  } else {
    X_WB.translation() += translation;
  }
  return {frame_.a, X_WA, frame_.b, X_WB, squared_errors_};
}

template <typename S>
typename SolidPair<S>::Overlap SolidPair<S>::overlapAfter(const Vec& translation,
                                                          std::size_t limit) {
  ++tests_;
  Overlap result;
  const MeshPair frame = moved(translation);
  if (frame.rootBound(0) > 0) return result;
  for (const auto& ids : searchContacts(frame, limit, counts_)) {
    result.contacts.push_back({frame.triangleA(ids.a), frame.triangleB(ids.b)});
  }
  if (!result.contacts.empty()) return result;
  if (const auto p =
          containedPoint(a_, b_, frame, counts_)) {  // on the one's surface, in the other
    constexpr double kCoarse = 0.05;
    const Vec on_b = nearestSurface(b_, toB(frame.X_AB, *p), kCoarse).point;
    result.to_wall = nearestSurface(a_, *p, kCoarse).point - frame.X_AB * on_b;
  }
  return result;
}

template <typename S>
const typename SolidPair<S>::Overlap& SolidPair<S>::overlap() {
  constexpr std::size_t kContacts = 16;
  if (!overlap_) overlap_ = overlapAfter(Vec::Zero(), kContacts);
  return *overlap_;
}

template <typename S>
Separation SolidPair<S>::test(const Vec& translation, double reach) {
  ++tests_;
  const MeshPair moved = this->moved(translation);
  Separation result;
  engine::PairQuery query;
  query.rel_err = 0.1;
  query.far_enough = std::max(reach, 8 * rounding_);
  const DistanceAnswerd answer = bracketDistance(moved, query);
  counts_ += answer.counts;
  result.gap = answer.lower_bound;
  if (!(result.gap > 0) || containedPoint(a_, b_, moved, counts_)) return result;
  result.apart = true;
  if (answer.triangle_a < 0) return result;
  const Vec on_a = answer.point_a, between = answer.point_b - on_a;
  const double length = between.norm();
  if (!(length > 64 * rounding_)) {
    // The difference has lost its digits; the faces' normals have not.
    const Vec n =
        normalOf(moved.triangleA(answer.triangle_a)) - normalOf(moved.triangleB(answer.triangle_b));
    if (!(n.norm() > 0x1p-20)) return result;
    result.normal = R_WA_ * n.normalized();
  } else {
    result.normal = R_WA_ * (between / length);
  }
  result.on_a = R_WA_ * on_a + t_WA_;
  result.on_b = result.on_a + R_WA_ * between;
  result.nearest = true;
  return result;
}

template class SolidPair<double>;
template class SolidPair<float>;

}  // namespace kios
