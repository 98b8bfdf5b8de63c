// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The bounds that a proof consists of, each against exact kinematics in long double: what a
// linkage's motion does to distances and to slabs, and how far contents reach.

#include "linkage/configuration.h"
#include "linkage/link_tree.h"
#include "linkage/robot_cases.h"
#include "linkage/slab_motion.h"

namespace kios::testing {
namespace {

using articulated::Configuration;
using articulated::PairMotion;
using articulated::Path;
using articulated::SlabMotion;

Mesh linkMesh(Random& random) {
  const double kind = random.unit(), thin = std::pow(10, random.uniform(-3, 0));
  Mesh mesh = kind < 0.4   ? scenes::bumpyTorus(100)
              : kind < 0.7 ? scenes::subdividedBox({4, 0.3 * thin, 0.2 * thin}, 1)
                           : scenes::icosphere(1, 1);
  if (kind >= 0.7) {  // a spindle, whose middle lies lowest
    for (Vector3d& p : mesh.vertices) p = p.cwiseProduct(Vector3d(2, 0.3 * thin, 0.2 * thin));
  }
  const double size = random.uniform(0.05, 0.3);
  for (Vector3d& p : mesh.vertices) p *= size;
  return mesh;
}

/// Holds two chains on a stem of joints that carry both.
struct TwoChains {
  RobotCase robot;
  Mesh meshes[2];

