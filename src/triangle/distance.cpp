// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "fcl_kios/triangle/distance.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "triangle/certified_distance.h"
#include "triangle/common_point.h"
#include "triangle/pair.h"

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
  template <typename S>
  explicit Sorted(const TriangleVertices<S>& t)
      : v{t[0].template cast<double>(), t[1].template cast<double>(),
          t[2].template cast<double>()} {
    compareAndSwap(0, 1);
    compareAndSwap(1, 2);
    compareAndSwap(0, 1);
  }
  void compareAndSwap(int i, int j) {
    if (!before(v[j], v[i])) return;
    std::swap(v[i], v[j]);
    std::swap(index[i], index[j]);
  }

  TriangleFeature feature(PairFeature f) const {
    if (f.kind == PairFeature::kFace) return TriangleFeature::kFace;
    const int i = index[f.index];
    if (f.kind == PairFeature::kVertex) return static_cast<TriangleFeature>(i);
    const int j = index[nextVertex(f.index)];
    return static_cast<TriangleFeature>(3 + (j == nextVertex(i) ? i : j));
  }

  Vec v[3];
  int index[3] = {0, 1, 2};
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

void scale(TrianglePair& pair, int e) {
  for (int i = 0; i < 3; ++i) {
    for (int c = 0; c < 3; ++c) {
      pair.p[i][c] = std::ldexp(pair.p[i][c], e);
      pair.q[i][c] = std::ldexp(pair.q[i][c], e);
    }
  }
}

PairDistance disjointDistance(TrianglePair pair) {
  const int e = std::ilogb(pair.magnitude);
  scale(pair, -e);
  PairDistance found = robustDistance(pair);
  // Disjoint, so not 0 even where all digits have cancelled.
  found.distance =
      std::max(std::ldexp(found.distance, e), std::numeric_limits<double>::denorm_min());
  for (int c = 0; c < 3; ++c) {
    found.on_p[c] = std::ldexp(found.on_p[c], e);
    found.on_q[c] = std::ldexp(found.on_q[c], e);
  }
  return found;
}

template <typename S>
S positive(double distance) {
  return std::max(static_cast<S>(distance), std::numeric_limits<S>::denorm_min());
}

template <typename S>
TriangleDistance<S> touchingAt(const Point<S>& p) {
  return {S(0), p, p, TriangleFeature::kFace, TriangleFeature::kFace};
}

}  // namespace

template <typename S>
TriangleDistance<S> triangleDistance(const TriangleVertices<S>& a, const TriangleVertices<S>& b) {
  const Sorted sa(a), sb(b);
  const bool swapped = before(sb, sa);
  const Sorted &p = swapped ? sb : sa, &q = swapped ? sa : sb;
  for (int i = 0, j = 0; i < 3 && j < 3;) {  // neighbours in a mesh share a vertex as stored
    if (sa.v[i] == sb.v[j]) {
      const Point<S>& common = a[sa.index[i]];
      return {S(0), common, common, static_cast<TriangleFeature>(sa.index[i]),
              static_cast<TriangleFeature>(sb.index[j])};
    }
    before(sa.v[i], sb.v[j]) ? ++i : ++j;
  }
  const Vec origin = p.v[0];
  const TrianglePair pair = relativeTo(origin, p, q);

  Point<S> common;
  PairDistance found;
  bool certified = false, disjoint = false;
  if (pair.magnitude > 1e-70 && pair.magnitude < 1e70) {
    CertifiedDistance fast(pair);
    certified = fast.nearestEdges(0, 1, found);
    if (!certified) {
      if (fast.crossing()) {
        if (commonPoint(a, b, common)) return touchingAt(common);
        disjoint = true;
      }
      certified = fast.nearestEdges(1, 3, found) || fast.nearestFace(found);
    }
  }
  if (!certified) {
    if (!disjoint && commonPoint(a, b, common)) return touchingAt(common);
    found = disjointDistance(pair);
  }
  const Vec on_p = origin + found.on_p, on_q = origin + found.on_q;
  TriangleDistance<S> result;
  result.distance = positive<S>(found.distance);
  result.point_a = (swapped ? on_q : on_p).template cast<S>();
  result.point_b = (swapped ? on_p : on_q).template cast<S>();
  result.feature_a = sa.feature(swapped ? found.feature_q : found.feature_p);
  result.feature_b = sb.feature(swapped ? found.feature_p : found.feature_q);
  return result;
}

template TriangleDistance<double> triangleDistance(const TriangleVertices<double>&,
                                                   const TriangleVertices<double>&);
template TriangleDistance<float> triangleDistance(const TriangleVertices<float>&,
                                                  const TriangleVertices<float>&);

}  // namespace kios
