// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>

#include "fcl_kios/model/model.h"
#include "query/few_triangles.h"
#include "query/mesh_pair.h"
#include "triangle/plain_intersection.h"
#include "volume/lanes.h"
#include "volume/rounding.h"

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace kios {

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
  template <typename S>
  void add(const Point<S>& x) {
    for (int c = 0; c < 3; ++c) {
      low[c] = std::min(low[c], double{x[c]});
      high[c] = std::max(high[c], double{x[c]});
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

/// The squared distance of two boxes, right to 5 u; lower() of one, upper() of the other.
inline double squaredDistance(const Sides& lower, const Sides& upper) {
  const auto along = [](lanes::Double2 gap) { return std::max(std::max(gap[0], gap[1]), 0.0); };
  const double x = along(lower.x - upper.x), y = along(lower.y - upper.y),
               z = along(lower.z - upper.z);
  return x * x + y * y + z * z;
}

/// The distance, right to 4 u.
inline double distance(const Sides& lower, const Sides& upper) {
  return std::sqrt(squaredDistance(lower, upper));
}

/// Whether two boxes have no point in common; lower() of one, upper() of the other.
inline bool apart(const Sides& lower, const Sides& upper) {
  const auto gap = (lower.x > upper.x) | (lower.y > upper.y) | (lower.z > upper.z);
#if defined(__SSE2__)
  return _mm_movemask_pd(reinterpret_cast<__m128d>(gap)) != 0;
#else
  return (gap[0] | gap[1]) != 0;
#endif
}

/// Planes of so few triangles tell more than the boxes of all.
constexpr int kFewPlanes = 4;

/// Triangles of a model.
using Bits = std::uint64_t;
static_assert(kFewTriangles <= std::numeric_limits<Bits>::digits);

/// A model of few triangles with its vertices in the common frame, each placed once.
template <typename S>
class PlacedTriangles {
 public:
  /// `place` maps a vertex to that frame.
  template <typename Place>
  PlacedTriangles(const Model<S>& model, const Place& place) : size_(model.num_tris) {
    // Vertices of no triangle may be anything, NaN too, and more than there is room for.
    constexpr std::uint8_t kNone = 0xFF;
    std::uint8_t places[kMostCorners];
    const bool fit = model.num_vertices <= kMostCorners;
    if (fit) std::fill_n(places, model.num_vertices, kNone);
    const engine::MeshView<S> mesh = viewOf(model);
    for (int t = 0; t < size_; ++t) {
      for (int k = 0; k < 3; ++k) {
        const std::size_t vertex = mesh.index(static_cast<std::size_t>(t), k);
        if (fit && places[vertex] != kNone) {
          corners_[t][k] = places[vertex];
          continue;
        }
        corners_[t][k] = static_cast<std::uint8_t>(num_vertices_);
        if (fit) places[vertex] = corners_[t][k];
        vertices_[num_vertices_++] = place(mesh.vertices[vertex]);
      }
    }
  }

  int size() const { return size_; }
  Box box() const {
    Box box;
    for (int i = 0; i < num_vertices_; ++i) box.add(vertices_[i]);
    return box;
  }
  TriangleVertices<S> triangle(int t) const {
    return {vertices_[corners_[t][0]], vertices_[corners_[t][1]], vertices_[corners_[t][2]]};
  }
  Box box(int t) const { return Box::of(triangle(t)); }
  PlainPlane plane(int t) const { return planeOf(triangle(t)); }

  /// The triangles that a plane doesn't prove to lie on one side of it.
  Bits crossing(const PlainPlane& plane) const {
    int sides[kMostCorners];
    for (int i = 0; i < num_vertices_; ++i) sides[i] = plane.side(vertices_[i]);
    Bits bits = 0;
    for (int t = 0; t < size_; ++t) {
      const auto& [u, v, w] = corners_[t];
      if (std::abs(sides[u] + sides[v] + sides[w]) < 3) bits |= Bits{1} << t;
    }
    return bits;
  }

 private:
  static constexpr int kMostCorners = 3 * kFewTriangles;

  const int size_;
  int num_vertices_ = 0;
  std::array<std::uint8_t, 3> corners_[kFewTriangles];
  Point<S> vertices_[kMostCorners];
};

/// Few triangles of two models, in the common frame.
template <typename S>
struct PlacedPair {
  explicit PlacedPair(const MeshPair<S>& frame)
      : a(frame.a, [](const Point<S>& x) { return x; }),
        b(frame.b, [&frame](const Point<S>& x) { return frame.X_AB * x; }) {}
  const PlacedTriangles<S> a, b;
};

/// Returns the least ids of triangles that intersect; -1 if none do.
template <typename S>
engine::TrianglePairIds firstIntersecting(const PlacedPair<S>& pair, SearchCounts& counts);

}  // namespace kios
