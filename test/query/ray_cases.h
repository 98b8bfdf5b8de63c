// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "fcl_kios/rays.h"
#include "scenes/ray_oracle.h"
#include "shapes.h"

// Rays and brute force that the tests of ray queries share.

namespace kios::testing {

template <typename S>
const fcl::Transform3<S> kIdentity = fcl::Transform3<S>::Identity();

struct ExactHit {
  int triangle;
  scenes::RationalRayHit hit;
};

/// Returns every triangle that the ray meets, in the model's frame.
template <typename S>
std::vector<ExactHit> bruteForce(const Model<S>& model, const Ray<S>& ray) {
  const scenes::RationalRay exact = {ray.origin.template cast<double>(),
                                     ray.direction.template cast<double>(), ray.t_min,
                                     std::min<double>(ray.t_max, std::numeric_limits<S>::max())};
  std::vector<ExactHit> hits;
  for (int t = 0; t < model.num_tris; ++t) {
    std::array<Eigen::Vector3d, 3> corners;
    for (std::size_t i = 0; i < 3; ++i) {
      corners[i] = model.vertices[model.tri_indices[t][i]].template cast<double>();
    }
    if (const auto hit = scenes::rationalRayHit(exact, corners)) hits.push_back({t, *hit});
  }
  return hits;
}

/// One rounding of t to S, after one to double.
template <typename S>
void expectNearest(S t, long double exact) {
  const S next = std::nextafter(std::abs(t), std::numeric_limits<S>::infinity());
  const auto half = 0.5L * (static_cast<long double>(next) - std::abs(t));
  EXPECT_LE(std::abs(static_cast<long double>(t) - exact), half * (1 + 0x1p-9L));
}

template <typename S>
bool same(const RayHit<S>& a, const RayHit<S>& b) {
  return a.t == b.t && a.triangle == b.triangle && a.side == b.side && a.point == b.point &&
         a.weights == b.weights;
}

/// All three queries are consistent with each other; returns all hits.
template <typename S>
std::vector<RayHit<S>> askAll(const Model<S>& model, const fcl::Transform3<S>& X, const Ray<S>& ray,
                              SearchCounts* counts = nullptr) {
  constexpr std::size_t kAll = std::numeric_limits<std::size_t>::max();
  const auto all = allHits(model, X, ray, kAll, counts);
  const auto first = firstHit(model, X, ray);
  EXPECT_EQ(first.has_value(), !all.empty());
  EXPECT_EQ(anyHit(model, X, ray), !all.empty());
  EXPECT_TRUE(!first || all.empty() || same(*first, all[0]));
  for (std::size_t i = 1; i < all.size(); ++i) {
    EXPECT_LE(all[i - 1].t, all[i].t);
    EXPECT_NE(all[i - 1].triangle, all[i].triangle);
  }
  for (const std::size_t limit : {std::size_t{0}, all.size() / 2, all.size() + 1}) {
    const auto some = allHits(model, X, ray, limit);
    EXPECT_EQ(some.size(), std::min(limit, all.size()));
    for (std::size_t i = 0; i < std::min(some.size(), all.size()); ++i) {
      EXPECT_TRUE(same(some[i], all[i]));
    }
  }
  return all;
}

/// The weights' point lies on the ray at t, and is what is told.
template <typename S>
void expectOnBoth(const Model<S>& model, const Ray<S>& ray, const RayHit<S>& hit) {
  using Long = Eigen::Matrix<long double, 3, 1>;
  const Long start = ray.origin.template cast<long double>(),
             way = hit.t * ray.direction.template cast<long double>();
  Long point = Long::Zero();
  long double size = start.norm() + way.norm();
  for (int i = 0; i < 3; ++i) {
    const Long corner =
        model.vertices[model.tri_indices[hit.triangle][i]].template cast<long double>();
    point += hit.weights[i] * corner;
    size += corner.norm();
  }
  // Numbers below the least normal one are rounded absolutely.
  const long double bound = 8 * std::numeric_limits<S>::epsilon() * size +
                            8 * static_cast<long double>(std::numeric_limits<S>::denorm_min());
  EXPECT_LE((start + way - point).norm(), bound);
  EXPECT_LE((hit.point.template cast<long double>() - point).norm(), bound);
}

/// Asks all queries against brute force, the model at the world's origin. Returns the number of
/// hits.
template <typename S>
std::size_t expectBruteForce(const Model<S>& model, const Ray<S>& ray) {
  SCOPED_TRACE(::testing::Message()
               << std::hexfloat << "origin " << ray.origin.transpose() << " direction "
               << ray.direction.transpose() << " t " << ray.t_min << " " << ray.t_max);
  auto hits = askAll(model, kIdentity<S>, ray);
  const auto exact = bruteForce(model, ray);
  EXPECT_EQ(hits.size(), exact.size());
  if (hits.size() != exact.size()) return hits.size();
  std::sort(hits.begin(), hits.end(),
            [](const auto& a, const auto& b) { return a.triangle < b.triangle; });
  for (std::size_t i = 0; i < hits.size(); ++i) {
    EXPECT_EQ(hits[i].triangle, exact[i].triangle);
    expectNearest(hits[i].t, exact[i].hit.t);
    const auto& hit = exact[i].hit;
    EXPECT_EQ(hits[i].side, !hit.crosses ? RaySide::kEdgeOn
                                         : (hit.along_normal ? RaySide::kBack : RaySide::kFront));
    expectOnBoth(model, ray, hits[i]);
  }
  return hits.size();
}

/// Holds rays that are hard for a mesh: through its vertices and edges, along its edges, in its
/// planes, from its points, and any.
template <typename S>
class HardRays {
 public:
  HardRays(const Model<S>& model, std::uint64_t seed) : model_(model), random_(seed) {
    const kIOS<S>& root = model.getBV(0).bv;
    center_ = root.center0;
    size_ = root.radius0 > 0 ? root.radius0 : S(1);
  }

