// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Searches of the prepared trees against the triangle kernels over all pairs of triangles, which
// are judged in test/triangle.

#include <gtest/gtest.h>

#include "scalars.h"
#include "search/prepared_pair.h"

namespace kios::testing {
namespace {

using engine::TrianglePairIds;
constexpr std::size_t kAll = std::numeric_limits<std::size_t>::max();

/// Counts of poses, by which a test knows that it saw both kinds.
struct Seen {
  int apart = 0, touching = 0;
};

template <typename S>
class Searches {
 public:
  Searches(const Mesh& a, const Mesh& b) : posed_(a, b) {}

  void check(const fcl::Transform3d& X_A, const fcl::Transform3d& X_B, Seen& seen) {
    ASSERT_TRUE(checkIfServed(X_A, X_B, seen));
  }
  /// Returns false if floats can't serve the pair there.
  bool checkIfServed(const fcl::Transform3d& X_A, const fcl::Transform3d& X_B, Seen& seen) {
    if (!posed_.pose(X_A.cast<S>(), X_B.cast<S>())) return false;
    const AllPairs all = posed_.all();
    ++(all.hits.empty() ? seen.apart : seen.touching);
    checkDistance(all);
    checkBounds(all);
    checkErrors(all);
    checkContacts(all);
    const auto found = posed_.pair().distanceOf({all.nearest.first, all.nearest.second});
    way = found.point_b - found.point_a;
    return true;
  }

  fcl::Vector3d way;  ///< from A to B, of the pair that is nearest, in A

 private:
  static constexpr double kEps = std::numeric_limits<double>::epsilon();

  /// Returns the distance if that is less than at_most, else at_most and no ids.
  double distance(double at_most, TrianglePairIds& ids, double rel_err = 0,
                  double abs_err = 0) const {
    engine::PairQuery query;
    query.rel_err = rel_err;
    query.abs_err = abs_err;
    if (at_most < std::numeric_limits<double>::max())
      query.far_enough = query.cullDistance(at_most);
    SearchCounts counts;
    const auto found = engine::nearestTriangles(posed_.pair(), query, counts);
    const bool nearer = found.found() && found.nearest.distance < at_most;
    ids = nearer ? found.ids : TrianglePairIds();
    return nearer ? found.nearest.distance : at_most;
  }

  // The answer is the kernel's for the pair that it names, and no pair is nearer.
  void checkDistance(const AllPairs& all) const {
    TrianglePairIds ids;
    const double d = distance(std::numeric_limits<double>::max(), ids);
    ASSERT_GE(ids.a, 0);
    EXPECT_EQ(d, posed_.pair().distanceOf(ids).distance);
    EXPECT_EQ(d == 0, !all.hits.empty());
    EXPECT_LE(d - all.distance, 16 * kEps *
                                    std::max(all.extent, extentOf(posed_.pair().triangleA(ids.a),
                                                                  posed_.pair().triangleB(ids.b))));
  }

  // A bound on entry is kept if nothing is nearer, and beaten if something is.
  void checkBounds(const AllPairs& all) const {
    const double slack = 32 * kEps * all.extent;
    for (const double factor : {0.5, 1 - 1e-3, 1.0, 1 + 1e-3, 2.0, 1e3}) {
      const double at_most = factor * all.distance;
      if (!(at_most > 0)) continue;
      TrianglePairIds ids;
      const double d = distance(at_most, ids);
      EXPECT_LE(d, at_most);
      EXPECT_EQ(ids.a < 0, d == at_most);
      if (all.distance < at_most - slack) {
        EXPECT_NEAR(d, all.distance, slack);
      } else if (all.distance > at_most + slack) {
        EXPECT_LT(ids.a, 0);
      }
    }
  }

