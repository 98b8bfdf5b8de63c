// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <utility>

#include "fcl_kios/triangle.h"

namespace kios {

/// Signs of determinants by plain arithmetic: (p - origin) . (e x f).
class PlainPlane {
 public:
  PlainPlane(const Pointd& origin, const Pointd& to_e, const Pointd& to_f) : origin_(origin) {
    const Pointd e = to_e - origin, f = to_f - origin;
    size_ = e.lpNorm<1>() * f.lpNorm<1>();
    if (size_ <= kMostSize) normal_ = e.cross(f);  // infinities would raise flags
  }

  /// -1 or 1, or 0 if rounding might have made the sign.
  // Differences are off by u each, so components of the normal by 4 u times the sizes of their two
  // products, and the sum of three products by 8 u |e|_1 |f|_1 |p - origin|_max, u = 2^-53. What
  // underflows adds less than 2^-700 within these ranges.
  int side(const Pointd& p) const {
    const Pointd d = p - origin_;
    const double reach = d.lpNorm<Eigen::Infinity>();
    if (!(size_ <= kMostSize && reach <= 0x1p300)) return 0;
    const double height = normal_.dot(d), error = 16 * 0x1p-53 * size_ * reach + 0x1p-700;
    return (height > error) - (height < -error);
  }

 private:
  static constexpr double kMostSize = 0x1p600;

  Pointd origin_, normal_;
  double size_;
};

/// The plane of a triangle.
inline PlainPlane planeOf(const TriangleVerticesd& t) { return {t[2], t[1], t[0]}; }

enum class Plainly { kApart, kMeet, kUnclear };

/// Whether two triangles intersect, where every sign that decides is clear by
/// plain arithmetic: nearly always. The steps are those of PairIntersection (Guigue and Devillers,
/// 2003).
[[gnu::hot]] inline Plainly plainlyMeet(const TriangleVerticesd& a, const TriangleVerticesd& b) {
  const PlainPlane plane_a = planeOf(a), plane_b = planeOf(b);
  int side_a[3], side_b[3];
  for (int i = 0; i < 3; ++i) side_b[i] = plane_a.side(b[i]);
  if (std::abs(side_b[0] + side_b[1] + side_b[2]) == 3) return Plainly::kApart;
  for (int i = 0; i < 3; ++i) side_a[i] = plane_b.side(a[i]);
  if (std::abs(side_a[0] + side_a[1] + side_a[2]) == 3) return Plainly::kApart;
  const auto unclear = [](const int(&side)[3]) { return side[0] * side[1] * side[2] == 0; };
  if (unclear(side_a) || unclear(side_b)) return Plainly::kUnclear;
  // Each meets the planes' common line between two edges, which start in the vertex that is alone
  // on its side.
  const auto alone = [](const int(&side)[3]) {
    return side[1] == side[2] ? 0 : (side[0] == side[2] ? 1 : 2);
  };
  const int of_a = alone(side_a), of_b = alone(side_b);
  int begin_a = (of_a + 1) % 3, end_a = (of_a + 2) % 3;
  int begin_b = (of_b + 1) % 3, end_b = (of_b + 2) % 3;
  if (side_a[of_a] > 0) std::swap(begin_b, end_b);
  if (side_b[of_b] < 0) std::swap(begin_a, end_a);
  const auto order = [&](int i, int j) {  // of these edges' crossings along the line
    return PlainPlane(b[j], a[of_a], a[i]).side(b[of_b]);
  };
  const int first = order(begin_a, end_b), last = order(end_a, begin_b);
  if (first > 0 || last < 0) return Plainly::kApart;
  return first < 0 && last > 0 ? Plainly::kMeet : Plainly::kUnclear;
}

}  // namespace kios
