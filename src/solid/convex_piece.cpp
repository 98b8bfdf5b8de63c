// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "solid/convex_piece.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <Eigen/Geometry>
#include "solid/tuning.h"
#include "volume/rounding.h"
#include "volume/unit_vector.h"

namespace kios {
namespace {

using Polygon = ConvexPiece::Polygon;

/// Sorts points of a plane, which are corners of a convex polygon, around their middle.
void sortAround(const Pointd& n, Polygon& corners) {
  const Pointd u = n.unitOrthogonal(), v = n.cross(u);
  Pointd middle = Pointd::Zero();
  for (const Pointd& p : corners) middle += p / static_cast<double>(corners.size());
  const auto angle = [&](const Pointd& p) {
    return std::atan2((p - middle).dot(v), (p - middle).dot(u));
  };
  std::sort(corners.begin(), corners.end(),
            [&](const Pointd& p, const Pointd& q) { return angle(p) < angle(q); });
}

}  // namespace

ConvexPiece::ConvexPiece(std::vector<Polygon> faces) : faces_(std::move(faces)) {
  double count = 0;
  forCorners([&](const Pointd& p) { center_ += (p - center_) / ++count; });
  forCorners([&](const Pointd& p) { radius_ = std::max(radius_, (p - center_).norm()); });
}

ConvexPiece::ConvexPiece(const Pointd& center, const Eigen::Matrix3d& axes, const Pointd& half) {
  std::vector<Polygon> faces;
  for (int axis = 0; axis < 3; ++axis) {
    const Pointd u = half[(axis + 1) % 3] * axes.col((axis + 1) % 3),
                 v = half[(axis + 2) % 3] * axes.col((axis + 2) % 3);
    for (const double side : {-half[axis], half[axis]}) {
      const Pointd middle = center + side * axes.col(axis);
      faces.push_back({middle - u - v, middle + u - v, middle + u + v, middle - u + v});
    }
  }
  *this = ConvexPiece(std::move(faces));
}

Pointd ConvexPiece::normal() const {
  Pointd n = Pointd::Zero();
  const Polygon& face = faces_.front();
  for (std::size_t i = 2; i < face.size(); ++i) {
    n += (face[i - 1] - face[0]).cross(face[i] - face[0]);
  }
  return unitVector(n);
}

std::pair<double, double> ConvexPiece::rangeAlong(const Pointd& n) const {
  std::pair<double, double> range(kInfinity, -kInfinity);
  forCorners([&](const Pointd& p) {
    const double at = n.dot(p);
    range = {std::min(range.first, at), std::max(range.second, at)};
  });
  return range;
}

// A side of two faces is cut at one point: it is computed from below to above.
std::pair<ConvexPiece, ConvexPiece> ConvexPiece::cut(const Pointd& n, double offset) const {
  std::vector<Polygon> below, above;
  Polygon between;
  bool any_below = false, any_above = false;
  for (const Polygon& face : faces_) {
    Polygon lower, upper;
    for (std::size_t i = 0; i < face.size(); ++i) {
      const Pointd &p = face[i], &q = face[i + 1 < face.size() ? i + 1 : 0];
      const double at_p = n.dot(p) - offset, at_q = n.dot(q) - offset;
      any_below |= at_p < 0;
      any_above |= at_p > 0;
      if (at_p <= 0) lower.push_back(p);
      if (at_p >= 0) upper.push_back(p);
      if (at_p == 0) between.push_back(p);
      if (!((at_p < 0 && at_q > 0) || (at_p > 0 && at_q < 0))) continue;
      const Pointd middle = at_p < 0 ? Pointd(p + at_p / (at_p - at_q) * (q - p))
                                     : Pointd(q + at_q / (at_q - at_p) * (p - q));
      lower.push_back(middle);
      upper.push_back(middle);
      between.push_back(middle);
    }
    if (!lower.empty()) below.push_back(std::move(lower));
    if (!upper.empty()) above.push_back(std::move(upper));
  }
  if (!any_below) return {ConvexPiece(), *this};
  if (!any_above) return {*this, ConvexPiece()};
  if (!isFlat() && between.size() > 2) {
    sortAround(n, between);
    between.erase(std::unique(between.begin(), between.end()), between.end());
    below.push_back(between);
    above.push_back(std::move(between));
  }
  return {ConvexPiece(std::move(below)), ConvexPiece(std::move(above))};
}

std::pair<ConvexPiece, ConvexPiece> ConvexPiece::halves() const {
  Pointd low = center_, high = center_;
  forCorners([&](const Pointd& p) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  });
  int axis = 0;
  (high - low).maxCoeff(&axis);
  return cut(Pointd::Unit(axis), low[axis] + tuning::kHalf * (high[axis] - low[axis]));
}

}  // namespace kios