  void checkErrors(const AllPairs& all) const {
    const double slack = 32 * kEps * all.extent;
    for (const double rel_err : {0.0, 1e-6, 0.01, 0.3, 10.0}) {
      for (const double abs_err : {0.0, 1e-3 * all.extent, 0.5 * all.distance}) {
        TrianglePairIds ids;
        const double d = distance(std::numeric_limits<double>::max(), ids, rel_err, abs_err);
        const double error = d - all.distance;
        EXPECT_GE(error, -slack);
        EXPECT_LE(error, std::max(rel_err * all.distance, abs_err) * (1 + 4 * kEps) + slack);
        ASSERT_GE(ids.a, 0);
        EXPECT_EQ(d, posed_.pair().distanceOf(ids).distance);
      }
    }
  }

  void checkContacts(const AllPairs& all) const {
    const auto hitsUpTo = [this](std::size_t limit) {
      SearchCounts counts;
      std::vector<std::pair<int, int>> hits;
      for (const auto& ids : engine::intersectingTriangles(posed_.pair(), limit, counts)) {
        hits.emplace_back(ids.a, ids.b);
      }
      return hits;
    };
    EXPECT_EQ(hitsUpTo(kAll), all.hits);
    for (const std::size_t limit : {std::size_t{1}, std::size_t{2}, std::size_t{5}}) {
      const auto some = hitsUpTo(limit);
      EXPECT_EQ(some.size(), std::min(limit, all.hits.size()));
      EXPECT_TRUE(std::is_sorted(some.begin(), some.end()));
      EXPECT_EQ(std::adjacent_find(some.begin(), some.end()), some.end());
      EXPECT_TRUE(std::includes(all.hits.begin(), all.hits.end(), some.begin(), some.end()));
    }
  }

