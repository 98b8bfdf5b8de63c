// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "solid/depth_in_solid.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <Eigen/Geometry>
#include "query/nearest_on_mesh.h"
#include "search/mesh_pair.h"
#include "solid/containment.h"
#include "solid/solid_mark.h"
#include "solid/solid_pair.h"
#include "solid/tuning.h"
#include "volume/error_bounds.h"
#include "volume/rounding.h"

namespace kios {
namespace {

using Vec = fcl::Vector3d;

/// A convex piece where it was moved to, between planes.
class MovedPiece {
 public:
  MovedPiece(const ConvexPiece& piece, const Vec& v) : piece_(piece), v_(v) {
    const Vec n = piece.isFlat() ? piece.normal() : Vec(Vec::UnitZ());
    const Vec side = n.isZero(0) ? Vec(Vec::UnitX()) : Vec(n.unitOrthogonal());
    for (const Vec& axis : {v.normalized().eval(), n, side, Vec(n.cross(side))}) {
      if (axis.isZero(0)) continue;
      rows_.push_back({axis, rangeAlong(axis)});
    }
  }

  std::pair<double, double> rangeAlong(const Vec& n) const {
    const auto [low, high] = piece_.rangeAlong(n);
    return {low + n.dot(v_), high + n.dot(v_)};
  }
  /// True only if it is apart from a ball.
  bool isApart(const Vec& center, double radius) const {
    return std::any_of(rows_.begin(), rows_.end(), [&](const Row& row) {
      const double at = row.axis.dot(center);
      return at - radius > row.range.second || at + radius < row.range.first;
    });
  }
  /// True only if it is apart from a triangle by more than the margin.
  bool isApart(const TriangleVerticesd& t, double margin) const {
    const auto apart = [&](const std::pair<double, double>& range, double p, double q, double r) {
      return std::min({p, q, r}) > range.second + margin ||
             std::max({p, q, r}) < range.first - margin;
    };
    if (std::any_of(rows_.begin(), rows_.end(), [&](const Row& row) {
          return apart(row.range, row.axis.dot(t[0]), row.axis.dot(t[1]), row.axis.dot(t[2]));
        })) {
      return true;
    }
    const Vec n = normalOf(t);
    return !n.isZero(0) && apart(rangeAlong(n), n.dot(t[0]), n.dot(t[1]), n.dot(t[2]));
  }

 private:
  struct Row {
    Vec axis;
    std::pair<double, double> range;
  };
  const ConvexPiece& piece_;
  const Vec v_;
  std::vector<Row> rows_;
};

}  // namespace

DepthInSolid::DepthInSolid(const Mesh& mesh, const RelativePose<double>& X, double rounding)
    : mesh_(mesh),
      walls_(requireSolid(mesh).hasInnerWalls(mesh)),
      X_(X),
      rounding_(rounding),
      tree_{mesh.tree(), X.R(), X * Eigen::Map<const Vec>(mesh.tree().origin),
            std::ldexp(1.0, mesh.tree().exponent)},
      center_(X * mesh.center()) {
  const double reach = double{mesh.tree().reach} * tree_.unit;
  tree_error_ = rounding + error_bounds::laneError(reach) + 2 * detail::boundsOf(X).stretch * reach;
}

TriangleVerticesd DepthInSolid::triangle(int t) const {
  return transformed(mesh_.triangle(static_cast<std::size_t>(t)), X_);
}

bool DepthInSolid::holds(const Vec& p) const {
  SearchCounts unused;
  return placeOf(toB(X_, p), mesh_, unused).inside();
}

ConvexPiece DepthInSolid::boxOf(std::uint32_t node) const {
  if (tree_.tree.boxes.empty()) return {};
  const engine::Box& box = tree_.tree.boxes[node];
  Eigen::Matrix<float, 3, engine::kBoxColumns> columns;
  columns << Eigen::Map<const Eigen::RowVector4f>(box.x),
      Eigen::Map<const Eigen::RowVector4f>(box.y), Eigen::Map<const Eigen::RowVector4f>(box.z);
  const Eigen::Matrix<double, 3, engine::kBoxColumns> posed = tree_.R * columns.cast<double>();
  // Twice the error for axes that are orthonormal but for the rounding of floats.
  const Vec half = tree_.unit * Eigen::Map<const Eigen::Vector3f>(box.half).cast<double>();
  return {tree_.t + tree_.unit * posed.col(engine::kCenter), posed.leftCols<3>(),
          half.array() + 2 * tree_error_};
}

// A point farther from the surface than the error is on the side of what stands for it in the
// mesh's frame.
Depth DepthInSolid::depthOf(const Vec& p) const {
  const NearestOnMesh near = nearestOnMesh(mesh_, toB(X_, p), kInfinity);
  const double lower = near.lower - rounding_;
  Depth depth;
  depth.nearest = X_ * near.point;
  const bool inside = holds(p);
  if (!inside && lower > 0) {
    depth.upper = -lower;
  } else {
    depth.upper = near.distance + nearestError(mesh_, near.distance) + rounding_;
    if (inside) depth.lower = std::max(0.0, lower);
    if (walls_) depth.upper = rounding_ + mesh_.radius() - (p - center_).norm();
  }
  const Vec way = inside ? Vec(depth.nearest - p) : Vec(p - depth.nearest);
  const double length = way.norm();
  depth.out = length > 16 * rounding_ ? Vec(way / length) : normalOf(triangle(near.triangle));
  return depth;
}

bool DepthInSolid::isOutside(const ConvexPiece& piece, const Vec& v, std::optional<Cut>& cut,
                             Vec& blocker, long long& visits) const {
  const MovedPiece moved(piece, v);
  std::size_t blockers = 0;
  std::vector<std::uint32_t> waiting = {0};
  while (!waiting.empty()) {
    const std::uint32_t node = waiting.back();
    waiting.pop_back();
    ++visits;
    if (moved.isApart(tree_.center(node), tree_.radius(node) + tree_error_)) continue;
    if (!tree_.isLeaf(node)) {
      tree_.forChildren(node, [&](std::uint32_t child) { waiting.push_back(child); });
      continue;
    }
    const bool found = tree_.anyTriangle(node, [&](std::uint32_t id) {
      ++visits;
      const TriangleVerticesd t = triangle(static_cast<int>(id));
      if (moved.isApart(t, rounding_)) return false;
      const Vec n = normalOf(t);
      const double offset = n.dot(t[0]) - n.dot(v);
      const auto [low, high] = piece.rangeAlong(n);
      // What is then beyond the triangle is so by more than the margin.
      if (low < offset - 4 * rounding_ && high > offset + 4 * rounding_) {
        cut = {n, offset + 2 * rounding_};
      }
      // The wall that the move leads least out of.
      if (blockers == 0 || n.dot(v) < blocker.dot(v)) blocker = n;
      return cut || ++blockers == tuning::kContacts;
    });
    if (found) return false;
  }
  if (blockers > 0) return false;
  return !holds(piece.center() + v);
}

double DepthInSolid::fromOutside(const Vec& p) const {
  const double step = 8 * rounding_;
  return holds(p + step * depthOf(p).out) ? kInfinity : step + rounding_;
}

}  // namespace kios
