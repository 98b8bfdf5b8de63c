// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Lower bounds of the distances of eight boxes to another, in floats, are below those in long
// double, on every instruction set: boxes of any size and shape, parallel to each other or nearly,
// far from the origin for their size, at gaps down to nothing.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <utility>
#include <vector>

#include "search/float_frame.h"
#include "search/on_targets.h"
#include "shapes.h"
#include "tree/moment_fit.h"
#include "tree/node_layout.h"
#include "tree/prepare.h"
#include "volume/rounding.h"
#include "volume/simd_targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "search/box_bounds_test.cpp"
#define HWY_COMPILE_ALL_ATTAINABLE
#include <hwy/foreach_target.h>  // NOLINT(llvm-include-order)
#include <hwy/highway.h>         // NOLINT(llvm-include-order)

#include "search/simd/node_test-inl.h"
//
#include "search/simd/box_test-inl.h"

HWY_BEFORE_NAMESPACE();
namespace kios::engine::HWY_NAMESPACE {

void bounds(const BoxBlock& block, const Box& box, const FloatPose& X, float pad, bool contact,
            float* out) {
  Box moved;
  move(box, X, moved);
  for (size_t l = 0; l < kLanes; l += step()) {
    const BoxLanes a(block, l), b(moved);
    hn::StoreU(contact ? contactBounds(a, b, pad) : distanceBounds(a, b, pad), d, out + l);
  }
}

}  // namespace kios::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace kios::engine {
HWY_EXPORT(bounds);
}  // namespace kios::engine

namespace kios::testing {
namespace {

using engine::Box;
using engine::kCenter;
using engine::kLanes;
using Real = long double;
using Vec = Eigen::Matrix<Real, 3, 1>;
using Mat = Eigen::Matrix<Real, 3, 3>;

/// Says what a box may contain: all p with |e_i . (p - c)| <= h_i for the axes as they are stored.
class Content {
 public:
  explicit Content(const Box& box)
      : axes_(axesOf(box)),
        dual_(axes_.transpose().inverse()),
        center_(box.x[kCenter], box.y[kCenter], box.z[kCenter]),
        half_(box.half[0], box.half[1], box.half[2]) {}

  /// Returns a point of the box, nearly the nearest to x.
  Vec towards(const Vec& x) const {
    const Vec at = axes_.transpose() * (x - center_);
    return center_ + dual_ * at.cwiseMax(-half_).cwiseMin(half_);
  }
  Vec center() const { return center_; }

