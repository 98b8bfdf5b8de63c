// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "shape/growing_hull.h"

#include <algorithm>
#include <vector>

#include "fcl_kios/triangle/distance.h"
#include "shape/hull.h"
#include "shape/nearest_point.h"
#include "volume/rounding.h"
#include "volume/unit_vector.h"

namespace kios::shape {
namespace {

bool isEdge(TriangleFeature feature) {
  return feature != TriangleFeature::kFace && feature >= TriangleFeature::kEdge0;
}

Vec edgeOf(const Triangle& t, TriangleFeature feature) {
  const int i = static_cast<int>(feature) - static_cast<int>(TriangleFeature::kEdge0);
  return unitVector(t[(i + 1) % 3] - t[i]);
}

/// From the solid to the triangle, unit, across the features where they are nearest: these keep
/// their digits where the points' difference has lost them.
Vec directionAcross(const Triangle& t, const Triangle& face, const TriangleDistance<double>& d) {
  const Vec between = d.point_a - d.point_b;
  Vec n = Vec::Zero();
  if (d.feature_a == TriangleFeature::kFace) {
    n = unitVector(faceNormal(t));
  } else if (d.feature_b == TriangleFeature::kFace) {
    n = unitVector(faceNormal(face));
  } else if (isEdge(d.feature_a) && isEdge(d.feature_b)) {
    n = edgeOf(t, d.feature_a).cross(edgeOf(face, d.feature_b));
  }
  if (!(n.squaredNorm() > 0x1p-80)) n = between;
  return unitVector(n.dot(between) < 0 ? Vec(-n) : n);
}

/// The point that may lie farthest beyond x along n, whose direction may be off by `error`; null if
/// none does or those that do have been chosen.
const Vec* farthestBeyond(const Solid& s, const Vec& x, const Vec& n, double error,
                          const std::vector<Vec>& chosen) {
  const Vec* farthest = nullptr;
  double most = 0;
  for (const Vec& p : s.points) {
    const double beyond = n.dot(p - x) + error * (p - x).norm();
    if (!(beyond > most) || std::find(chosen.begin(), chosen.end(), p) != chosen.end()) continue;
    most = beyond;
    farthest = &p;
  }
  return farthest;
}

}  // namespace

TriangleShapeDistance distanceToPoints(const Solid& s, const Triangle& t) {
  TriangleShapeDistance best;
  best.distance = best.lower = kInfinity;
  std::vector<Vec> chosen = {coreSupport(s, t[0] - s.points[0])};
  Vec n = Vec::Zero();
  const double size = sizeOf(t) + s.reach();
  constexpr int kMost = 32;
  while (true) {
    const Vec next = chosen.back();
    const std::size_t last = chosen.size() - 1;
    for (std::size_t i = 0; i <= last; ++i) {
      for (std::size_t j = i; j <= last; ++j) {
        const Triangle face = {chosen[i], chosen[j], next};
        for (std::size_t k = 0; k < i && i < j && j < last; ++k) {
          if (inTetrahedron(chosen[k], face, t[0])) {
            best = {0, 0, t[0], t[0]};
            return best;
          }
        }
        const TriangleDistance<double> d = triangleDistance(t, face);
        if (!(d.distance < best.distance)) continue;
        best.distance = best.lower = d.distance;
        best.on_triangle = d.point_a;
        best.on_shape = d.point_b;
        n = directionAcross(t, face, d);
      }
    }
    if (best.distance <= 0x1p-48 * size || chosen.size() == kMost) break;
    const double error = 0x1p-50 * size / best.distance;
    const Vec* farthest = farthestBeyond(s, best.on_shape, n, error, chosen);
    if (!farthest) break;
    chosen.push_back(*farthest);
  }
  return best;
}

}  // namespace kios::shape
