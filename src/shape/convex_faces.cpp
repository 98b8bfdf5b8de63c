// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "shape/convex_faces.h"

#include <algorithm>

namespace kios::shape {
namespace {

constexpr std::size_t kMostProducts = 1 << 14;  ///< of faces and points

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
  if (faces * solid.points.size() > kMostProducts) return;
  for (const Vec& p : solid.points) middle_ += p;
  middle_ /= static_cast<double>(solid.points.size());
  reach_ = solid.reach();
  normals_.resize(static_cast<Eigen::Index>(faces), 3);
  offsets_.resize(static_cast<Eigen::Index>(faces));
  Eigen::Matrix<double, Eigen::Dynamic, 3> points(static_cast<Eigen::Index>(solid.points.size()),
                                                  3);
  for (std::size_t i = 0; i < solid.points.size(); ++i) {
    points.row(static_cast<Eigen::Index>(i)) = solid.points[i];
  }
  Eigen::Index count = 0;
  const int* face = solid.faces;
  for (std::size_t f = 0; f < faces; ++f, face += face[0] + 1) {
    if (face[0] < 3) continue;
    const Vec& a = solid.points[face[1]];
    Vec n = (solid.points[face[2]] - a).cross(solid.points[face[3]] - a);
    const double length = n.norm();
    if (!(length > 0)) continue;
    n /= n.dot(middle_ - a) > 0 ? -length : length;
    normals_.row(count) = n;
    offsets_[count++] = (n.x() * points.col(0).array() + n.y() * points.col(1).array() +
                         n.z() * points.col(2).array())
                            .maxCoeff();
    faces_.push_back(face);
  }
  normals_.conservativeResize(count, 3);
  offsets_.conservativeResize(count);
  if (count > 0) depths_ = -above(middle_);
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
  if (!known()) return false;
  if (inTetrahedra(last_, p)) return true;
  if (!(depths_.minCoeff() > 0)) return false;
  const Vec way = p - middle_;
  std::size_t exit = 0;
  double most = 0;
  for (std::size_t i = 0; i < size(); ++i) {
    const double depth = depths_[static_cast<Eigen::Index>(i)], out = normal(i).dot(way);
    if (!(out > most * depth)) continue;
    most = out / depth;
    exit = i;
  }
  if (!inTetrahedra(exit, p)) return false;
  last_ = exit;
  return true;
}

ConvexFaces::Verdict ConvexFaces::judge(const Triangle& t) const {
  for (const Vec& corner : t) {
    if (inTetrahedra(last_, corner)) return Verdict::kMeets;
  }
  const double clear = 0x1p-40 * (sizeOf(t) + reach_);
  const auto a = above(t[0]), b = above(t[1]), c = above(t[2]);
  if (a.min(b).min(c).maxCoeff() > clear) return Verdict::kApart;
  const bool meets = contains(t[0]) || contains(t[1]) || contains(t[2]);
  return meets ? Verdict::kMeets : Verdict::kOpen;
}

std::size_t ConvexFaces::leastExit(const Triangle& t) const {
  Eigen::Index least = 0;
  above(t[0]).min(above(t[1])).min(above(t[2])).maxCoeff(&least);
  return static_cast<std::size_t>(least);
}

}  // namespace kios::shape
