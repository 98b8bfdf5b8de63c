// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "fcl_kios/triangle.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "triangle/certified_distance.h"
#include "triangle/pair.h"
#include "triangle/predicates.h"
#include "volume/instantiate.h"
#include "volume/rounding.h"

namespace kios {
namespace {

using Vec = Eigen::Vector3d;

bool before(const Vec& a, const Vec& b) {
  if (a[0] != b[0]) return a[0] < b[0];
  if (a[1] != b[1]) return a[1] < b[1];
  return a[2] < b[2];
}

/// A triangle's vertices by increasing coordinates, and where they came from.
struct Sorted {
  explicit Sorted(const TriangleVerticesd& u) {
    // Looked up, because no branch predictor knows the order.
    static constexpr int kOrders[8][3] = {{0, 1, 2}, {1, 0, 2}, {0, 2, 1}, {2, 1, 0},
                                          {0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};
    index = kOrders[before(u[1], u[0]) + 2 * before(u[2], u[1]) + 4 * before(u[2], u[0])];
    for (int i = 0; i < 3; ++i) v[i] = u[index[i]];
  }

  TriangleFeature feature(PairFeature f) const {
    if (f.kind == PairFeature::kFace) return TriangleFeature::kFace;
    const int i = index[f.index];
    if (f.kind == PairFeature::kVertex) return static_cast<TriangleFeature>(i);
    const int j = index[nextVertex(f.index)];
    return static_cast<TriangleFeature>(3 + (j == nextVertex(i) ? i : j));
  }

  TriangleVerticesd v;
  const int* index;
};

bool before(const Sorted& a, const Sorted& b) {
  for (int i = 0; i < 2; ++i) {
    if (a.v[i] != b.v[i]) return before(a.v[i], b.v[i]);
  }
  return before(a.v[2], b.v[2]);
}

/// The pair relative to p's first vertex: each coordinate is off by at most eps / 2 of itself.
TrianglePair relativeTo(const Vec& origin, const Sorted& p, const Sorted& q) {
  TrianglePair pair;
  pair.magnitude = 0;
  for (int i = 0; i < 3; ++i) {
    pair.p[i] = p.v[i] - origin;
    pair.q[i] = q.v[i] - origin;
    pair.magnitude = std::max(
        {pair.magnitude, pair.p[i].cwiseAbs().maxCoeff(), pair.q[i].cwiseAbs().maxCoeff()});
  }
  return pair;
}

/// Times 2^e, in two steps because 2^e itself may overflow.
void scale(Vec& v, int e) {
  const double half = std::ldexp(1.0, e / 2);
  v = v * half * std::ldexp(1.0, e - e / 2);
}

/// Brings the magnitude to about 1 by a power of two and returns its exponent, 0 if the magnitude
/// is moderate: terms that underflow then are no part of the answer.
int normalize(TrianglePair& pair) {
  if (pair.magnitude > 0x1p-30 && pair.magnitude < 0x1p30) return 0;
  const int e = std::ilogb(pair.magnitude);
  for (int i = 0; i < 3; ++i) {
    scale(pair.p[i], -e);
    scale(pair.q[i], -e);
  }
  pair.magnitude = std::ldexp(pair.magnitude, -e);
  return e;
}

TriangleDistanced touchingAt(const Vec& p) {
  return {0, p, p, TriangleFeature::kFace, TriangleFeature::kFace};
}

TriangleDistanced distanceOf(const TriangleVerticesd& a, const TriangleVerticesd& b) {
  const Sorted sa(a), sb(b);
  const bool swapped = before(sb, sa);
  const Sorted &p = swapped ? sb : sa, &q = swapped ? sa : sb;
  for (int i = 0; i < 3; ++i) {  // neighbours in a mesh share a vertex as stored
    for (int j = 0; j < 3; ++j) {
      if (sa.v[i] != sb.v[j]) continue;
      return {0, sa.v[i], sa.v[i], static_cast<TriangleFeature>(sa.index[i]),
              static_cast<TriangleFeature>(sb.index[j])};
    }
  }
  const Vec origin = p.v[0];
  TrianglePair pair = relativeTo(origin, p, q);
  const int exponent = normalize(pair);

  bool disjoint = false;
  PairDistance found;
  CertifiedDistance fast(pair);
  bool certified = fast.nearestEdges(0, 1, found);
  if (!certified && (fast.crossing() || fast.touching())) {
    if (trianglesIntersect(p.v, q.v)) return touchingAt(intersectionPoint(p.v, q.v));
    disjoint = true;
  }
  if (!certified && !fast.touching()) {
    certified = fast.nearestEdges(1, 3, found) || (!fast.touching() && fast.nearestFace(found));
  }
  if (!certified) {
    if (!disjoint && trianglesIntersect(p.v, q.v)) {
      return touchingAt(intersectionPoint(p.v, q.v));
    }
    found = robustDistance(pair);
  }
  if (exponent != 0) {
    found.distance = std::ldexp(found.distance, exponent);
    scale(found.on_p, exponent);
    scale(found.on_q, exponent);
  }
  const Vec on_p = origin + found.on_p, on_q = origin + found.on_q;
  // Not 0 even where all digits have cancelled.
  return {std::max(found.distance, std::numeric_limits<double>::denorm_min()),
          swapped ? on_q : on_p, swapped ? on_p : on_q,
          sa.feature(swapped ? found.feature_q : found.feature_p),
          sb.feature(swapped ? found.feature_p : found.feature_q)};
}

}  // namespace

template <typename S>
TriangleDistance<S> triangleDistance(const TriangleVertices<S>& a, const TriangleVertices<S>& b) {
  const TriangleDistanced found = distanceOf(widened(a), widened(b));
  return {roundedLength<S>(found.distance), roundedTo<S>(found.point_a),
          roundedTo<S>(found.point_b), found.feature_a, found.feature_b};
}

KIOS_INSTANTIATE_FUNCTION(triangleDistance);

}  // namespace kios
