// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "search/double_bound.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "tree/box_fit.h"
#include "volume/rounding.h"

namespace kios::engine {
namespace {

bool isBoxed(const Tree& tree, std::uint32_t id) { return isTriangle(id) || !tree.boxes.empty(); }

Box boxOf(const Tree& tree, std::uint32_t id) {
  if (id == 0) return tree.root_box;
  if (!isTriangle(id)) return tree.boxes[id];
  return triangleBox(tree, tree.leaves[leafOfTriangle(id)], laneOfTriangle(id));
}

/// Lower bound of the distance of what a box of one tree holds from a ball in the other's frame.
// In b's frame the transpose serves as the inverse: |R^-1 - R^T| <= 2 stretch, but for its square,
// and lengths there are up to 1 + stretch times a's. frame_error has 2 stretch S of these.
double ballBound(const Box& box, bool is_of_a, const Node& ball, const TreePose& X) {
  const Eigen::Vector3d center(ball.x[kCentral], ball.y[kCentral], ball.z[kCentral]);
  const double radius = ball.r[kCentral];
  const Eigen::Vector3d moved = is_of_a ? Eigen::Vector3d(X.R * center + X.t)
                                        : Eigen::Vector3d(X.R.transpose() * (center - X.t));
  const double stored = kStored * (center.lpNorm<1>() + radius);
  const double more = is_of_a ? 0 : 2 * X.stretch * X.scale;
  return boxBound(box, moved) - (radius + stored) - X.frame_error - more - kDouble * X.scale;
}

}  // namespace

// The axes e_i are orthonormal but for the rounding of each, so w is the sum of (w . d_i) e_i with
// d_i dual to them, and |w . (p - centre)| at most that of |w . d_i| h_i.
double reachAlong(const Box& box, const Eigen::Vector3d& w) {
  const Eigen::Vector3d e0 = columnOf(box, 0), e1 = columnOf(box, 1), e2 = columnOf(box, 2);
  const Eigen::Vector3d n0 = e1.cross(e2), n1 = e2.cross(e0), n2 = e0.cross(e1);
  const double sum = std::abs(w.dot(n0)) * box.half[0] + std::abs(w.dot(n1)) * box.half[1] +
                     std::abs(w.dot(n2)) * box.half[2];
  return sum / std::abs(e0.dot(n0));
}

DoubleBound::DoubleBound(const Box& a, const Box& b, const TreePose& X)
    : a_(a), b_(b), R_(X.R), way_(X.R * columnOf(b, kCenter) + X.t - columnOf(a, kCenter)) {
  const double extents = extentOf(a) + extentOf(b);
  pad_ = kStored * extents + X.frame_error + kDouble * (extents + X.t.lpNorm<1>());
}

double DoubleBound::alongA(int i) const {
  const Eigen::Vector3d w = columnOf(a_, i);
  return along(w, double{a_.half[i]}, reachAlong(b_, R_.transpose() * w));
}

double DoubleBound::alongB(int j) const { return along(R_ * columnOf(b_, j)); }

double DoubleBound::acrossEdges(int i, int j) const {
  return along(columnOf(a_, i).cross(R_ * columnOf(b_, j)));
}

double DoubleBound::along(const Eigen::Vector3d& w) const {
  return along(w, reachAlong(a_, w), reachAlong(b_, R_.transpose() * w));
}

double DoubleBound::along(const Eigen::Vector3d& w, double reach_a, double reach_b) const {
  constexpr double kLeast = 0x1p-20;  // of products that are not nearly parallel
  const double square = w.squaredNorm();
  if (!(square > kLeast)) return -kInfinity;
  return (std::abs(w.dot(way_)) - (reach_a + reach_b)) / std::sqrt(square) - pad_;
}

// The axes' lengths are 1 but for 2 u, u = 2^-24.
[[gnu::hot]] double boxBound(const Box& box, const Eigen::Vector3d& point, const OutOfBox& out) {
  const double extent = extentOf(box);
  return (1 - 4 * kUlpFloat) * out.height - kStored * extent -
         kDouble * (extent + point.lpNorm<1>());
}

// Along w, b's points are at w . (R q + t) = (R^T w) . q + w . t.
double boundAlong(const float (&direction)[3], const StoredPoints& a, const StoredPoints& b,
                  const TreePose& X) {
  const Eigen::Vector3d w(direction[0], direction[1], direction[2]);
  double farthest = 0;  // from the origins
  const auto least = [&farthest](const StoredPoints& points, const Eigen::Vector3d& along) {
    double result = kInfinity;
    for (int i = 0; i < points.count; ++i) {
      const Lanes* const chunk = points.rows + 3 * (i / kLanes);
      const double x = chunk[0].v[i % kLanes], y = chunk[1].v[i % kLanes],
                   z = chunk[2].v[i % kLanes];
      result = std::min(result, x * along[0] + y * along[1] + z * along[2]);
      farthest = std::max(farthest, std::abs(x) + std::abs(y) + std::abs(z));
    }
    return result;
  };
  const double gap = w.dot(X.t) + least(b, X.R.transpose() * w) + least(a, -w);
  return gap / w.norm() - 2 * kStored * farthest - X.frame_error - kDouble * X.scale;
}

double boundInDouble(const Search& search, std::uint32_t node_a, std::uint32_t node_b) {
  const Tree &a = search.a, &b = search.b;
  if (!isBoxed(a, node_a)) {
    const double bound = ballBound(boxOf(b, node_b), false, a.nodes[node_a], search.pose);
    if (bound > 0 || node_a != 0) return bound;
  } else if (!isBoxed(b, node_b)) {
    const double bound = ballBound(boxOf(a, node_a), true, b.nodes[node_b], search.pose);
    if (bound > 0 || node_b != 0) return bound;
  }
  const Box box_a = boxOf(a, node_a), box_b = boxOf(b, node_b);
  const DoubleBound bound(box_a, box_b, search.pose);
  for (int i = 0; i < 3; ++i) {
    const double along = std::max(bound.alongA(i), bound.alongB(i));
    if (along > 0) return along;
  }
  return 0;
}

}  // namespace kios::engine
