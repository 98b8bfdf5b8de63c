// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// A leaf that is split: its triangles' boxes contain them, and lower bounds of the distances of
// points to them, in floats, are below distances in long double, on every instruction set. The
// triangles are of any size and shape, needles and points among them, far from the origin for their
// size, and points lie above faces, beyond edges and corners, or all but touch.

#include <gtest/gtest.h>

#include <algorithm>
#include <boost/container/small_vector.hpp>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <limits>
#include <utility>
#include <vector>

#include "scenes/triangle_oracle.h"
#include "search/on_targets.h"
#include "search/root_body.h"
#include "search/search.h"
#include "search/tuning.h"
#include "shapes.h"
#include "tree/compress_table.h"
#include "tree/leaf_layout.h"
#include "volume/rounding.h"
#include "volume/simd_targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "search/triangle_bounds_test.cpp"
#define HWY_COMPILE_ALL_ATTAINABLE
#include <hwy/cache_control.h>   // NOLINT(llvm-include-order)
#include <hwy/foreach_target.h>  // NOLINT(llvm-include-order)
#include <hwy/highway.h>         // NOLINT(llvm-include-order)

#include "search/simd/node_test-inl.h"
//
#include "search/simd/box_test-inl.h"
//
#include "search/simd/frontier-inl.h"
//
#include "search/simd/leaf_cull-inl.h"
//
#include "search/simd/leaf_pair-inl.h"
//
#include "search/simd/triangle_bounds-inl.h"

HWY_BEFORE_NAMESPACE();
namespace kios::engine::HWY_NAMESPACE {

void boxes(const Tree& tree, BoxBlock& out) { boxTriangles(LeafView(tree, tree.leaves[0]), out); }

/// Bounds without a pad of the distance of a point of the other frame to each triangle.
void pointMoved(const Tree& tree, const FloatFrame& frames, const float* point, float* out) {
  const Vec3 p = moved(frames.a_from_b, vec3(point));
  const V3 at = {hn::Set(d, p.x), hn::Set(d, p.y), hn::Set(d, p.z)};
  for (size_t l = 0; l < kLanes; l += step()) {
    hn::StoreU(Faces{LeafView(tree, tree.leaves[0]).faces, l}.distances(at), d, out + l);
  }
}

/// Bounds them where the triangles are moved.
void trianglesMoved(const Tree& tree, const FloatFrame& frames, const float* point, float* out) {
  const V3 at = {hn::Set(d, point[0]), hn::Set(d, point[1]), hn::Set(d, point[2])};
  const LeafView leaf(tree, tree.leaves[0]);
  for (uint32_t lane = 0; lane < kLanes; ++lane) {
    const MovedFace face(leaf, std::min(lane, leaf.leaf.num_faces - 1U), frames.b_from_a);
    out[lane] = hn::GetLane(face.faces().distances(at));
  }
}

float padOfPrisms(const FloatFrame& frames) { return prismPad(frames); }

}  // namespace kios::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace kios::engine {
HWY_EXPORT(boxes);
HWY_EXPORT(pointMoved);
HWY_EXPORT(trianglesMoved);
HWY_EXPORT(padOfPrisms);
}  // namespace kios::engine