  explicit TwoChains(Random& random) {
    int stem = -1;
    // One may mimic a joint of its own chain, or of the other one.
    const auto add = [&](int parent) {
      return robot.addLink(parent, randomJoint(random, 0.5, 0.2, robot.linkage.coordinates(), 0.3));
    };
    for (int i = static_cast<int>(random.uniform(0, 3)); i > 0; --i) stem = add(stem);
    for (Mesh& mesh : meshes) {
      int link = stem;
      for (int i = static_cast<int>(random.uniform(1, 5)); i > 0; --i) link = add(link);
      mesh = linkMesh(random);
      robot.addBody(link, modelOf(mesh), randomPose(random, 0.3));
    }
  }
};

// The distance of any two points, one of each body, changes by no more than the bound, which is not
// much more than what happens; and so does any slab.
TEST(LinkageBounds, DistancesAndSlabsChangeByNoMore) {
  Random random(3);
  double largest = 0, largest_swept = 0, largest_slab = 0, largest_between = 0;
  for (int i = 0; i < 3000; ++i) {
    const TwoChains chains(random);
    const Linkage& linkage = chains.robot.linkage;
    const int n = linkage.coordinates();
    Joints q0(n), q1(n);
    for (int k = 0; k < n; ++k) {
      q0[k] = random.uniform(-3, 3);
      q1[k] = q0[k] + std::pow(10, random.uniform(-3, 0.3)) * random.uniform(-1, 1);
    }
    const Path path(linkage.impl(), q0, q1);
    const double s = random.unit();
    const Configuration c(path, s);
    const int shared =
        linkage.impl().shared(chains.robot.bodies[0].link, chains.robot.bodies[1].link);
    const PairMotion motion(c.motion(0, shared), c.motion(1, shared));
    const double pad = path.pad(0, 1);
    const double swept = path.swept(0, shared) + path.swept(1, shared);
    const auto X = chains.robot.poses(between(q0, q1, s));
    const Vector3d n_W = inBall(random).normalized();
    const auto gapAlong = [&](const auto& poses) {
      double low = std::numeric_limits<double>::infinity(), high = -low;
      for (const Vector3d& y : chains.meshes[1].vertices)
        low = std::min(low, n_W.dot(poses[1] * y));
      for (const Vector3d& x : chains.meshes[0].vertices)
        high = std::max(high, n_W.dot(poses[0] * x));
      return low - high;
    };
    const articulated::Pair pair = {0, 1, shared, n_W};
    const SlabMotion of_supports(c, pair, true), between_bodies(c, pair, false);
    Vector3d point;
    const double width = -c.support(1, -n_W, point) - c.support(0, n_W, point),
                 gap_now = gapAlong(X);
    for (const double other : {0.0, 1.0, random.unit()}) {
      const double h = std::abs(other - s);
      const auto Y = chains.robot.poses(between(q0, q1, other));
      const double bound = motion.during(h);
      const double sign = other > s ? 1 : -1;
      for (std::size_t a = 0; a < chains.meshes[0].vertices.size(); a += 7) {
        for (std::size_t b = 0; b < chains.meshes[1].vertices.size(); b += 5) {
          const Vector3d &x = chains.meshes[0].vertices[a], &y = chains.meshes[1].vertices[b];
          const double before = (X[1] * y - X[0] * x).norm(), after = (Y[1] * y - Y[0] * x).norm();
          ASSERT_LE(std::abs(after - before), bound + pad) << i;
          if (bound > 1e-9) largest = std::max(largest, std::abs(after - before) / bound);
          ASSERT_LE(std::abs(after - before), h * swept + pad) << i;
          if (bound > 1e-9) {
            largest_swept = std::max(largest_swept, std::abs(after - before) / (h * swept));
          }
        }
      }
      // The slab is fixed to the link that carries both; there is one in the world if none does.
      if (shared > 0) continue;
      for (const double gap : {0.3, 0.01, 1e-4}) {
        // Anywhere within the time that a slab of this width holds, no more than it was used up.
        const auto used = [&](double width_now, double time, double& most) {
          for (const double part : {1.0, random.unit()}) {
            const double later = std::clamp(s + sign * part * time, 0.0, 1.0);
            const double sum = width_now - gapAlong(chains.robot.poses(between(q0, q1, later)));
            ASSERT_LE(sum, gap + pad) << i;
            most = std::max(most, sum / gap);
          }
        };
        used(width, of_supports.timeFor(gap, sign, 1), largest_slab);
        used(gap_now, between_bodies.timeFor(gap, sign, 1), largest_between);
        const double way = motion.timeFor(gap, 1);
        ASSERT_LE(motion.during(way), gap * (1 + 1e-12));
      }
    }
  }
  std::printf(
      "up to %.3f of the bound of distances happens, %.3f of the one without a configuration, "
      "%.3f of a slab between supports, and %.3f of one between bodies\n",
      largest, largest_swept, largest_slab, largest_between);
  EXPECT_GT(largest, 0.9);
  EXPECT_GT(largest_swept, 0.7);
  EXPECT_GT(largest_slab, 0.8);
  EXPECT_GT(largest_between, 0.8);
}

// |x(s + h) - 2 x(s) + x(s - h)| <= h^2 max |x''|, of every point of a body.
TEST(LinkageBounds, AccelerationsAreNoLarger) {
  Random random(6);
  double largest = 0;
  for (int i = 0; i < 2000; ++i) {
    const TwoChains chains(random);
    const int n = chains.robot.linkage.coordinates();
    Joints q0(n), q1(n);
    for (int k = 0; k < n; ++k) {
      q0[k] = random.uniform(-3, 3);
      q1[k] = q0[k] + random.uniform(-1, 1);
    }
    const Path path(chains.robot.linkage.impl(), q0, q1);
    const Configuration c(path, 0.5);
    for (const double h : {0.5, 0.05}) {
      const auto X = chains.robot.poses(between(q0, q1, 0.5));
      const auto Y = chains.robot.poses(between(q0, q1, 0.5 + h));
      const auto Z = chains.robot.poses(between(q0, q1, 0.5 - h));
      for (int b = 0; b < 2; ++b) {
        const auto& change = c.motion(b, 0).change;
        const double bound = h * h * (change[0] + h * change[1]);
        for (const Vector3d& p : chains.meshes[b].vertices) {
          const double second = (Y[b] * p - 2 * (X[b] * p) + Z[b] * p).norm();
          ASSERT_LE(second, bound + 1e-13) << i;
          if (bound > 1e-6) largest = std::max(largest, second / bound);
        }
      }
    }
  }
  std::printf("up to %.3f of the bound of accelerations happens\n", largest);
  EXPECT_GT(largest, 0.9);
}

TEST(LinkageBounds, SupportsAreFromAboveAndNear) {
  Random random(4);
  for (int i = 0; i < 200; ++i) {
    const bool smooth = i % 2 == 0;
    const Mesh mesh = smooth ? scenes::icosphere(1, 3) : scenes::subdividedBox({2, 0.5, 0.01}, 1);
    const Transform3d X = randomPose(random, 2);
    std::vector<Vector3d> points;
    for (const Vector3d& p : mesh.vertices) points.push_back(X * p);
    const double margin = i % 3 == 0 ? 0.25 : 0;
    const articulated::SupportTable table(points, margin);
    for (int k = 0; k < 300; ++k) {
      Vector3d n = inBall(random).normalized();
      if (k < 26) n = Vector3d(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1 + 1e-9 * (k % 2)).normalized();
      if (k < 50 && k >= 26) n[k % 3] = 0;
      double exact = -std::numeric_limits<double>::infinity();
      for (const Vector3d& p : points) exact = std::max(exact, n.dot(p));
      exact += margin * n.norm();
      Vector3d point;
      const double bound = table.along(n, &point);
      ASSERT_GE(bound, exact);
      EXPECT_LE(bound, exact + (smooth ? 0.03 : 0.3));
      EXPECT_NEAR(n.dot(point), bound, 1e-12);
    }
    EXPECT_EQ(table.along(Vector3d::Zero()), 0);
  }
}

TEST(LinkageBounds, ContentsLieInTheirBallsAndCapsules) {
  Random random(5);
  for (int i = 0; i < 300; ++i) {
    Mesh mesh = i % 3 == 0 ? scenes::randomSoup(5, 1, 0.01, 2, i + 1) : linkMesh(random);
    if (i % 7 == 0) mesh.vertices.resize(1);
    if (i % 11 == 0) mesh.vertices.assign(3, Vector3d(1e6, 2, 3));
    const double margin = i % 2 == 0 ? 0.1 : 0;
    const auto bound = articulated::boundOf(mesh.vertices, margin, 0.1 * inBall(random));
    const Vector3d d = bound.ends[1] - bound.ends[0];
    for (const Vector3d& p : mesh.vertices) {
      EXPECT_LE((p - bound.center).norm() + margin, bound.radius);
      const double t =
          d.squaredNorm() > 0
              ? std::min(1.0, std::max(0.0, d.dot(p - bound.ends[0]) / d.squaredNorm()))
              : 0;
      EXPECT_LE((p - bound.ends[0] - t * d).norm() + margin, bound.capsule_radius);
      EXPECT_LE(p.norm() + margin, bound.reach());
    }
  }
}

}  // namespace
}  // namespace kios::testing
