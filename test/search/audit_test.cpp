// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Every pair of nodes that a search leaves out is at least as far apart as the search says: all
// pairs of triangles below the two are measured.

#include <gtest/gtest.h>

#include <limits>

#include "fcl_kios/triangle.h"
#include "search/prepared_pair.h"

namespace kios::testing {
namespace {

template <typename S>
class Auditor final : public engine::Audit {
 public:
  explicit Auditor(const Mesh& a, const Mesh& b, bool refitted = false)
      : posed_(a, b, refitted),
        below_a_(contents(*posed_.tree_a)),
        below_b_(contents(*posed_.tree_b)) {}

  void pruned(std::uint32_t node_a, std::uint32_t node_b, float bound) override {
    ++pruned_;
    if (!(least(node_a, node_b) >= double{bound})) ++wrong_;
  }

  /// Searches in every way at this pose. False if the pose is beyond floats.
  bool search(const fcl::Transform3d& X_A, const fcl::Transform3d& X_B) {
    if (!posed_.pose(X_A.cast<S>(), X_B.cast<S>())) return false;
    measure();
    const MeshPair& pair = posed_.pair();
    constexpr S kInfinity = std::numeric_limits<S>::max();
    for (const double at_most : {double{kInfinity}, 3 * nearest_, 1.01 * nearest_, 0.9 * nearest_,
                                 nearest_ + size_, 1e-3 * size_}) {
      for (const S rel_err : {S(0), S(0.3)}) {
        engine::PairQuery query;
        query.rel_err = rel_err;
        if (at_most < kInfinity) query.far_enough = query.cullDistance(at_most);
        SearchCounts counts;
        engine::nearestTriangles(pair, query, counts, this);
      }
    }
    SearchCounts counts;
    engine::intersectingTriangles(pair, 1, counts, this);
    engine::intersectingTriangles(pair, std::numeric_limits<std::size_t>::max(), counts, this);
    return true;
  }

  /// Moves B along the line of nearest points until so much of the distance is left.
  fcl::Transform3d closer(fcl::Transform3d X_A, fcl::Transform3d X_B, double left) {
    posed_.pose(X_A.cast<S>(), X_B.cast<S>());
    measure();
    X_B.translation() -= X_A.linear() * ((1 - left) * gap_);
    return X_B;
  }

  void expectRight(int least_pruned) const {
    EXPECT_EQ(wrong_, 0) << "of " << pruned_;
    EXPECT_GE(pruned_, least_pruned);  // or the test shows nothing
    EXPECT_GE(triangles_, least_triangles);
  }
  long least_triangles = 0;  ///< pairs with a triangle of a leaf that is split

 private:
  void measure() {
    const AllPairs all = posed_.all();
    const auto nearest = posed_.pair().distanceOf({all.nearest.first, all.nearest.second});
    distances_ = all.distances;
    nearest_ = all.distance;
    gap_ = nearest.point_b - nearest.point_a;
    size_ = all.extent;
  }

  /// Returns the triangles of a node, or one of a leaf that stands for it.
  static std::vector<std::uint32_t> contentOf(
      std::uint32_t node, const engine::Tree& tree,
      const std::vector<std::vector<std::uint32_t>>& below) {
    if (!engine::isTriangle(node)) return below[node];
    const engine::Leaf& leaf = tree.leaves[engine::leafOfTriangle(node)];
    return {tree.features[leaf.feature_offset + engine::laneOfTriangle(node)].triangle()};
  }

  double least(std::uint32_t node_a, std::uint32_t node_b) {
    triangles_ += engine::isTriangle(node_a) || engine::isTriangle(node_b);
    double result = std::numeric_limits<double>::infinity();
    for (const std::uint32_t i : contentOf(node_a, *posed_.tree_a, below_a_)) {
      const double* const row = distances_.data() + i * posed_.b.triangles.size();
      for (const std::uint32_t j : contentOf(node_b, *posed_.tree_b, below_b_)) {
        result = std::min(result, row[j]);
      }
    }
    return result;
  }

