// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <string>

#include "fcl_kios/triangle.h"
#include "scenes/rational_oracle.h"
#include "scenes/triangle_classes.h"

// Checks the promises of the triangle kernels' headers for one pair. Shared by the tests and the
// fuzz target.

namespace kios::testing {

using scenes::TrianglePair;

/// Holds the pair with its coordinates rounded to S, as triangles of S and again of doubles.
template <typename S>
struct RoundedPair {
  TriangleVertices<S> a, b;
  TrianglePair exact;
  bool finite = true;

  explicit RoundedPair(const TrianglePair& pair) {
    for (int i = 0; i < 3; ++i) {
      round(pair.a[i], a[i], exact.a[i]);
      round(pair.b[i], b[i], exact.b[i]);
    }
  }

 private:
  // volatile: g++ 12 vectorises double -> float -> double of neighbours to no rounding at all.
  void round(const Eigen::Vector3d& from, Point<S>& to, Eigen::Vector3d& back) {
    for (int c = 0; c < 3; ++c) {
      const volatile S v = static_cast<S>(from[c]);
      to[c] = v;
      back[c] = v;
      finite = finite && std::isfinite(back[c]);
    }
  }
};

/// Returns the pair in hex floats, to be pasted into a test.
inline std::string text(const TrianglePair& pair) {
  std::string out;
  for (const auto* corners : {&pair.a, &pair.b}) {
    out += corners == &pair.a ? "{{{" : ", {{";
    for (int i = 0; i < 3; ++i) {
      char line[128];
      const Eigen::Vector3d& p = (*corners)[i];
      std::snprintf(line, sizeof line, "%s{%a, %a, %a}", i == 0 ? "" : ", ", p[0], p[1], p[2]);
      out += line;
    }
    out += "}}";
  }
  return out + "}";
}

/// Holds errors in units of eps L, and the first promise that is broken, if any.
struct ContractResult {
  double distance_error = 0;      ///< of the distance
  double witness_error = 0;       ///< of |point_a - point_b|, and off the triangles
  double intersection_error = 0;  ///< of intersectionPoint, off the triangles
  bool intersect = false;         ///< the exact verdict
  std::string broken;
};

template <typename S>
class ContractCheck {
 public:
  explicit ContractCheck(const RoundedPair<S>& pair)
      : pair_(pair),
        extent_(scenes::extent(pair.exact)),
        oracle_(scenes::rationalDistance(pair.exact)) {
    result_.intersect = oracle_.intersect;
    require(trianglesIntersect(pair.a, pair.b) == oracle_.intersect, "the verdict is wrong");
    checkDistance();
    if (oracle_.intersect) checkIntersectionPoint();
  }

  const ContractResult& result() const { return result_; }

 private:
  static constexpr long double kEps = std::numeric_limits<S>::epsilon();
  static constexpr long double kLeast = std::numeric_limits<S>::denorm_min();

  void require(bool kept, const char* broken) {
    if (!kept && result_.broken.empty()) result_.broken = broken;
  }

  /// Returns 16 eps L, and the rounding of a result below the normal numbers.
  long double distanceBound() const { return 16 * kEps * extent_ + kLeast; }

  /// Returns points also suffer from the rounding of coordinates, which an offset makes large.
  long double pointBound() const {
    return distanceBound() + 2 * kEps * static_cast<long double>(magnitude(pair_.exact)) +
           4 * kLeast;
  }

  double inUnits(long double error) const {
    return extent_ > 0 ? static_cast<double>(error / (kEps * extent_)) : 0;
  }

  static long double norm(const Point<S>& p, const Point<S>& q) {
    return (p.template cast<long double>() - q.template cast<long double>()).norm();
  }

  static long double offTriangle(const Point<S>& p, const std::array<Eigen::Vector3d, 3>& t) {
    if (!p.allFinite()) return std::numeric_limits<long double>::infinity();
    const Eigen::Vector3d point = p.template cast<double>();
    if (std::find(t.begin(), t.end(), point) != t.end()) return 0;
    return scenes::rationalDistance(point, t);
  }

