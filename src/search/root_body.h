// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cmath>

#include "search/float_frame.h"
#include "search/mesh.h"
#include "search/search.h"
#include "tree/tree.h"
#include "volume/lanes.h"
#include "volume/rounding.h"

// The one place that tells two bodies apart by their roots: by their central balls in the world,
// which takes little and decides most pairs of a scene, and then by rootBound(). Searches ask it
// about nodes that floats leave open, as where bodies all but lie on each other.

namespace kios::engine {

/// What contains a body: a ball, and a box or half-space. A mesh's are relative to its tree's
/// origin, so that coordinates far from 0 cost no precision.
struct RootBody {
  /// kPlane is {axis 0 . (x - middle) = 0}, kHalfspace {... <= 0}: neither has a ball, nor halves.
  enum class Form { kBox, kHalfspace, kPlane };

  Form form = Form::kBox;
  Eigen::Vector3d center = Eigen::Vector3d::Zero();  ///< of the ball
  double radius = 0;
  /// Coordinates x, y, z of the axes, which are orthonormal but for `skew` each, and of the middle.
  Eigen::Array4d rows[3] = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}};
  Eigen::Array4d half = Eigen::Array4d::Zero();  ///< the fourth is 0
  double skew = 0;
  double round = 0;  ///< content is within this of the box
};

/// Root of a mesh with a tree of ordinary size.
RootBody rootOf(const Mesh& mesh);

/// Lower bound of the distance of two bodies as the narrow phase computes it in a's frame, by
/// balls, balls and boxes, the boxes' axes and the products of these: the best of them, or the
/// first above `enough`. Negative where nothing is proven. Only a may be unbounded.
double rootBound(const RootBody& a, const RootBody& b, const TreePose& X_AB, double enough);

/// In double, content is within a box but for the rounding of stored vertices, of kStored times how
/// far it reaches from its tree's origin; all else is 2^-53 of the lengths that enter, some sixty
/// times.
inline constexpr double kStored = 1.01 * kUlpFloat, kDouble = 0x1p-44;

/// rootBound() of two nodes, or triangles of leaves.
double boundInDouble(const Search& search, std::uint32_t node_a, std::uint32_t node_b);

/// Points as a leaf stores them: rows x, y, z by chunk.
struct StoredPoints {
  const Lanes* rows;
  int count;
};

/// Lower bound of the distance of points of a and of b along a direction in a's frame, of any
/// length, from a to b.
double boundAlong(const float (&w)[3], const StoredPoints& a, const StoredPoints& b,
                  const TreePose& X_AB);

/// Lengths for which bounds in double neither overflow nor vanish.
constexpr double kNearest = 0x1p-90, kFarthest = 0x1p40;

/// True only if balls at c_a and c_b in two frames are proven farther apart than `margin` >= 0, as
/// rootBound() would prove it in the common frame; false says nothing. `squared_errors` is
/// squaredRotationErrors(X_WA, X_WB).
// The way between the centres is w = (t_B - t_A) + (R_B c_b - R_A c_a) in W. With e the root of
// `squared_errors` and m = |t_B - t_A|_1 + |c_a|_1 + |c_b|_1 + r_a + r_b + margin: R_A^T w is the
// way in A but for |R_A^T R_A - I| |c_a|, |R_A^T w| >= (1 - e) |w|, and b's radius in A is (1 + e)
// r_b: these terms with e are below 3 e m, and all roundings, here and in the common frame
// (volume/error_bounds.h), below 256 u m. kSlack m is more than both where e is at most kSlack / 4.
// NaN, infinities and lengths of kFarthest and more prove nothing: the common frame judges them.
template <typename A, typename B, typename S>
[[gnu::always_inline]] inline bool ballsApart(const A& c_a, const fcl::Transform3<S>& X_WA,
                                              const B& c_b, const fcl::Transform3<S>& X_WB,
                                              double radii, double squared_errors, double margin) {
  constexpr double kSlack = sizeof(S) == sizeof(double) ? 0x1p-36 : 0x1p-12, kMost = kSlack / 4;
  constexpr double kLeastSquare = 0x1p-200;
  const auto &m_a = X_WA.matrix(), &m_b = X_WB.matrix();
  const auto entry = [&](int i, int j) {
    return lanes::Double2{double{m_a(i, j)}, double{m_b(i, j)}};
  };
  const auto center = [&](int j) { return lanes::Double2{double{c_a[j]}, double{c_b[j]}}; };
  const lanes::Double2 cx = center(0), cy = center(1), cz = center(2);
  const lanes::Double2 norms = lanes::abs(cx) + lanes::abs(cy) + lanes::abs(cz);
  double lengths = radii + margin + (norms[0] + norms[1]), w[3];
  for (int i = 0; i < 3; ++i) {
    const lanes::Double2 turned = entry(i, 0) * cx + entry(i, 1) * cy + entry(i, 2) * cz;
    const double between = double{m_b(i, 3)} - double{m_a(i, 3)};
    w[i] = between + (turned[1] - turned[0]);
    lengths += std::abs(between);
  }
  if (!(lengths < kFarthest && squared_errors <= kMost * kMost)) return false;
  const double least = radii + margin + kSlack * lengths;
  const double square = w[0] * w[0] + w[1] * w[1] + w[2] * w[2];
  return square > least * least && square > kLeastSquare;
}

}  // namespace kios::engine
