// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "shape/convex_faces.h"

#include <algorithm>
#include <cmath>

#include "shape/point_rows.h"

namespace kios::shape {
namespace {

constexpr double kLeastSquare = 0x1p-900;  ///< of faces that have a direction

/// True if p lies in the tetrahedron, and not at its rim.
bool deepIn(const Vec& apex, const Vec& a, const Vec& b, const Vec& c, const Vec& p) {
  const Vec u = a - apex, v = b - apex, w = c - apex, x = p - apex;
  const Vec vw = v.cross(w), xu = x.cross(u);
  const double volume = u.dot(vw), least = 0x1p-30 * volume;
  const double i = x.dot(vw), j = -xu.dot(w), k = xu.dot(v);
  if (volume > 0) return i > least && j > least && k > least && volume - i - j - k > least;
  return i < least && j < least && k < least && volume - i - j - k < least;
}

}  // namespace

// A face's normal is that of the largest triangle of its fan.
ConvexFaces::ConvexFaces(const Solid& solid) : solid_(solid) {
  if (solid.kind != Kind::kConvex || solid.points.size() < 4) return;
  for (const Vec& p : solid.points) middle_ += p;
  middle_ /= static_cast<double>(solid.points.size());
  reach_ = solid.reach();
  faces_.reserve(static_cast<std::size_t>(std::max(0, solid.num_faces)) + 8);
  std::vector<Vec> normals;
  normals.reserve(faces_.capacity());
  const int* face = solid.faces;
  for (int f = 0; f < solid.num_faces; ++f, face += face[0] + 1) {
    const auto to = [&](int k) -> Vec { return solid.points[face[k]] - solid.points[face[1]]; };
    Vec n = Vec::Zero();
    double most = kLeastSquare;
    for (int k = 3; k <= face[0]; ++k) {
      const Vec m = to(k - 1).cross(to(k));
      const double square = m.squaredNorm();
      if (square > most) n = m;
      most = std::max(most, square);
    }
    if (!(most > kLeastSquare)) continue;
    faces_.push_back(face);
    normals.emplace_back(n / std::sqrt(most));
  }
  if (faces_.empty()) return;
  while (faces_.size() % 8 != 0) {  // as PlaneRows asks
    faces_.push_back(faces_.back());
    normals.push_back(normals.back());
  }
  const auto count = static_cast<Eigen::Index>(faces_.size());
  normals_.resize(count, 3);
  offsets_.resize(count);
  Eigen::ArrayXd depths(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const Vec& a = solid.points[faces_[i][1]];
    Vec& n = normals[i];
    if (n.dot(a - middle_) < 0) n = -n;
    normals_.row(i) = n;
    offsets_[i] = n.dot(a);
    depths[i] = n.dot(a - middle_);
  }
  if (depths.minCoeff() > 0x1p-40 * reach_) per_depth_ = depths.inverse();
}

std::vector<ConvexFaces::Slab> ConvexFaces::slabs() const {
  std::vector<Slab> slabs;
  if (!known()) return slabs;
  for (const Vec& p : solid_.points) offsets_ = offsets_.max(along(p));
  slabs.reserve(faces_.size());
  for (Eigen::Index i = 0; i < offsets_.size(); ++i) slabs.push_back({normal(i), offsets_[i]});
  return slabs;
}

Eigen::Index ConvexFaces::highestOver(const Triangle& t, double& height) const {
  const PlaneRows planes = {normals_.data(), offsets_.data(), faces_.size()};
  return static_cast<Eigen::Index>(planes.highestOver(t, height));
}

bool ConvexFaces::inTetrahedra(std::size_t face, const Vec& p) const {
  const int* const corners = faces_[face];
  const auto point = [&](int k) { return solid_.points[static_cast<std::size_t>(corners[k])]; };
  for (int k = 3; k <= corners[0]; ++k) {
    if (deepIn(middle_, point(1), point(k - 1), point(k), p)) return true;
  }
  return false;
}

// Finds the face by which a ray from the middle through p leaves: its tetrahedra hold p. Those of a
// flat shape hold nothing.
bool ConvexFaces::contains(const Vec& p) const {
  if (per_depth_.size() == 0) return false;
  if (inTetrahedra(last_, p)) return true;
  heights_ = along(p - middle_) * per_depth_;
  const double most = heights_.maxCoeff();
  std::size_t exit = 0;
  while (exit + 1 < faces_.size() && heights_[static_cast<Eigen::Index>(exit)] < most) ++exit;
  if (!inTetrahedra(exit, p)) return false;
  last_ = exit;
  return true;
}

ConvexFaces::Slab ConvexFaces::leastExit(const Triangle& t) const {
  const double rounding = 0x1p-50 * reach_;
  for (;;) {
    double height;
    const Eigen::Index i = highestOver(t, height);
    const Slab slab = {normal(i), extentAlong(solid_, normal(i))};
    if (slab.offset <= offsets_[i] + rounding) return slab;
    offsets_[i] = slab.offset;
  }
}

ConvexFaces::Verdict ConvexFaces::judge(const Triangle& t) const {
  const bool flat = per_depth_.size() == 0;  // the tetrahedra are noise
  for (const Vec& corner : t) {
    if (!flat && inTetrahedra(last_, corner)) return Verdict::kMeets;
  }
  const double clear = 0x1p-40 * (sizeOf(t) + reach_);
  double highest;
  highestOver(t, highest);
  if (highest > clear) {
    const Slab slab = leastExit(t);
    const Vec& n = slab.normal;
    const double low = std::min({n.dot(t[0]), n.dot(t[1]), n.dot(t[2])});
    if (low - slab.offset > clear) return Verdict::kApart;
  }
  const bool meets = contains(t[0]) || contains(t[1]) || contains(t[2]);
  return meets ? Verdict::kMeets : Verdict::kOpen;
}

}  // namespace kios::shape
