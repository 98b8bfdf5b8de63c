// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "scenes/random.h"
#include "shape/solid.h"
#include "shape/solid_oracle.h"
#include "shape/triangle_shape.h"

// Solids and triangles of all the sizes and degeneracies that queries promise to serve.

namespace kios::testing {

inline const char* nameOf(shape::Kind kind) {
  constexpr const char* kNames[] = {"sphere",   "capsule", "box",   "ellipsoid",
                                    "cylinder", "cone",    "convex"};
  return kNames[static_cast<int>(kind)];
}

struct NameOfKind {
  template <typename Info>
  std::string operator()(const Info& info) const {
    return nameOf(info.param);
  }
};

enum class Size {
  kPlain,  ///< lengths in [0.2, 1]
  kThin,   ///< half of them 1e-3 of that
  kFlat,   ///< half of them 1e-12 to 0.1
  kZero,   ///< half of them 0
  kTiny    ///< all times 1e-6
};
inline constexpr Size kSizes[] = {Size::kPlain, Size::kThin, Size::kFlat, Size::kZero, Size::kTiny};

class SolidCases {
 public:
  explicit SolidCases(std::uint64_t seed) : random_(seed) {}

  double unit() { return random_.unit(); }
  int pick(int n) { return static_cast<int>(n * random_.unit()); }
  double power(double low, double high) { return std::pow(10.0, random_.uniform(low, high)); }
  shape::Vec vector() {
    return {random_.uniform(-1, 1), random_.uniform(-1, 1), random_.uniform(-1, 1)};
  }

  shape::Solid solid(shape::Kind kind, Size size) {
    shape::Solid s;
    s.kind = kind;
    s.half = {length(size), length(size), length(size)};
    s.radius = length(size);
    s.half_length = length(size);
    if (kind == shape::Kind::kConvex) convex(s);
    return s;
  }

  /// Returns fat, thin, collinear, with two corners or all in one place or nearly; some across an
  /// axis.
  shape::Triangle triangle(const shape::Vec& at, double size) {
    const shape::Vec a = vector();
    shape::Vec b = vector(), c = vector();
    switch (pick(7)) {
      case 0:
        c = a + unit() * (b - a) + power(-14, -1) * vector();
        break;
      case 1:
        b = a + power(-14, -1) * vector();
        break;
      case 2:
        c = b;
        break;
      case 3:
        b = c = a;
        break;
      case 4:
        c = a + unit() * (b - a);
        break;
      default:
        break;
    }
    shape::Triangle t = {shape::Vec(at + size * a), shape::Vec(at + size * b),
                         shape::Vec(at + size * c)};
    if (pick(8) == 0) {
      const int axis = pick(3);
      for (shape::Vec& p : t) p[axis] = t[0][axis];
    }
    std::rotate(t.begin(), t.begin() + pick(3), t.end());  // no corner is special
    return t;
  }

 private:
  double length(Size size) {
    const double plain = random_.uniform(0.2, 1);
    if (size == Size::kTiny) return 1e-6 * plain;
    if (size == Size::kPlain || pick(2) == 0) return plain;
    if (size == Size::kZero) return 0;
    return plain * (size == Size::kThin ? 1e-3 : power(-12, -1));
  }

  /// Boxes, tetrahedra, octahedra, polygons of one and of two faces, segments, points: turned, and
  /// not about the origin.
  void convex(shape::Solid& s) {
    using shape::Vec;
    const Vec h = s.half, at = pick(3) == 0 ? Vec(vector()) : Vec(Vec::Zero());
    Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
    if (pick(4) > 0) R = Eigen::AngleAxisd(3 * unit(), vector().normalized());
    const auto add = [&](const Vec& p) { s.points.push_back(R * p.cwiseProduct(h) + at); };
    faces_.clear();
    switch (pick(6)) {
      case 0:
        for (int i = 0; i < 8; ++i) add({i & 1 ? 1. : -1., i & 2 ? 1. : -1., i & 4 ? 1. : -1.});
        faces_ = {4, 0, 1, 3, 2, 4, 4, 5, 7, 6, 4, 0, 1, 5, 4,
                  4, 2, 6, 7, 3, 4, 0, 4, 6, 2, 4, 1, 3, 7, 5};
        s.num_faces = 6;
        break;
      case 1:
        for (int i = 0; i < 4; ++i) add(vector());
        faces_ = {3, 0, 1, 2, 3, 0, 3, 1, 3, 1, 3, 2, 3, 2, 3, 0};
        s.num_faces = 4;
        break;
      case 2:
        for (int i = 0; i < 3; ++i) {
          add(Vec::Unit(i));
          add(-Vec::Unit(i));
        }
        for (int i = 0; i < 8; ++i) {
          faces_.insert(faces_.end(), {3, i & 1, 2 + (i >> 1 & 1), 4 + (i >> 2 & 1)});
        }
        s.num_faces = 8;
        break;
      case 3: {
        const int corners = 3 + pick(6);
        s.num_faces = 1 + pick(2);
        for (int i = 0; i < corners; ++i) {
          const double a = 2 * M_PI * i / corners;
          add({std::cos(a), std::sin(a), 0});
        }
        for (int f = 0; f < s.num_faces; ++f) {
          faces_.push_back(corners);
          for (int i = 0; i < corners; ++i) faces_.push_back(f == 0 ? i : corners - 1 - i);
        }
        break;
      }
      case 4:
        add({1, 1, 1});
        add({-1, -1, -1});
        faces_ = {2, 0, 1};
        s.num_faces = 1;
        break;
      default:
        add({1, 1, 1});
        faces_ = {1, 0};
        s.num_faces = 1;
    }
    s.faces = faces_.data();
  }