namespace kios::testing {
namespace {

using engine::FaceCorners;
using engine::kCenter;
using engine::kLanes;
using Real = long double;
using Vec = Eigen::Matrix<Real, 3, 1>;
using Mat = Eigen::Matrix<Real, 3, 3>;

Real distanceTo(const Vec& p, const FaceCorners& face) {
  return scenes::triangleDistance(
      {p, p, p}, {face[0].cast<Real>(), face[1].cast<Real>(), face[2].cast<Real>()});
}

/// Returns triangles about `center`: of any shape, thin, and without an area or an extent.
FaceCorners anyFace(Random& random, const fcl::Vector3d& center, double size) {
  const fcl::Vector3d p = center + size * inCube(random), e = size * inCube(random);
  const double kind = random.unit();
  if (kind < 0.05) return {p, p, p};
  if (kind < 0.1) return {p, p + e, p};
  if (kind < 0.15) return {p, p + e, p + 0.3 * e};
  const double thin = kind < 0.5 ? anySize(random, 1e-9, 1) : 1.0;
  FaceCorners face = {p, p + e, p + random.uniform(-0.5, 1.5) * e + thin * size * inCube(random)};
  std::rotate(face.begin(), face.begin() + static_cast<int>(random.uniform(0, 3)), face.end());
  return face;
}

/// Returns a leaf of such triangles, whose corners are stored one by one.
engine::Tree leafOf(const std::vector<FaceCorners>& faces) {
  engine::Tree tree;
  engine::Leaf& leaf = tree.leaves.emplace_back();
  Eigen::Vector3f vertices[engine::kMaxLeafFeatures];
  for (const FaceCorners& face : faces) {
    tree.features.push_back({std::uint32_t{leaf.num_faces++} << 2});
    for (const fcl::Vector3d& corner : face) {
      const Eigen::Vector3f p = corner.cast<float>();
      leaf.corners[leaf.num_vertices] = leaf.num_vertices;
      vertices[leaf.num_vertices++] = p;
      tree.reach = std::max(tree.reach, 1.000001F * p.norm());
    }
  }
  tree.lanes.resize(static_cast<std::size_t>(engine::leafRows(leaf.num_vertices)));
  engine::placeLeaf(vertices, faces.data(), leaf, tree);
  return tree;
}

/// Returns a corner as stored.
Vec stored(const engine::Tree& tree, std::size_t lane, std::size_t k) {
  return engine::vertexOf(tree, tree.leaves[0], static_cast<int>(3 * lane + k)).cast<Real>();
}

class TriangleBounds : public OnTargets {
 protected:
  static std::vector<FaceCorners> anyFaces(Random& random, double size, double offset) {
    const fcl::Vector3d center = offset * size * inCube(random);
    std::vector<FaceCorners> faces(1 + static_cast<std::size_t>(random.uniform(0, kLanes)));
    for (FaceCorners& face : faces) face = anyFace(random, center, size);
    return faces;
  }
};

TEST_P(TriangleBounds, BoxesContainTriangles) {
  Random random(5);
  double worst_axes = 0;
  long boxes = 0, tight = 0;
  for (const double size : {1.0, 0x1p-34, 0x1p-18, 0x1p20, 0x1p38}) {
    for (const double offset : {0.0, 1.0, 64.0, 0x1p18}) {
      for (int i = 0; i < 60; ++i) {
        const std::vector<FaceCorners> faces = anyFaces(random, size, offset);
        const engine::Tree tree = leafOf(faces);
        engine::BoxBlock block;
        HWY_DYNAMIC_DISPATCH(engine::boxes)(tree, block);
        for (std::size_t lane = 0; lane < faces.size(); ++lane) {
          Mat axes;
          Vec center, half;
          for (int k = 0; k < 3; ++k) {
            axes.col(k) = Vec(block.x[k].v[lane], block.y[k].v[lane], block.z[k].v[lane]);
            half[k] = block.half[k].v[lane];
          }
          center =
              Vec(block.x[kCenter].v[lane], block.y[kCenter].v[lane], block.z[kCenter].v[lane]);
          const Mat gram = axes.transpose() * axes - Mat::Identity();
          worst_axes = std::max(worst_axes, static_cast<double>(gram.norm()));
          Vec low = Vec::Constant(std::numeric_limits<Real>::infinity()), high = -low;
          for (std::size_t k = 0; k < 3; ++k) {
            const Vec at = axes.transpose() * (stored(tree, lane, k) - center);
            low = low.cwiseMin(at);
            high = high.cwiseMax(at);
            ASSERT_TRUE((at.cwiseAbs().array() <= half.array()).all())
                << "size " << size << " offset " << offset;
          }
          ++boxes;
          const Real rounding = 1e-6L * tree.reach + 0x1p-18L * half.sum();
          tight += ((high - low).array() / 2 + rounding >= 0.999L * half.array()).all();
        }
      }
    }
  }
  EXPECT_LE(worst_axes, 28 * 0x1p-24);
  EXPECT_EQ(tight, boxes);
  std::printf("Gram matrices are off by %.1f u\n", worst_axes * 0x1p24);
}

TEST_P(TriangleBounds, PrismsAreBelowTheDistance) {
  Random random(7);
  long bounded = 0, wrong = 0, without_pad = 0;
  double shares = 0, pad_used = 0;
  for (const double size : {1.0, 0x1p-34, 0x1p-18, 0x1p20, 0x1p38}) {
    for (const double offset : {0.0, 1.0, 64.0, 0x1p18}) {
      for (const double gap : {0.0, 1e-7, 1e-5, 1e-2, 1.0}) {
        for (int i = 0; i < 12; ++i) {
          const std::vector<FaceCorners> faces = anyFaces(random, size, offset);
          const engine::Tree a = leafOf(faces);
          // A point of b near one of the triangles.
          const Eigen::Vector3f point = (offset * size * inCube(random)).cast<float>();
          engine::Tree b;
          b.reach = std::max(1.000001F * point.norm(), static_cast<float>(size));
          const FaceCorners& face =
              faces[static_cast<std::size_t>(random.uniform(0, 1) * double(faces.size()))];
          const double s = random.uniform(-0.2, 1), t = random.uniform(-0.2, 1);
          fcl::Transform3d X_AB = fcl::Transform3d::Identity();
          X_AB.linear() = Eigen::AngleAxisd(random.uniform(0, 6), inCube(random).normalized())
                              .toRotationMatrix();
          if (random.unit() < 0.3) {  // a rotation to six digits
            for (int k = 0; k < 9; ++k) X_AB.linear().data()[k] += 3e-7 * random.uniform(-1, 1);
          }
          X_AB.translation() = face[0] + s * (face[1] - face[0]) + t * (face[2] - face[0]) +
                               gap * size * inCube(random) - X_AB.linear() * point.cast<double>();
          engine::FloatFrame frames;
          const RelativePose<double> pose(fcl::Transform3d::Identity(), X_AB);
          engine::TreePose trees;
          if (!engine::makeTreePose(a, b, pose, trees)) continue;
          engine::makeFloatFrame(trees, frames);
          const Vec p = pose.R().cast<Real>() * point.cast<Real>() + pose.T().cast<Real>();
          const float pad = HWY_DYNAMIC_DISPATCH(engine::padOfPrisms)(frames);
          for (const bool move_point : {false, true}) {
            alignas(32) float found[kLanes];
            if (move_point) {
              HWY_DYNAMIC_DISPATCH(engine::pointMoved)(a, frames, point.data(), found);
            } else {
              HWY_DYNAMIC_DISPATCH(engine::trianglesMoved)(a, frames, point.data(), found);
            }
            for (std::size_t lane = 0; lane < faces.size(); ++lane) {
              const Real distance = distanceTo(p, faces[lane]);
              ASSERT_FALSE(std::isnan(found[lane]));
              wrong += found[lane] - pad > distance;
              without_pad += found[lane] > distance;
              pad_used = std::max(pad_used, static_cast<double>((found[lane] - distance) / pad));
              if (offset > 1 || !(distance > 0.1L * static_cast<Real>(size))) continue;
              ++bounded;
              shares += static_cast<double>(found[lane] / distance);
            }
          }
        }
      }
    }
  }
  EXPECT_EQ(wrong, 0);
  EXPECT_GT(without_pad, 500);  // it is the pad that makes them right
  ASSERT_GT(bounded, 500);
  EXPECT_GT(shares / static_cast<double>(bounded), 0.6);
  std::printf("rounding takes %.3f of the pad at most; bounds are %.3f of distances\n", pad_used,
              shares / static_cast<double>(bounded));
}

INSTANTIATE_TEST_SUITE_P(Targets, TriangleBounds,
                         ::testing::ValuesIn(hwy::SupportedAndGeneratedTargets()), nameOfTarget);

}  // namespace
}  // namespace kios::testing
#endif  // HWY_ONCE