 private:
  static Mat axesOf(const Box& box) {
    Mat axes;
    for (int i = 0; i < 3; ++i) axes.col(i) = Vec(box.x[i], box.y[i], box.z[i]);
    return axes;
  }
  Mat axes_, dual_;
  Vec center_, half_;
};

struct Nearest {
  Vec a, b;  ///< in A's frame
  Real distance;
};

/// Returns two points of the boxes, nearly the nearest: projections from one to the other. Whatever
/// they are, no bound may exceed their distance.
Nearest nearest(const Content& a, const Content& b, const Mat& R, const Vec& t) {
  Vec q = R * b.center() + t, p;
  for (int i = 0; i < 400; ++i) {
    p = a.towards(q);
    q = R * b.towards(R.transpose() * (p - t)) + t;
  }
  return {p, q, (q - p).norm()};
}

Eigen::Vector3f direction(Random& random) { return inCube(random).cast<float>(); }

Box boxOf(const Eigen::Matrix3f& axes, const Eigen::Vector3f& center, const Eigen::Vector3f& half) {
  Box box = {};
  for (int i = 0; i < 3; ++i) {
    box.x[i] = axes(0, i);
    box.y[i] = axes(1, i);
    box.z[i] = axes(2, i);
    box.half[i] = half[i];
  }
  box.x[kCenter] = center[0];
  box.y[kCenter] = center[1];
  box.z[kCenter] = center[2];
  return box;
}

/// Sides of any ratio up to 2^20, of which some are 0.
Eigen::Vector3f anyHalf(Random& random, double size) {
  Eigen::Vector3f half;
  for (float& h : half) {
    const double kind = random.unit();
    h = static_cast<float>(kind < 0.2 ? 0 : size * (kind < 0.5 ? 1 : anySize(random, 0x1p-20, 1)));
  }
  return half;
}

/// Returns axes along the first's, nearly so, or any.
Eigen::Matrix3f anyAxes(Random& random, const Eigen::Matrix3f& near) {
  const double kind = random.unit();
  if (kind < 0.25) return near;
  if (kind < 0.5) {
    const auto tilt = static_cast<float>(anySize(random, 1e-8, 1e-2));
    return axesAlong(near.col(0) + tilt * direction(random),
                     near.col(1) + tilt * direction(random));
  }
  if (kind < 0.6) return Eigen::Matrix3f::Identity();
  return axesAlong(direction(random), direction(random));
}

/// Returns the smallest reach that a tree with this box may have.
double reachOf(const Box& box) {
  return std::hypot(double{box.x[kCenter]}, double{box.y[kCenter]}, double{box.z[kCenter]}) +
         double{std::max({box.half[0], box.half[1], box.half[2]})};
}

struct Outcome {
  long bounded = 0, wrong = 0, without_pad = 0;
  long parted = 0, missed = 0;  ///< boxes apart, and those that contact bounds don't tell so
  double shares = 0;            ///< sum of bound / distance
  double pad_used = 0;          ///< the largest share of the pad that rounding takes
};

/// Boxes of about `size`, their centres up to `offset` sizes from their origins, apart by `gap`
/// sizes.
void tryBoxes(double size, double offset, double gap, std::uint64_t seed, Outcome& sum) {
  Random random(seed);
  std::vector<Box> boxes;
  const auto place = [&](double at) -> Eigen::Vector3f {
    return (at * size * inCube(random)).cast<float>();
  };
  const Eigen::Matrix3f first = axesAlong(direction(random), direction(random));
  engine::Tree a, b;
  const Eigen::Vector3f around = place(offset);
  for (int lane = 0; lane < kLanes; ++lane) {
    boxes.push_back(boxOf(anyAxes(random, first), around + place(1), anyHalf(random, size)));
    a.reach = std::max(a.reach, static_cast<float>(reachOf(boxes.back()) * (1 + 1e-6)));
  }
  a.nodes.resize(1 + kLanes);
  a.nodes[0].first_child = 1;
  for (int lane = 1; lane <= kLanes; ++lane) a.nodes[static_cast<std::size_t>(lane)].child = -1;
  a.children.resize(1);
  a.children[0].count = kLanes;
  a.boxes.resize(1);
  a.boxes.insert(a.boxes.end(), boxes.begin(), boxes.end());
  engine::writeBoxBlocks(a);
  const Box other = boxOf(anyAxes(random, first), place(offset), anyHalf(random, size));
  b.reach = static_cast<float>(reachOf(other) * (1 + 1e-6));
  // Rotations that round, and those that keep axes parallel.
  fcl::Transform3d X_AB = fcl::Transform3d::Identity();
  if (random.unit() < 0.7) {
    X_AB.linear() =
        Eigen::AngleAxisd(random.unit() < 0.3 ? anySize(random, 1e-9, 1e-3) : random.uniform(0, 6),
                          inCube(random).normalized())
            .toRotationMatrix();
  }
  const Content of_b(other);
  const int chosen = static_cast<int>(random.uniform(0, kLanes));
  X_AB.translation() =
      (around + place(2)).cast<double>() - X_AB.linear() * of_b.center().cast<double>();
  {  // so far from the chosen box
    const Nearest found = nearest(Content(boxes[static_cast<std::size_t>(chosen)]), of_b,
                                  X_AB.linear().cast<Real>(), X_AB.translation().cast<Real>());
    if (found.distance > 0) {
      const Vec along = (found.b - found.a) / found.distance;
      X_AB.translation() += ((gap * size - found.distance) * along).cast<double>();
    }
  }
  engine::FloatFrame frames;
  const RelativePose<double> pose(fcl::Transform3d::Identity(), X_AB);
  engine::TreePose trees;
  if (!engine::makeTreePose(a, b, pose, trees)) return;
  engine::makeFloatFrame(trees, frames);
  const Mat R = pose.R().cast<Real>();
  const Vec t = pose.T().cast<Real>();
  for (const bool contact : {false, true}) {
    alignas(32) float found[kLanes], without_pad[kLanes];
    HWY_DYNAMIC_DISPATCH(engine::bounds)
    (a.box_blocks[0], other, frames.a_from_b, frames.box_pad, contact, found);
    HWY_DYNAMIC_DISPATCH(engine::bounds)
    (a.box_blocks[0], other, frames.a_from_b, 0, contact, without_pad);
    for (int lane = 0; lane < kLanes; ++lane) {
      const Real distance =
          nearest(Content(boxes[static_cast<std::size_t>(lane)]), of_b, R, t).distance;
      ASSERT_FALSE(std::isnan(found[lane]));
      sum.wrong += found[lane] > 0 && found[lane] > distance;
      if (without_pad[lane] > 0 && without_pad[lane] > distance) {
        ++sum.without_pad;
        sum.pad_used = std::max(
            sum.pad_used, static_cast<double>((without_pad[lane] - distance) / frames.box_pad));
      }
      if (contact && distance > 0.05L * static_cast<Real>(size) && offset <= 1) {
        ++sum.parted;
        sum.missed += !(found[lane] > 0);
      }
      if (contact || !(distance > 0.01L * static_cast<Real>(size)) || offset > 1) continue;
      ++sum.bounded;
      sum.shares += static_cast<double>(std::max(0.0F, found[lane]) / distance);
    }
  }
}

using BoxBounds = OnTargets;

TEST_P(BoxBounds, AreBelowTheDistance) {
  Outcome sum;
  std::uint64_t seed = 1;
  for (const double size : {1.0, 0x1p-34, 0x1p-18, 0x1p20, 0x1p38}) {
    for (const double offset : {0.0, 1.0, 64.0, 0x1p18}) {
      for (const double gap : {0.0, 1e-7, 1e-5, 1e-2, 1.0}) {
        for (int i = 0; i < 12; ++i) tryBoxes(size, offset, gap, ++seed, sum);
      }
    }
  }
  EXPECT_EQ(sum.wrong, 0);
  EXPECT_GT(sum.without_pad, 500);  // it is the pad that makes them right
  ASSERT_GT(sum.bounded, 500);
  EXPECT_GT(sum.shares / static_cast<double>(sum.bounded), 0.94);  // and they tell nearly all
  // All axes together separate whatever is apart; nearest() may stop at points farther than that.
  ASSERT_GT(sum.parted, 500);
  EXPECT_LE(sum.missed, sum.parted / 1000);
  std::printf("rounding takes %.3f of the pad at most; bounds are %.3f of distances\n",
              sum.pad_used, sum.shares / static_cast<double>(sum.bounded));
}

INSTANTIATE_TEST_SUITE_P(Targets, BoxBounds,
                         ::testing::ValuesIn(hwy::SupportedAndGeneratedTargets()), nameOfTarget);

}  // namespace
}  // namespace kios::testing
#endif  // HWY_ONCE
