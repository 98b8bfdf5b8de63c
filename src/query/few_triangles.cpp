// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "query/few_triangles.h"

#include <algorithm>
#include <cmath>

#include "fcl_kios/triangle/intersection.h"
#include "query/nearest_candidates.h"
#include "query/unprepared.h"
#include "volume/error_bounds.h"
#include "volume/instantiate.h"
#include "volume/lanes.h"
#include "volume/rounding.h"

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace kios {
namespace {

/// By axis: where a box begins, and where it ends, negated; or the other way round.
struct Sides {
  lanes::Double2 x, y, z;
};

/// A box in the common frame, as both sides of a test; empty at first.
struct Box {
  double low[3] = {kInfinity, kInfinity, kInfinity}, high[3] = {-kInfinity, -kInfinity, -kInfinity};

  template <typename S>
  static Box of(const TriangleVertices<S>& t) {
    Box box;
    for (int c = 0; c < 3; ++c) {
      const double x = t[0][c], y = t[1][c], z = t[2][c];
      box.low[c] = std::min(std::min(x, y), z);
      box.high[c] = std::max(std::max(x, y), z);
    }
    return box;
  }
  void add(const Box& o) {
    for (int c = 0; c < 3; ++c) {
      low[c] = std::min(low[c], o.low[c]);
      high[c] = std::max(high[c], o.high[c]);
    }
  }
  Sides lower() const { return sides(low, high); }
  Sides upper() const { return sides(high, low); }

 private:
  static Sides sides(const double* p, const double* q) {
    using lanes::Double2;
    return {Double2{p[0], -q[0]}, Double2{p[1], -q[1]}, Double2{p[2], -q[2]}};
  }
};

/// The distance of two boxes, right to 4 u; lower() of one, upper() of the other.
double distance(const Sides& lower, const Sides& upper) {
  const auto along = [](lanes::Double2 gap) { return std::max(std::max(gap[0], gap[1]), 0.0); };
  const double x = along(lower.x - upper.x), y = along(lower.y - upper.y),
               z = along(lower.z - upper.z);
  return std::sqrt(x * x + y * y + z * z);
}

/// Whether two boxes have no point in common; lower() of one, upper() of the other.
bool apart(const Sides& lower, const Sides& upper) {
  const auto gap = (lower.x > upper.x) | (lower.y > upper.y) | (lower.z > upper.z);
#if defined(__SSE2__)
  return _mm_movemask_pd(reinterpret_cast<__m128d>(gap)) != 0;
#else
  return (gap[0] | gap[1]) != 0;
#endif
}

constexpr int kMostVertices = 64;  ///< of a model
constexpr int kPlanes = 6;         ///< more find hardly any pair apart

template <typename S>
double norm1Of(const fcl::Vector3<S>& v) {
  return std::abs(double{v[0]}) + std::abs(double{v[1]}) + std::abs(double{v[2]});
}

/// The vertex that lies farthest along a direction.
struct Farthest {
  double height;
  int vertex;
};

template <typename S>
Farthest farthest(const fcl::Vector3<S>* vertices, int n, const Eigen::Vector3d& along) {
  double heights[kMostVertices];
  for (int i = 0; i < n; ++i) {
    const fcl::Vector3<S>& v = vertices[i];
    heights[i] = along[0] * double{v[0]} + along[1] * double{v[1]} + along[2] * double{v[2]};
  }
  double most = -kInfinity;
  for (int i = 0; i < n; ++i) most = heights[i] > most ? heights[i] : most;
  int at = 0;
  while (at + 1 < n && !(heights[at] == most)) ++at;
  return {most, at};
}

}  // namespace

// Coordinates are those that the triangles' own test sees, so boxes need no pad.
template <typename S>
std::vector<engine::TrianglePairIds> intersectingOfFew(const MeshPair<S>& frame, std::size_t limit,
                                                       SearchCounts& counts) {
  std::vector<engine::TrianglePairIds> found;
  Box boxes_a[kFewTriangles], all_a;
  const int num_a = frame.a.num_tris, num_b = frame.b.num_tris;
  for (int i = 0; i < num_a; ++i) all_a.add(boxes_a[i] = Box::of(frame.triangleA(i)));

  struct Placed {
    TriangleVertices<S> triangle;
    Sides upper;
    int id;
  } near_b[kFewTriangles];
  const Sides lower = all_a.lower();
  Box all_b;
  int num_near = 0;
  for (int j = 0; j < num_b; ++j) {
    Placed& placed = near_b[num_near];
    placed.triangle = frame.triangleB(j);
    const Box box = Box::of(placed.triangle);
    placed.upper = box.upper();
    placed.id = j;
    if (apart(lower, placed.upper)) continue;
    ++num_near;
    all_b.add(box);
  }
  if (num_near == 0) return found;
  const Sides upper = all_b.upper();
  for (int i = 0; i < num_a; ++i) {
    const Sides lower_i = boxes_a[i].lower();
    if (apart(lower_i, upper)) continue;
    const TriangleVertices<S> p = frame.triangleA(i);
    for (int j = 0; j < num_near; ++j) {
      if (apart(lower_i, near_b[j].upper)) continue;
      ++counts.exact;
      if (!trianglesIntersect(p, near_b[j].triangle)) continue;
      found.push_back({i, near_b[j].id});
      if (found.size() >= limit) return found;
    }
  }
  return found;
}

// All boxes are tested, then triangles by the distance of their boxes. What is left out is farther
// than NearestCandidates' allowance for rounding, which is far more than that of boxes.
template <typename S>
engine::PairAnswer<S> nearestOfFew(const MeshPair<S>& frame, const engine::PairQuery& query,
                                   SearchCounts& counts) {
  struct Bounded {
    double bound;
    engine::TrianglePairIds ids;
    bool operator<(const Bounded& o) const {
      return bound != o.bound ? bound < o.bound : ids < o.ids;
    }
  } bounded[kVeryFewPairs];
  Sides upper_b[kFewTriangles];
  const int num_a = frame.a.num_tris, num_b = frame.b.num_tris;
  for (int j = 0; j < num_b; ++j) upper_b[j] = Box::of(frame.triangleB(j)).upper();
  int n = 0, least = 0;
  for (int i = 0; i < num_a; ++i) {
    const Sides lower = Box::of(frame.triangleA(i)).lower();
    for (int j = 0; j < num_b; ++j, ++n) {
      bounded[n] = {distance(lower, upper_b[j]), {i, j}};
      if (bounded[n].bound < bounded[least].bound) least = n;
    }
  }
  NearestCandidates<S> pairs(frame, query.far_enough);
  pairs.test(bounded[least].ids);
  bounded[least] = bounded[--n];
  const double most = pairs.cullDistance();
  const auto end = std::partition(bounded, bounded + n,
                                  [most](const Bounded& pair) { return pair.bound <= most; });
  std::sort(bounded, end);
  counts.leaf_pairs += num_a * num_b;
  ++counts.exact;
  for (const Bounded* pair = bounded; pair != end && !pairs.touching(); ++pair) {
    if (pair->bound > pairs.cullDistance()) break;
    pairs.test(pair->ids);
    ++counts.exact;
  }
  engine::PairAnswer<S> answer = pairs.answer();
  if (pairs.touching() && !query.any_touching) {
    answer.ids = firstTouching(frame, counts);
    answer.nearest = frame.distanceOf(answer.ids);
  }
  return answer;
}

// The direction is turned as Chung and Wang do ("Quick collision detection of polytopes in virtual
// environments", 1996): mirrored at the plane that is square to the line between the two vertices
// that stand in the way.
//
// Heights along n, |n| <= 1 + 4 u: a placed vertex is off by frameError() from R x + T, R and T as
// stored; n and R^T n by 4 u a coordinate; products and sums by 4 u of the 1-norms: below 32 u of
// all lengths that enter, twice for n's own length in `margin`. Vertices of no triangle, which the
// root volumes need not hold, are computed worse, but those of triangles make the heights as large
// as they must be whatever others add. NaN proves nothing.
template <typename S>
bool verticesApart(const MeshPair<S>& frame, double margin) {
  using Vec = Eigen::Vector3d;
  const Model<S>&a = frame.a, &b = frame.b;
  if (std::max(a.num_vertices, b.num_vertices) > kMostVertices) return false;
  const kIOS<S>&root_a = frame.rootA(), &root_b = frame.rootB();
  const double norm1_a = norm1Of<S>(root_a.center0) + 1.8 * double{root_a.radius0};
  const double norm1_b = norm1Of<S>(root_b.center0) + 1.8 * double{root_b.radius0};
  const double T_norm1 = detail::boundsOf(frame.X_AB).T_norm1;
  const double least = margin + error_bounds::frameError<S>(norm1_b, T_norm1) +
                       64 * kUlpDouble * (norm1_a + norm1_b + T_norm1 + margin) + 0x1p-1000;
  const Eigen::Matrix3d R = frame.X_AB.R().template cast<double>();
  const Vec T = frame.X_AB.T().template cast<double>();
  const auto place = [&](const fcl::Vector3<S>& x) {
    return Vec(detail::rotate<double>(R, x.template cast<double>()) + T);
  };
  Vec n = place(root_b.center0) - root_a.center0.template cast<double>();
  const auto isDivisor = [](double length) { return length > 0x1p-500 && length < 0x1p500; };
  const double distance = std::sqrt(detail::dot<double>(n, n));
  if (!isDivisor(distance)) return false;
  n /= distance;
  for (int i = 0; i < kPlanes; ++i) {
    const Vec n_B(R(0, 0) * n[0] + R(1, 0) * n[1] + R(2, 0) * n[2],
                  R(0, 1) * n[0] + R(1, 1) * n[1] + R(2, 1) * n[2],
                  R(0, 2) * n[0] + R(1, 2) * n[1] + R(2, 2) * n[2]);
    const Farthest of_a = farthest<S>(a.vertices, a.num_vertices, n);
    const Farthest of_b = farthest<S>(b.vertices, b.num_vertices, -n_B);
    const double gap = (detail::dot<double>(n, T) - of_b.height) - of_a.height;
    if (gap > least) return true;
    const Vec between =
        place(b.vertices[of_b.vertex]) - a.vertices[of_a.vertex].template cast<double>();
    const double length = std::sqrt(detail::dot<double>(between, between));
    if (!isDivisor(length)) return false;
    const Vec r = between / length;
    n -= 2 * detail::dot<double>(r, n) * r;
    n /= std::sqrt(detail::dot<double>(n, n));
  }
  return false;
}

KIOS_INSTANTIATE_FUNCTION(nearestOfFew);
KIOS_INSTANTIATE_FUNCTION(intersectingOfFew);
KIOS_INSTANTIATE_FUNCTION(verticesApart);

}  // namespace kios
