// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Local depths of boxes on a grid, against samples of their faces and balls.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include "not_finite.h"
#include "scenes/triangle_families.h"
#include "solid/solid_meshes.h"

namespace kios::testing {
namespace {

using fcl::Vector3d;
using scenes::merged;
using scenes::subdividedBox;

/// A union of boxes whose corners are whole, at an offset: known cube by cube, and so what of the
/// boxes' faces is surface of the union.
class Cubes {
 public:
  Cubes(Random& random, const Vector3d& at) : at_(at) {
    std::vector<Mesh> boxes;
    const int count = scenes::integer(random, 1, 3);
    for (int i = 0; i < count; ++i) {
      Vector3d low, size;
      for (int c = 0; c < 3; ++c) {
        low[c] = scenes::integer(random, 0, kSide - 2);
        size[c] = scenes::integer(random, 1, kSide - 1 - static_cast<int>(low[c]));
      }
      boxes.push_back(
          transformed(subdividedBox(size, scenes::integer(random, 1, 3)), 1, low + size / 2));
      for (int k = 0; k < kSide * kSide * kSide; ++k) {
        const Vector3d middle = corner(k) + Vector3d::Constant(0.5);
        full_[k] |= ((middle - low).array() > 0 && (low + size - middle).array() > 0).all();
      }
    }
    model = solidOf(merged(boxes));
    for (int k = 0; k < kSide * kSide * kSide; ++k) {
      if (!full_[k]) continue;
      for (int c = 0; c < 6; ++c) {
        const Vector3d to = (c < 3 ? 1.0 : -1.0) * Vector3d::Unit(c % 3);
        if (holdsCube(corner(k) + to)) continue;
        const Vector3d middle = corner(k) + Vector3d::Constant(0.5) + 0.5 * to;
        const Vector3d half = 0.5 * (Vector3d::Ones() - Vector3d::Unit(c % 3));
        faces.emplace_back(at_ + middle - half, at_ + middle + half);
      }
    }
  }

  fcl::Transform3d pose() const { return at(at_[0], at_[1], at_[2]); }
  /// 0 outside.
  double depth(const Vector3d& p) const {
    bool inside = false;
    for (int k = 0; k < kSide * kSide * kSide && !inside; ++k) {
      const Vector3d from = p - at_ - corner(k);
      inside = full_[k] && from.minCoeff() >= 0 && from.maxCoeff() <= 1;
    }
    return inside ? distance(p) : 0;
  }
  double distance(const Vector3d& p) const {
    double least = kInfinity;
    for (const Eigen::AlignedBox3d& face : faces) {
      least = std::min(least, face.exteriorDistance(p));
    }
    return least;
  }

  std::vector<Eigen::AlignedBox3d> faces;  ///< of the surface, in the world
  std::shared_ptr<Modeld> model;

 private:
  static constexpr int kSide = 5;
  static Vector3d corner(int k) {
    return {double(k % kSide), double(k / kSide % kSide), double(k / (kSide * kSide))};
  }
  bool holdsCube(const Vector3d& low) const {
    if (low.minCoeff() < 0 || low.maxCoeff() >= kSide) return false;
    return full_[static_cast<int>(low[0] + kSide * (low[1] + kSide * low[2]))];
  }
  const Vector3d at_;
  bool full_[kSide * kSide * kSide] = {};
};

/// Faces, edges and middles coincide, and unions have walls.
TEST(LocalDepth, OfBoxesOnAGrid) {
  Random random(29);
  int closed = 0, walls = 0;
  const int cases = casesOr(60);
  for (int i = 0; i < cases; ++i) {
    Vector3d by;
    for (int c = 0; c < 3; ++c) by[c] = 0.5 * scenes::integer(random, -3, 3);
    if (i % 4 == 0) by[0] += 1e-7;
    const Cubes a(random, Vector3d::Zero()), b(random, by);
    LocalDepthRequest request;
    request.max_pieces = 3000;
    const LocalDepthResult found = localDepth(*a.model, a.pose(), *b.model, b.pose(), request);
    double deepest = 0;
    for (const auto& [own, other] : {std::pair(&a, &b), std::pair(&b, &a)}) {
      for (const Eigen::AlignedBox3d& face : own->faces) {
        for (int k = 0; k < 27; ++k) {
          const Vector3d share(k % 3 / 2.0, k / 3 % 3 / 2.0, k / 9 / 2.0);
          deepest = std::max(deepest, other->depth(face.min() + share.cwiseProduct(face.sizes())));
        }
      }
    }
    for (int k = 0; k < 500; ++k) {
      Vector3d p;
      for (int c = 0; c < 3; ++c) p[c] = 0.25 * scenes::integer(random, 0, 20);
      deepest = std::max(deepest, std::min(a.depth(p), b.depth(p)));
    }
    EXPECT_LE(deepest, found.upper + 1e-11) << i;
    const Vector3d p = Eigen::Map<const Vector3d>(found.point);
    if (found.lower > 1e-9) {
      const double depth_a = a.depth(p), depth_b = b.depth(p);
      EXPECT_GE(found.surface_of == 1 ? depth_b : depth_a, found.lower - 1e-11) << i;
      EXPECT_TRUE(found.surface_of != 0 || depth_b >= found.lower - 1e-11) << i;
      EXPECT_LE(found.surface_of == 0 ? 0 : (found.surface_of == 1 ? a : b).distance(p), 1e-10);
    }
    closed += found.complete ? 1 : 0;
    walls += found.upper > 1.02 * found.lower + 1e-9 ? 1 : 0;
  }
  EXPECT_GT(closed, cases / 3);
  EXPECT_GT(walls, 0);
}

}  // namespace
}  // namespace kios::testing