  scenes::Random random_;
  std::vector<int> faces_;  ///< of the last convex shape
};

/// Holds a bounded solid and a triangle near it, with the exact distance.
struct NearPair {
  shape::Solid solid;
  shape::Triangle triangle;
  std::vector<ExactTriangle> faces;
  Real extent;         ///< the length that promises are relative to
  Real distance;       ///< 0 at overlap
  Real depth;          ///< at overlap: of a ball in the solid about a point of the triangle
  bool judged = true;  ///< false for what may lie in the inside of a shape too thin for this oracle

  bool round() const { return faces.empty(); }
};

/// Sets what the oracle says of the pair.
inline void measure(NearPair& pair) {
  const shape::Solid& s = pair.solid;
  const shape::Triangle& t = pair.triangle;
  const double margin = s.margin();
  pair.extent = s.reach();
  for (const shape::Vec& p : t) {
    pair.extent = std::max(pair.extent, Real(s.reach() + p.lpNorm<Eigen::Infinity>()));
  }
  const Real core = coreNearest(s, t, pair.faces).distance;
  Real level = core - margin;
  if (pair.round()) level = std::min(core, leastPointLevel(s, exact(t)));
  if (!pair.round() && margin == 0) {
    const FaceLevel inside(s, pair.faces);
    const bool flat = inside.thickness() < 1e-15L;
    const Real least = flat ? Real(1) : leastOver(exact(t), inside);
    pair.judged = !(least < 0) || s.kind == shape::Kind::kBox || inside.thickness() > 1e-5L;
    if (least < 0) level = least;
  }
  pair.distance = std::max(Real(0), level);
  pair.depth = std::max(Real(0), -level);
}

/// Moves the triangle so that the gap is about `gap`, and measures the pair.
inline void setGap(double gap, NearPair& pair) {
  const shape::Solid& s = pair.solid;
  shape::Triangle& t = pair.triangle;
  const double margin = s.margin();
  for (int pass = 0; pass < 2; ++pass) {
    shape::Vec way = shape::Vec::Zero();
    if (pair.round()) {
      const ExactNearest near = roundDistance(s, exact(t));
      way = (near.on_triangle - near.on_shape).cast<double>();
    } else {
      double least = std::numeric_limits<double>::infinity();
      for (const ExactTriangle& f : pair.faces) {
        const auto near = triangleDistance<double>(
            t, {f[0].cast<double>(), f[1].cast<double>(), f[2].cast<double>()});
        if (near.distance < least) way = near.point_a - near.point_b;
        least = std::min(least, near.distance);
      }
    }
    const double length = way.norm();
    if (!(length > 0)) break;
    for (shape::Vec& p : t) p += (margin + gap - length) / length * way;
  }
  measure(pair);
}

inline NearPair nearPair(SolidCases& cases, shape::Kind kind, Size size) {
  NearPair pair;
  pair.solid = cases.solid(kind, size);
  pair.faces = coreFaces(pair.solid);
  const double scale = size == Size::kTiny ? 1e-6 : std::max(pair.solid.reach(), 1e-3);
  const double triangle = scale * (cases.pick(2) ? cases.power(-2, 1) : cases.power(-9, 6));
  const shape::Vec at = scale * (cases.pick(3) ? 2 : cases.power(-3, 1)) * cases.vector();
  pair.triangle = cases.triangle(at, triangle);
  if (cases.pick(2)) {  // a corner near the solid
    const shape::Vec off = pair.triangle[cases.pick(3)] - at;
    for (shape::Vec& p : pair.triangle) p -= off;
  }
  double gap = scale * cases.power(-15.5, -1);
  const double margin = pair.solid.margin();
  if (margin > 0 && cases.pick(3) == 0) gap = -std::min(gap, margin) * cases.unit();
  setGap(gap, pair);
  return pair;
}

/// Returns a needle that passes the solid with its inside: up to 1e6 of that long, about as wide.
inline NearPair nearNeedle(SolidCases& cases, shape::Kind kind) {
  NearPair pair;
  pair.solid = cases.solid(kind, Size::kPlain);
  pair.faces = coreFaces(pair.solid);
  const double reach = pair.solid.reach(), length = reach * cases.power(1, 6);
  const shape::Vec along = length * cases.vector(),
                   across = reach * cases.power(-1, 1) * cases.vector();
  const double u = cases.unit(), v = (1 - u) * cases.unit();
  const shape::Vec at = 2 * reach * cases.vector();
  pair.triangle = {shape::Vec(at - u * along - v * across),
                   shape::Vec(at + (1 - u) * along - v * across),
                   shape::Vec(at - u * along + (1 - v) * across)};
  std::rotate(pair.triangle.begin(), pair.triangle.begin() + cases.pick(3), pair.triangle.end());
  setGap(length * cases.power(-14, -9), pair);
  return pair;
}

}  // namespace kios::testing
