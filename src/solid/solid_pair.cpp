// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "solid/solid_pair.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>
#include "fcl_kios/triangle/intersection.h"
#include "query/bracket.h"
#include "query/pair_search.h"
#include "solid/containment.h"
#include "solid/nearest_surface.h"
#include "volume/errors.h"

namespace kios {
namespace {

using Vec = fcl::Vector3d;

template <typename S>
Vec normalOf(const TriangleVertices<S>& t) {
  const Vec p = t[0].template cast<double>();
  const Vec n = (t[1].template cast<double>() - p).cross(t[2].template cast<double>() - p);
  const double length = n.norm();
  return length > 0 ? Vec(n / length) : Vec(Vec::Zero());
}

}  // namespace

template <typename S>
SolidPair<S>::SolidPair(const Model<S>& a, const fcl::Transform3<S>& X_WA, const Model<S>& b,
                        const fcl::Transform3<S>& X_WB, SearchCounts& counts)
    : X_WA_(X_WA),
      X_WB_(X_WB),
      counts_(counts),
      frame_(a, X_WA, b, X_WB),
      state_a_(requireSolid(a)),
      state_b_(requireSolid(b)),
      R_WA_(X_WA.linear().template cast<double>()),
      t_WA_(X_WA.translation().template cast<double>()) {
  R_AB_ = R_WA_.transpose() * X_WB.linear().template cast<double>();
  T_AB_ = R_WA_.transpose() * (X_WB.translation().template cast<double>() - t_WA_);
  size_ = double{frame_.rootA().radius0} + double{frame_.rootB().radius0};
  rounding_ = frame_.distanceError(size_);
  if (!(size_ >= 0x1p-300 && size_ <= 0x1p300)) {  // lengths are squared
    refuse("solids larger than 2^300 or smaller than 2^-300 have no depth; scale them.");
  }
}

template <typename S>
MeshPair<S> SolidPair<S>::moved(const Vec& translation) const {
  fcl::Transform3<S> X_WB = X_WB_;
  X_WB.translation() += translation.template cast<S>();
  return {frame_.a, X_WA_, frame_.b, X_WB};
}

template <typename S>
bool SolidPair<S>::seemsApart(const Vec& translation) {
  ++tests_;
  const MeshPair<S> frame = moved(translation);
  return !surfacesMeet(frame, counts_) && !containedPoint(frame, counts_);
}

template <typename S>
double SolidPair<S>::wayBetween(const Vec& from, const Vec& to) const {
  const fcl::Vector3<S> p = X_WB_.translation() + from.template cast<S>(),
                        q = X_WB_.translation() + to.template cast<S>();
  return (q.template cast<double>() - p.template cast<double>()).norm();
}

template <typename S>
typename SolidPair<S>::Test SolidPair<S>::test(const Vec& translation, double reach) {
  ++tests_;
  const MeshPair<S> moved = this->moved(translation);
  Test result;
  engine::PairQuery query;
  query.rel_err = 0.1;
  query.far_enough = std::max(reach, 8 * rounding_);
  const DistanceAnswer<S> answer = bracketDistance(moved, query);
  counts_ += answer.counts;
  result.gap = answer.lower_bound;
  if (!(result.gap > 0) || containedPoint(moved, counts_)) return result;
  result.apart = true;
  if (answer.triangle_a < 0) return result;
  const Vec on_a = answer.point_a.template cast<double>();
  const Vec between = answer.point_b.template cast<double>() - on_a;
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
  result.nearest = true;
  return result;
}

template <typename S>
std::vector<Vec> SolidPair<S>::exitDirections() {
  std::vector<Vec> directions;
  const auto add = [&](const Vec& v) {
    const double length = v.norm();
    if (!(length > 1e-6)) return;
    const Vec n = v / length;
    for (const Vec& other : directions) {
      if (other.dot(n) > 0.98) return;
    }
    directions.push_back(n);
  };
  std::vector<engine::TrianglePairIds> ids;
  constexpr std::size_t kContacts = 8;
  if (!searchContacts(frame_, kContacts, ids, counts_)) ids.clear();
  Vec out_of_a = Vec::Zero(), out_of_b = Vec::Zero();
  std::vector<Vec> normals;
  for (const auto& pair : ids) {
    normals.push_back(normalOf(frame_.triangleA(pair.a)));
    out_of_a += normals.back();
    normals.push_back(-normalOf(frame_.triangleB(pair.b)));
    out_of_b += normals.back();
    constexpr std::size_t kSeams = 4;
    if (seams_.size() < kSeams && normals.size() % 4 == 2) {
      const Vec at = intersectionPoint(frame_.triangleA(pair.a), frame_.triangleB(pair.b))
                         .template cast<double>();
      seams_.push_back({at, normals.back() - normals[normals.size() - 2]});
    }
  }
  add(out_of_a);
  add(out_of_b);
  add(out_of_a + out_of_b);
  const Vec center_a = frame_.rootA().center0.template cast<double>();
  const Vec center_b = frame_.rootB().center0.template cast<double>();
  const Vec b_in_a = R_AB_ * center_b + T_AB_;
  add(b_in_a - center_a);
  if (ids.empty()) {  // one is in the other: by the wall nearest to its centre
    const Vec a_in_b = R_AB_.transpose() * (center_a - T_AB_);
    const auto addWall = [&](const Vec& way, double radius) {
      add(way);
      if (way.norm() > 0) walls_.emplace_back(R_WA_ * (way + radius * way.normalized()));
    };
    addWall(nearestSurface(frame_.a, b_in_a, 0.05).point - b_in_a, double{frame_.rootB().radius0});
    addWall(R_AB_ * (a_in_b - nearestSurface(frame_.b, a_in_b, 0.05).point),
            double{frame_.rootA().radius0});
  }
  constexpr std::size_t kMost = 6;
  for (const Vec& n : normals) {
    if (directions.size() < kMost) add(n);
  }
  for (int c = 0; c < 3 && directions.size() < kMost; ++c) {
    add(Vec::Unit(c));
    add(-Vec::Unit(c));
  }
  for (Vec& n : directions) n = (R_WA_ * n).normalized();
  return directions;
}

template class SolidPair<double>;
template class SolidPair<float>;

}  // namespace kios