  Ray<S> next() {
    const int kind = count_++ % 8;
    const auto t = static_cast<int>(random_.unit() * model_.num_tris);
    const fcl::Vector3<S> p = corner(t, 0), q = corner(t, 1), r = corner(t, 2);
    fcl::Vector3<S> target = p;
    if (kind == 1) target = S(0.5) * (p + q);
    if (kind == 2) target = p + static_cast<S>(random_.unit()) * (q - p);
    if (kind == 3) target = (p + q + r) / S(3);
    if (kind == 7) target = center_ + size_ * vector();
    Ray<S> ray;
    ray.origin = center_ + S(2) * size_ * vector();
    ray.direction = target - ray.origin;
    if (kind == 4) {  // along an edge
      ray.direction = q - p;
      ray.origin = p - ray.direction;
    }
    if (kind == 5) {  // along an axis, from above a vertex
      ray.origin = p;
      ray.origin[count_ % 3] += S(3) * size_;
      ray.direction = -fcl::Vector3<S>::Unit(count_ % 3);
    }
    if (kind == 6) {  // from the mesh
      ray.origin = target;
      ray.direction = vector();
    }
    if (ray.direction.isZero(0)) ray.direction = fcl::Vector3<S>::UnitZ();
    if (count_ % 5 == 0) ray.t_min = S(-1);
    if (count_ % 7 == 0) ray.t_max = S(1);
    return ray;
  }

 private:
  fcl::Vector3<S> corner(int t, std::size_t k) const {
    return model_.vertices[model_.tri_indices[t][k]];
  }
  fcl::Vector3<S> vector() {
    const double x = random_.uniform(-1, 1), y = random_.uniform(-1, 1);
    return fcl::Vector3d(x, y, random_.uniform(-1, 1)).cast<S>();
  }

  const Model<S>& model_;
  Random random_;
  fcl::Vector3<S> center_;
  S size_;
  int count_ = 0;
};

}  // namespace kios::testing