  void checkDistance() {
    const TriangleDistance<S> d = triangleDistance(pair_.a, pair_.b);
    require(std::isfinite(d.distance) && d.distance >= 0, "the distance is no number");
    require((d.distance == 0) == oracle_.intersect,
            oracle_.intersect ? "the distance of a hit is not 0" : "the distance is 0, but no hit");
    const long double error = std::abs(static_cast<long double>(d.distance) - oracle_.distance);
    result_.distance_error = inUnits(error);
    require(error <= distanceBound(), "the distance is wrong");

    const long double gap_error = std::abs(norm(d.point_a, d.point_b) - d.distance);
    require(gap_error <= pointBound(), "the witness points do not realise the distance");
    const long double off = std::max(offFeature(d.point_a, d.feature_a, pair_.exact.a),
                                     offFeature(d.point_b, d.feature_b, pair_.exact.b));
    if (oracle_.intersect) {
      require(d.point_a == d.point_b, "the witness points of a hit differ");
      noteIntersectionPoint(off);
    } else {
      require(off <= pointBound(), "a witness point is not on the feature named");
      result_.witness_error = inUnits(std::max(gap_error, off));
    }
  }

  static long double offFeature(const Point<S>& p, TriangleFeature feature,
                                const std::array<Eigen::Vector3d, 3>& t) {
    const int f = static_cast<int>(feature);
    if (f < 3) return offTriangle(p, {t[f], t[f], t[f]});
    if (f < 6) return offTriangle(p, {t[f - 3], t[(f - 2) % 3], t[f - 3]});
    return offTriangle(p, t);
  }

  void checkIntersectionPoint() {
    const Point<S> p = intersectionPoint(pair_.a, pair_.b);
    noteIntersectionPoint(std::max(offTriangle(p, pair_.exact.a), offTriangle(p, pair_.exact.b)));
  }

  /// The error depends on the angle of the planes: only a point far away breaks the contract.
  void noteIntersectionPoint(long double error) {
    result_.intersection_error = std::max(result_.intersection_error, inUnits(error));
    require(error <= 0x1p-8L * extent_ + pointBound(),
            "the common point is far from the triangles");
  }

  const RoundedPair<S>& pair_;
  const long double extent_;
  const scenes::RationalDistance oracle_;
  ContractResult result_;
};

template <typename S>
ContractResult contractOf(const RoundedPair<S>& pair) {
  return ContractCheck<S>(pair).result();
}

constexpr std::array<std::array<int, 3>, 6> kVertexOrders{
    {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}}};

/// True if distance, points and verdict stay the same with the vertices in orders p and q, and with
/// swapped triangles.
template <typename S>
bool sameForOrder(const RoundedPair<S>& pair, const std::array<int, 3>& p,
                  const std::array<int, 3>& q) {
  const TriangleVertices<S> a = {pair.a[p[0]], pair.a[p[1]], pair.a[p[2]]};
  const TriangleVertices<S> b = {pair.b[q[0]], pair.b[q[1]], pair.b[q[2]]};
  const TriangleDistance<S> expected = triangleDistance(pair.a, pair.b);
  const TriangleDistance<S> ordered = triangleDistance(a, b), swapped = triangleDistance(b, a);
  const bool intersect = trianglesIntersect(pair.a, pair.b);
  return ordered.distance == expected.distance && ordered.point_a == expected.point_a &&
         ordered.point_b == expected.point_b && swapped.distance == expected.distance &&
         swapped.point_a == expected.point_b && swapped.point_b == expected.point_a &&
         trianglesIntersect(a, b) == intersect && trianglesIntersect(b, a) == intersect;
}

/// Checks it for all 72 ways to pass the pair.
template <typename S>
bool sameForAllOrders(const RoundedPair<S>& pair) {
  for (const auto& p : kVertexOrders) {
    for (const auto& q : kVertexOrders) {
      if (!sameForOrder(pair, p, q)) return false;
    }
  }
  return true;
}

}  // namespace kios::testing
