// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "query/few_triangles.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <type_traits>

#include "query/placed_triangles.h"
#include "volume/error_bounds.h"
#include "volume/instantiate.h"
#include "volume/rounding.h"

namespace kios {
namespace {

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

/// In integers, as NaN would raise flags: vertices of no triangle may be anything.
template <typename S>
bool areFinite(const fcl::Vector3<S>* vertices, int n) {
  using Bits = std::conditional_t<sizeof(S) == 8, std::uint64_t, std::uint32_t>;
  constexpr Bits kExponent = sizeof(S) == 8 ? Bits(0x7FF0000000000000) : Bits(0x7F800000);
  bool finite = true;
  for (int i = 0; i < n; ++i) {
    Bits coordinates[3];
    std::memcpy(coordinates, vertices[i].data(), sizeof(coordinates));
    for (const Bits bits : coordinates) finite &= (bits & kExponent) != kExponent;
  }
  return finite;
}

/// Calls visit() with the pairs that intersect, by ids, until it returns true.
// Coordinates are those that the triangles' own test sees, so boxes need no pad, and the signs of
// planes are proven.
template <typename S, typename Visit>
void visitIntersecting(const PlacedPair<S>& pair, SearchCounts& counts, const Visit& visit) {
  const auto& [a, b] = pair;
  const Sides lower = a.box().lower(), upper = b.box().upper();
  if (apart(lower, upper)) return;
  // By triangle of A, those of B that may meet it.
  Bits near[kFewTriangles];
  std::fill_n(near, a.size(), 0);
  if (b.size() <= kFewPlanes) {
    for (int j = 0; j < b.size(); ++j) {
      Bits crossing = a.crossing(b.plane(j));
      for (; crossing != 0; crossing &= crossing - 1)
        near[__builtin_ctzll(crossing)] |= Bits{1} << j;
    }
  } else if (a.size() <= kFewPlanes) {
    for (int i = 0; i < a.size(); ++i) near[i] = b.crossing(a.plane(i));
  } else {
    Bits of_b = 0;
    for (int j = 0; j < b.size(); ++j) {
      if (!apart(lower, b.box(j).upper())) of_b |= Bits{1} << j;
    }
    std::fill_n(near, a.size(), of_b);
  }
  struct Placed {
    TriangleVertices<S> triangle;
    Sides upper;
    PlainPlane plane;
  } placed[kFewTriangles];
  Bits is_placed = 0;
  for (int i = 0; i < a.size(); ++i) {
    if (near[i] == 0) continue;
    const Sides lower_i = a.box(i).lower();
    if (apart(lower_i, upper)) continue;
    const TriangleVertices<S> p = a.triangle(i);
    const PlainPlane plane = a.plane(i);
    for (Bits left = near[i]; left != 0; left &= left - 1) {
      const int j = __builtin_ctzll(left);
      Placed& q = placed[j];
      if ((is_placed >> j & 1) == 0) {
        is_placed |= Bits{1} << j;
        q = {b.triangle(j), b.box(j).upper(), b.plane(j)};
      }
      if (apart(lower_i, q.upper)) continue;
      ++counts.exact;
      const Plainly plain = plainlyMeet(q.triangle, q.plane, p, plane);
      if (plain == Plainly::kApart) continue;
      if (plain == Plainly::kUnclear && !exactlyIntersect(p, q.triangle)) continue;
      if (visit(engine::TrianglePairIds{i, j})) return;
    }
  }
}

}  // namespace

template <typename S>
std::vector<engine::TrianglePairIds> intersectingOfFew(const MeshPair<S>& frame, std::size_t limit,
                                                       SearchCounts& counts) {
  std::vector<engine::TrianglePairIds> found;
  visitIntersecting(PlacedPair<S>(frame), counts, [&](const engine::TrianglePairIds& ids) {
    found.push_back(ids);
    return found.size() >= limit;
  });
  return found;
}

template <typename S>
engine::TrianglePairIds firstIntersecting(const PlacedPair<S>& pair, SearchCounts& counts) {
  engine::TrianglePairIds found;
  visitIntersecting(pair, counts, [&](const engine::TrianglePairIds& ids) {
    found = ids;
    return true;
  });
  return found;
}

// The direction is turned as Chung and Wang do ("Quick collision detection of polytopes in virtual
// environments", 1996): mirrored at the plane that is square to the line between the two vertices
// that stand in the way.
//
// Heights along n, |n| <= 1 + 4 u: a placed vertex is off by frameError() from R x + T, R and T as
// stored; n and R^T n by 4 u a coordinate; products and sums by 4 u of the 1-norms: below 32 u of
// all lengths that enter, twice for n's own length in `margin`. Vertices of no triangle, which the
// root volumes need not hold, are computed worse, but those of triangles make the heights as large
// as they must be whatever others add.
template <typename S>
bool verticesApart(const MeshPair<S>& frame, double margin) {
  using Vec = Eigen::Vector3d;
  const Model<S>&a = frame.a, &b = frame.b;
  if (std::max(a.num_vertices, b.num_vertices) > kMostVertices) return false;
  if (!areFinite<S>(a.vertices, a.num_vertices) || !areFinite<S>(b.vertices, b.num_vertices)) {
    return false;
  }
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

KIOS_INSTANTIATE_FUNCTION(firstIntersecting);
KIOS_INSTANTIATE_FUNCTION(intersectingOfFew);
KIOS_INSTANTIATE_FUNCTION(verticesApart);

}  // namespace kios
