// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "shape/convex_faces.h"

#include <algorithm>
#include <cmath>

#include "shape/point_rows.h"
#include "volume/lanes.h"

namespace kios::shape {
namespace {

using lanes::Double2;

/// Two vectors.
struct Pair {
  Double2 x, y, z;

  Pair(Double2 x, Double2 y, Double2 z) : x(x), y(y), z(z) {}
  Pair(const Vec& a, const Vec& b) : x{a.x(), b.x()}, y{a.y(), b.y()}, z{a.z(), b.z()} {}
  Pair operator-(const Pair& o) const { return {x - o.x, y - o.y, z - o.z}; }
};
Double2 dot(const Pair& a, const Pair& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Pair cross(const Pair& a, const Pair& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

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

ConvexFaces::ConvexFaces(const Solid& solid) : solid_(solid) {
  const std::size_t faces = static_cast<std::size_t>(std::max(0, solid.num_faces));
  if (solid.kind != Kind::kConvex || solid.points.size() < 4) return;
  for (const Vec& p : solid.points) middle_ += p;
  middle_ /= static_cast<double>(solid.points.size());
  reach_ = solid.reach();
  faces_.reserve(faces + 1);
  const int* face = solid.faces;
  for (std::size_t f = 0; f < faces; ++f, face += face[0] + 1) {
    if (face[0] >= 3) faces_.push_back(face);
  }
  if (faces_.empty()) return;
  while (faces_.size() % 8 != 0) faces_.push_back(faces_.back());  // as PlaneRows asks
  const auto count = static_cast<Eigen::Index>(faces_.size());
  normals_.resize(count, 3);
  offsets_.resize(count);
  Eigen::ArrayXd depths(count);
  for (Eigen::Index i = 0; i < count; i += 2) {
    const int* const* const two = &faces_[static_cast<std::size_t>(i)];
    const auto corner = [&](int k) {
      return Pair(solid.points[static_cast<std::size_t>(two[0][k])],
                  solid.points[static_cast<std::size_t>(two[1][k])]);
    };
    const Pair a = corner(1), n = cross(corner(2) - a, corner(3) - a);
    const Double2 square = dot(n, n);
    if (!(square[0] > kLeastSquare && square[1] > kLeastSquare)) {
      offsets_.resize(0);
      return;
    }
    const Double2 outwards = dot(n, a - Pair(middle_, middle_));
    const Double2 per_length = 1.0 / lanes::sqrt(square);
    const Double2 to_unit = {std::copysign(per_length[0], outwards[0]),
                             std::copysign(per_length[1], outwards[1])};
    lanes::store(&normals_(i, 0), to_unit * n.x);
    lanes::store(&normals_(i, 1), to_unit * n.y);
    lanes::store(&normals_(i, 2), to_unit * n.z);
    lanes::store(&offsets_[i], to_unit * dot(n, a));
    lanes::store(&depths[i], to_unit * outwards);
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