  PosedPair<S> posed_;
  const std::vector<std::vector<std::uint32_t>> below_a_, below_b_;
  std::vector<double> distances_;
  double nearest_ = 0, size_ = 0;
  fcl::Vector3d gap_;
  long pruned_ = 0, wrong_ = 0, triangles_ = 0;
};

/// An entry each is off by up to `error`: as poses read from files of six digits are.
fcl::Transform3d skewed(fcl::Transform3d X, double error, Random& random) {
  for (int i = 0; i < 9; ++i) X.linear()(i / 3, i % 3) += random.uniform(-error, error);
  return X;
}

template <typename S>
class AuditOf : public ::testing::Test {
 protected:
  /// Random, close and touching poses; `scale` and `offset` apply to the world.
  static void audit(const Mesh& a, const Mesh& b, double spread, int poses, double scale = 1,
                    double offset = 0, double skew = 0, bool refitted = false,
                    long least_triangles = 0) {
    Auditor<S> auditor(transformed(a, scale, fcl::Vector3d::Zero()),
                       transformed(b, scale, fcl::Vector3d::Zero()), refitted);
    Random random(17);
    const auto drawn = scenes::randomPoses(2 * poses, spread, 31);
    for (int i = 0; i < poses; ++i) {
      fcl::Transform3d X_A = skewed(drawn[2 * i], skew, random),
                       X_B = skewed(drawn[2 * i + 1], skew, random);
      for (fcl::Transform3d* X : {&X_A, &X_B}) {
        X->translation() = scale * X->translation() + fcl::Vector3d(offset, -offset, offset / 2);
      }
      EXPECT_TRUE(auditor.search(X_A, X_B));
      for (const double left : {0.1, 1e-3, 1e-6, 0.0}) {
        EXPECT_TRUE(auditor.search(X_A, auditor.closer(X_A, X_B, left)));
      }
    }
    auditor.least_triangles = least_triangles;
    auditor.expectRight(poses * 20);
  }