  PosedPair<S> posed_;
};

KIOS_SCALAR_SUITE(BruteForce);

// Nearly every pair of leaves is as near as any: the frontier and its waiting room overflow.
TYPED_TEST(BruteForce, NestedSpheresOfEqualClearance) {
  Searches<TypeParam> searches(scenes::icosphere(1, 3), scenes::icosphere(1.02, 3));
  Seen seen;
  for (const fcl::Transform3d& X : scenes::randomPoses(2, 1e-3, 7)) {
    searches.check(fcl::Transform3d::Identity(), X, seen);
  }
  EXPECT_EQ(seen.apart + seen.touching, 2);
}

// Coplanar sheets that overlap, in a pose that rounds nothing and in poses that do.
TYPED_TEST(BruteForce, CoplanarSheets) {
  const Mesh a = lattice(7, 1), b = transformed(lattice(5, 1), 1, {0.5, 0.25, 0});
  Searches<TypeParam> searches(a, b);
  Seen seen;
  for (const double dx : {0.0, 0.5, 4.0, 6.5, 6.75, -5.5, -6.0}) {
    fcl::Transform3d X = fcl::Transform3d::Identity();
    X.translation() = fcl::Vector3d(dx, 0.125, 0);
    searches.check(fcl::Transform3d::Identity(), X, seen);
  }
  EXPECT_GE(seen.touching, 5);
  EXPECT_GE(seen.apart, 2);
  for (const fcl::Transform3d& X : scenes::randomPoses(8, 2, 43)) {
    const fcl::Transform3d X_B = X * Eigen::Translation3d(1.25, 0.5, 0);
    searches.check(X, X_B, seen);
  }
}

// Coplanar triangles of which none has a corner in the other.
TYPED_TEST(BruteForce, CoplanarStars) {
  Random random(14);
  Seen seen;
  const auto poses = scenes::randomPoses(60, 2, 51);
  for (int i = 0; i < 60; ++i) {
    std::vector<fcl::Vector3d> p;
    for (int k = 0; k < 6; ++k) {
      const double angle = M_PI / 3 * (k + random.uniform(-0.2, 0.2)), r = random.uniform(0.9, 1.1);
      p.emplace_back(r * std::cos(angle), r * std::sin(angle), 0);
    }
    Searches<TypeParam> searches(scenes::singleTriangle(p[0], p[2], p[4]),
                                 scenes::singleTriangle(p[1], p[3], p[5]));
    searches.check(fcl::Transform3d::Identity(), fcl::Transform3d::Identity(), seen);
    searches.check(poses[i], poses[i], seen);
  }
  EXPECT_GE(seen.touching, 60);
}

// Spikes that stand on a sheet by their tips, all but touching or touching as rounding has it: a
// tip that looks like touching must not hide one that does.
TYPED_TEST(BruteForce, SpikesOnASheet) {
  Random random(15);
  Seen seen;
  for (const fcl::Transform3d& X : scenes::randomPoses(60, 2, 52)) {
    std::vector<Mesh> spikes;
    for (int i = 0; i < 12; ++i) {
      const double x = random.uniform(-0.9, 0.9), y = random.uniform(-0.9, 0.9);
      const fcl::Vector3d tip(x, y, 0);
      spikes.push_back(scenes::singleTriangle(tip, tip + fcl::Vector3d(0.05, 0.02, 0.3),
                                              tip + fcl::Vector3d(-0.03, 0.04, 0.3)));
    }
    Searches<TypeParam> searches(scenes::sheet(2, 2, 5, 5, 0), scenes::merged(spikes));
    searches.check(X, X * Eigen::Translation3d(0, 0, random.uniform(0, 3e-17)), seen);
  }
  EXPECT_GT(seen.touching, 20);
}

// The corner of a large triangle, or of a pair of them, among spikes of one leaf whose tips are
// beyond its plane, or all but: it is met by one spike alone, each in turn.
TYPED_TEST(BruteForce, OneSpikeMeetsALargeTriangle) {
  constexpr int kSpikes = 8;
  for (const bool floor_first : {true, false}) {
    Seen seen;
    for (int i = 0; i < 4 * kSpikes; ++i) {
      const int met = i % kSpikes;
      const double tip = i % 4 < 2 ? -0.05 : 1e-4;
      std::vector<Mesh> spikes;
      for (int k = 0; k < kSpikes; ++k) {
        const double x = 0.1 * (k - met);
        spikes.push_back(scenes::singleTriangle({x, 0, tip}, {x + 0.03, 0, 0.3}, {x, 0.03, 0.3}));
      }
      Mesh floor = scenes::singleTriangle({0, 0.03, 0}, {-5, -8, 0}, {5, -8, 0});
      if (i % 2 == 0) {
        floor =
            scenes::merged({floor, scenes::singleTriangle({5, -8, 0}, {-5, -8, 0}, {0, -9, 0})});
      }
      const Mesh body = scenes::merged(spikes);
      Searches<TypeParam> searches(floor_first ? floor : body, floor_first ? body : floor);
      const fcl::Transform3d X = scenes::randomPoses(1, 2, static_cast<std::uint64_t>(i))[0];
      searches.check(X, X, seen);
    }
    EXPECT_EQ(seen.touching, 2 * kSpikes);
    EXPECT_EQ(seen.apart, 2 * kSpikes);
  }
}

// Sheets that cross at angles down to none.
TYPED_TEST(BruteForce, GrazingSheets) {
  const Mesh a = scenes::sheet(2, 2, 6, 6, 0), b = scenes::sheet(1.5, 1.7, 5, 5, 0);
  Searches<TypeParam> searches(a, b);
  Seen seen;
  const auto poses = scenes::randomPoses(10, 1, 47);
  for (int i = 0; i < 10; ++i) {
    fcl::Transform3d X = fcl::Transform3d::Identity();
    X.linear() =
        Eigen::AngleAxisd(std::pow(10, -i), fcl::Vector3d(1, 0.3, 0).normalized()).matrix();
    X.translation() = fcl::Vector3d(0.1, 0.2, 0.3 * std::pow(10, -i));
    searches.check(fcl::Transform3d::Identity(), X, seen);
    searches.check(poses[i], poses[i] * X, seen);
  }
  EXPECT_GE(seen.touching, 10);
}

// Boxes that touch in a vertex, an edge or a face, at poses that round: by chance a gap of a few
// eps is left, or none.
TYPED_TEST(BruteForce, TouchingBoxes) {
  Random random(12);
  Searches<TypeParam> searches(scenes::subdividedBox({1, 1, 1}, 1),
                               scenes::subdividedBox({1, 1, 1}, 2));
  Seen seen;
  for (const fcl::Transform3d& X : scenes::randomPoses(40, 1, 49)) {
    for (const int shared : {0, 1, 2, 3}) {  // axes along which the boxes overlap
      fcl::Vector3d offset(1, 1, 1);
      for (int c = 0; c < shared; ++c) offset[c] = random.uniform(-0.9, 0.9);
      searches.check(X, X * Eigen::Translation3d(offset), seen);
    }
  }
  EXPECT_GT(seen.apart, 20);
  EXPECT_GT(seen.touching, 20);
}

/// Returns a wedge hanging from the edge between p and q, turned about the edge so that the edge is
/// what is nearest from above (below for `down` = -1).
Mesh wedge(const fcl::Vector3d& p, const fcl::Vector3d& q, double down, Random& random) {
  const fcl::Vector3d third =
      p + random.uniform(-0.5, 1.5) * (q - p) +
      fcl::Vector3d(random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5), -down);
  return scenes::singleTriangle(p, q, third);
}

// Bundles of edges along x, and of as many above them that are turned by next to nothing: float
// can't tell where they are nearest. 29 % of the answers were wrong at 3e-4 rad without the slack
// that the search takes off.
TYPED_TEST(BruteForce, ParallelEdges) {
  Random random(53);
  Seen seen;
  for (int angle = 1; angle <= 9; ++angle) {
    for (int digits = 2; digits <= 7; ++digits) {
      const double gap = std::pow(10, -digits);
      int i = 0;
      for (const fcl::Transform3d& X : scenes::randomPoses(12, 1, angle * 10 + digits)) {
        const double turned = angle == 9 ? 0 : random.uniform(0.3, 3) * std::pow(10, -angle);
        std::vector<Mesh> a, b;
        for (int k = ++i % 2 == 0 ? 1 : 10; k > 0; --k) {
          const double y = 0.3 * k, from = random.uniform(-1.5, -0.5),
                       to = random.uniform(0.5, 1.5);
          a.push_back(wedge({from, y, 0}, {to, y, 0}, 1, random));
          const fcl::Vector3d along(std::cos(turned), std::sin(turned),
                                    random.uniform(-0.3, 0.3) * gap);
          const fcl::Vector3d middle(random.uniform(-0.5, 0.5),
                                     y + random.uniform(-1, 1) * (gap + 0.5 * std::sin(turned)),
                                     gap * random.uniform(1, 1.1));
          b.push_back(wedge(middle - random.uniform(0.5, 1.5) * along,
                            middle + random.uniform(0.5, 1.5) * along, -1, random));
        }
        Searches<TypeParam> searches(scenes::merged(a), scenes::merged(b));
        searches.check(X, X, seen);
      }
    }
  }
  EXPECT_GT(seen.apart, 300);
}

// All lengths from kLeastReach to kLargestReach, near and close: squares of squares of lengths
// over- and underflow there, and provesApart(), in leaf_cull-inl.h, then takes leaves for apart.
TYPED_TEST(BruteForce, AnyScale) {
  const fcl::Vector3d zero = fcl::Vector3d::Zero();
  Seen seen;
  for (int e = -38; e <= 41; e += e == 40 ? 1 : 2) {
    SCOPED_TRACE(e);
    const double scale = std::ldexp(1, e);
    const Mesh ball = transformed(scenes::icosphere(1, 1), scale, zero),
               box = transformed(scenes::subdividedBox({1, 1.5, 2}, 2), scale, zero);
    for (const Mesh* b : {&ball, &box}) {
      Searches<TypeParam> searches(ball, *b);
      for (fcl::Transform3d X : scenes::randomPoses(5, 4, 61)) {
        X.translation() *= scale;
        for (int step = 0; step < 4; ++step) {  // to a hundredth of the distance each
          if (!searches.checkIfServed(fcl::Transform3d::Identity(), X, seen)) break;
          X.translation() -= (1 - 1e-2) * searches.way;
        }
      }
    }
  }
  EXPECT_GT(seen.apart, 800);
}

// Points and segments in the plane of a sheet and above it.
TYPED_TEST(BruteForce, DegenerateTrianglesOnASheet) {
  Random random(10);
  const auto grid = [&random](double step) { return step * std::floor(random.uniform(-8, 9)); };
  Seen seen;
  for (int i = 0; i < 30; ++i) {
    std::vector<Mesh> parts;
    for (int part = 0; part < 12; ++part) {
      const fcl::Vector3d p(grid(0.5), grid(0.5), i % 3 == 0 ? 0.25 : std::abs(grid(0.125)));
      const fcl::Vector3d q = p + fcl::Vector3d(grid(0.25), grid(0.25), i % 2 == 0 ? 0 : 1);
      parts.push_back(part % 2 == 0 ? scenes::singleTriangle(p, p, p)
                                    : scenes::singleTriangle(p, q, 0.5 * (p + q)));
    }
    const Mesh degenerate = scenes::merged(parts);
    Searches<TypeParam> searches(lattice(6, 1), degenerate), among(degenerate, degenerate);
    for (const double z : {0.0, -0.25}) {
      fcl::Transform3d X = fcl::Transform3d::Identity();
      X.translation() = fcl::Vector3d(3, 3, z);
      searches.check(fcl::Transform3d::Identity(), X, seen);
      among.check(fcl::Transform3d::Identity(), X, seen);
    }
  }
  EXPECT_GT(seen.apart, 20);
  EXPECT_GT(seen.touching, 20);
}

// The least ids, first of A, then of B, win among pairs that are exactly equally near.
TYPED_TEST(BruteForce, TiesGoToTheLeastIds) {
  Random random(9);
  for (const int shape : {0, 1, 2}) {
    Mesh a = shape == 1 ? scenes::subdividedBox({4, 4, 4}, 4) : lattice(6, 1);
    Mesh b = shape == 0 ? lattice(5, 1) : scenes::subdividedBox({2, 2, 2}, 2);
    for (Mesh* mesh : {&a, &b}) {  // ids that say nothing about places
      for (std::size_t i = mesh->triangles.size(); i > 1; --i) {
        std::swap(mesh->triangles[i - 1],
                  mesh->triangles[static_cast<std::size_t>(random.unit() * double(i))]);
      }
    }
    for (const bool as_soups : {false, true}) {
      PosedPair<TypeParam> posed(as_soups ? scenes::soup(a) : a, as_soups ? scenes::soup(b) : b);
      for (int i = 0; i < 40; ++i) {
        fcl::Transform3<TypeParam> X = fcl::Transform3<TypeParam>::Identity();
        for (int c = 0; c < 3; ++c) {
          X.translation()[c] = static_cast<TypeParam>(std::floor(random.uniform(-8, 9)));
        }
        ASSERT_TRUE(posed.pose(fcl::Transform3<TypeParam>::Identity(), X));
        const auto all = posed.all();
        SearchCounts counts;
        const auto found = engine::nearestTriangles(posed.pair(), {}, counts);
        EXPECT_EQ(found.nearest.distance, all.distance);
        if (all.distance == 0) continue;
        EXPECT_EQ(found.ids.a, all.nearest.first);
        EXPECT_EQ(found.ids.b, all.nearest.second);
      }
    }
  }
}

}  // namespace
}  // namespace kios::testing