  static constexpr bool kDouble = sizeof(S) == sizeof(double);
};
using Scalars = ::testing::Types<double, float>;
TYPED_TEST_SUITE(AuditOf, Scalars);

const Mesh& torus() {
  static const Mesh mesh = scenes::bumpyTorus(150);
  return mesh;
}
const Mesh& strips() {
  static const Mesh mesh = scenes::stripCylinder(30, 0.8, 0.004);
  return mesh;
}

TYPED_TEST(AuditOf, ClosedMeshes) { this->audit(torus(), scenes::icosphere(0.7, 1), 1.6, 15); }

TYPED_TEST(AuditOf, Refitted) {
  for (const double scale : {1e-9, 1.0, 1e9}) {
    this->audit(torus(), scenes::icosphere(0.7, 1), 1.6, 4, scale, 0, 0, true);
    this->audit(torus(), strips(), 1.5, 3, scale, 0, 0, true);
  }
  this->audit(scenes::randomSoup(90, 1, 1e-3, 1, 3), degenerateMesh(60, 3, 5), 2, 5, 1, 0, 0, true);
  this->audit(scenes::sheet(2, 2, 8, 8, 0), scenes::sheet(2, 2, 7, 9, 1e-3), 1, 5, 1, 0, 0, true);
}

TYPED_TEST(AuditOf, LongThinTriangles) {
  this->audit(strips(), strips(), 0.4, 10);
  this->audit(torus(), strips(), 1.5, 8);
}

TYPED_TEST(AuditOf, Soups) {
  this->audit(scenes::randomSoup(90, 1, 1e-3, 1, 3), scenes::randomSoup(70, 1, 1e-2, 1, 4), 2, 10);
  this->audit(degenerateMesh(60, 3, 5), scenes::shrunkSoup(torus(), 1e-6, 0.1, 6), 1.5, 6);
}

// Spheres of radius 0: nothing but the pad covers the rounding of their distances.
TYPED_TEST(AuditOf, HeapsOfPoints) { this->audit(heaps(20, 8), heaps(20, 8), 1, 10); }

TYPED_TEST(AuditOf, FlatSheets) {
  this->audit(scenes::sheet(2, 2, 8, 8, 0), scenes::sheet(2, 2, 7, 9, 1e-3), 1, 10);
}

// Boxes around parallel sheets leave no slack: only the pad covers what rounds.
template <typename S>
void auditSheets(const fcl::Vector3d& origin, double stretch, bool unlike = false) {
  // Tilted, so that every coordinate rounds.
  const fcl::Matrix3d tilt =
      Eigen::AngleAxisd(1, fcl::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  const fcl::Transform3d to_origin = Eigen::Translation3d(origin) * fcl::Transform3d(tilt);
  Auditor<S> auditor(scenes::moved(to_origin, unlike ? scenes::sheet(2, 2, 4, 4, 0)
                                                     : scenes::sheet(2, 2, 8, 8, 0)),
                     scenes::moved(to_origin, unlike ? scenes::sheet(0.15, 0.15, 6, 6, 0)
                                                     : scenes::sheet(2, 2, 6, 6, 0)));
  Random random(3);
  for (const fcl::Transform3d& X_A : scenes::randomPoses(30, 2, 11)) {
    const double angle = random.uniform(0, 6), x = random.uniform(0, 3);
    fcl::Transform3d X_AB = fcl::Transform3d::Identity();
    X_AB.linear() = stretch * tilt * Eigen::AngleAxisd(angle, fcl::Vector3d::UnitZ()).matrix() *
                    tilt.transpose();
    X_AB.translation() =
        origin - X_AB.linear() * origin + tilt * fcl::Vector3d(x, 0, random.uniform(0, 0.5));
    EXPECT_TRUE(auditor.search(fcl::Transform3d::Identity(), X_AB));
    EXPECT_TRUE(!origin.isZero() || auditor.search(X_A, X_A * X_AB));
  }
  auditor.least_triangles = unlike ? 100 : 0;
  auditor.expectRight(1000);
}

// Leaves that are split into their triangles.
TYPED_TEST(AuditOf, UnlikeMeshes) {
  const Mesh fine = transformed(torus(), 0.04, fcl::Vector3d::Zero());
  for (const double scale : {1e-9, 1.0, 1e9}) {
    const int poses = scale == 1 ? 8 : 3;
    this->audit(scenes::icosphere(0.7, 0), fine, 1, poses, scale, 0, 0, false, 20);
    this->audit(fine, scenes::randomSoup(40, 1, 1, 1, 3), 1, poses, scale, 0, 0, false, 20);
    this->audit(degenerateMesh(60, 3, 5), fine, 1, poses, scale, 0, 0, false, 1);
    this->audit(fine, strips(), 1, poses, scale, 0, 0, true);  // narrow: not split
  }
  this->audit(scenes::sheet(2, 2, 3, 3, 0), scenes::sheet(0.1, 0.1, 7, 9, 1e-3), 1, 10, 1, 0, 0,
              false, 20);
  this->audit(scenes::sheet(2, 2, 3, 3, 0), fine, 1, 10, 1, 30, 0, false, 20);
}

TYPED_TEST(AuditOf, ParallelSheets) {
  const fcl::Vector3d zero = fcl::Vector3d::Zero();
  const fcl::Vector3d far = (this->kDouble ? 0x1p37 : 0x1p8) * fcl::Vector3d(1, -0.7, 0.9);
  for (const bool unlike : {false, true}) {
    auditSheets<TypeParam>(zero, 1, unlike);
    // The largest stretch that passes for a rotation, or nearly so.
    for (const double e : {-2.8e-5, 2.8e-5}) auditSheets<TypeParam>(zero, 1 + e, unlike);
    // Coordinates of the common frame are rounded by more here than floats are.
    for (const double share : {1.0, 0.3}) auditSheets<TypeParam>(share * far, 1, unlike);
  }
}

TYPED_TEST(AuditOf, RotationsOfSixDigits) {
  this->audit(torus(), strips(), 1.5, 5, 1, 0, 1e-6);
  this->audit(scenes::sheet(2, 2, 8, 8, 0), scenes::sheet(2, 2, 6, 6, 0), 1, 5, 1, 0, 5e-6);
}

TYPED_TEST(AuditOf, AwayFromTheOrigin) {
  this->audit(torus(), strips(), 1.5, 5, 1, this->kDouble ? 1e6 : 1e2);
  const fcl::Vector3d far(this->kDouble ? 1e6 : 1e2, 0, -3);  // in the meshes' own frames
  Auditor<TypeParam> auditor(transformed(torus(), 1, far), transformed(strips(), 1, far));
  for (const fcl::Transform3d& X : scenes::randomPoses(10, 1.5, 13)) {
    const fcl::Transform3d X_B = Eigen::Translation3d(far) * X * Eigen::Translation3d(-far);
    EXPECT_TRUE(auditor.search(fcl::Transform3d::Identity(), X_B));
  }
  auditor.expectRight(500);
}

TYPED_TEST(AuditOf, TinyAndHuge) {
  for (const double scale : {1e-9, 1e9}) this->audit(torus(), strips(), 1.5, 4, scale);
}

TYPED_TEST(AuditOf, DifferentSizes) {
  this->audit(torus(), transformed(torus(), 1e-3, fcl::Vector3d::Zero()), 1, 8);
}

}  // namespace
}  // namespace kios::testing
