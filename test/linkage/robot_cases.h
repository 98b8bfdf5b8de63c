// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "fcl_kios/fcl_kios.h"
#include "scenes/cad_shapes.h"
#include "scenes/random.h"
#include "scenes/shapes.h"

// Linkages at random, and what a path in joint space meets, by means of their own: forward
// kinematics in long double and static queries at many samples.

namespace kios::testing {

using fcl::Transform3d;
using fcl::Vector3d;
using scenes::Mesh;
using scenes::Random;
using Joints = Eigen::VectorXd;
using BodyGeometry = std::shared_ptr<const fcl::CollisionGeometryd>;

inline BodyGeometry modelOf(const Mesh& mesh) { return makeModel(mesh.vertices, mesh.triangles); }

inline BodyGeometry boxOf(double x, double y, double z) {
  return modelOf(scenes::subdividedBox({x, y, z}, 2));
}

inline Transform3d shifted(double x, double y, double z) {
  return Transform3d(Eigen::Translation3d(x, y, z));
}

inline Joint joint(JointType type, const Vector3d& place = Vector3d::Zero(),
                   const Vector3d& axis = Vector3d::UnitZ()) {
  Joint result;
  result.type = type;
  result.X_PJ.translation() = place;
  result.axis = axis;
  return result;
}

inline Joints randomJoints(int count, double far, Random& random) {
  Joints q(count);
  for (double& x : q) x = random.uniform(-far, far);
  return q;
}

inline Vector3d inBall(Random& random) {
  Vector3d v;
  do {
    v = {random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
  } while (v.squaredNorm() > 1 || v.squaredNorm() < 1e-4);
  return v;
}

inline Transform3d randomPose(Random& random, double far) {
  Transform3d X = Transform3d::Identity();
  X.linear() = Eigen::AngleAxisd(random.uniform(-3, 3), inBall(random).normalized()).matrix();
  X.translation() = far * inBall(random);
  return X;
}

/// Returns a joint that slides with a probability, else turns, or at times is fixed. It may mimic
/// one of `known` coordinates.
inline Joint randomJoint(Random& random, double offset, double slides = 0.2, int known = 0,
                         double mimics = 0) {
  Joint result;
  const double type = random.unit();
  result.type = type < slides ? JointType::kPrismatic
                : type < 0.9  ? JointType::kRevolute
                              : JointType::kFixed;
  result.X_PJ = randomPose(random, offset);
  result.axis = random.uniform(0.3, 2) * inBall(random);
  if (known > 0 && random.unit() < mimics) {
    result.coordinate = std::min(static_cast<int>(random.uniform(0, known)), known - 1);
    result.multiplier = random.uniform(-2, 2);
    result.offset = random.uniform(-1, 1);
  }
  return result;
}

inline Joints between(const Joints& q0, const Joints& q1, double s) {
  return s == 1 ? q1 : Joints(q0 + s * (q1 - q0));
}

/// Holds a linkage and all that was put into it.
struct RobotCase {
  struct Body {
    int link;
    BodyGeometry geometry;
    Transform3d X_LB;
  };
  Linkage linkage;
  std::vector<int> parents;
  std::vector<Joint> joints;
  std::vector<Body> bodies;
  std::set<std::pair<int, int>> allowed;

  int addLink(int parent, const Joint& joint) {
    parents.push_back(parent);
    joints.push_back(joint);
    return linkage.addLink(parent, joint);
  }
  int addBody(int link, BodyGeometry geometry, const Transform3d& X_LB = Transform3d::Identity()) {
    bodies.push_back({link, geometry, X_LB});
    return linkage.addBody(link, std::move(geometry), X_LB);
  }
  void ignorePair(int a, int b) {
    allowed.insert(std::minmax(a, b));
    linkage.ignorePair(a, b);
  }
  bool checked(int a, int b) const {
    return bodies[a].link != bodies[b].link && allowed.count(std::minmax(a, b)) == 0;
  }

  /// Returns poses of all bodies at q, each rounded once.
  std::vector<Transform3d> poses(const Joints& q) const {
    using Matrix = Eigen::Matrix<long double, 3, 3>;
    using Vector = Eigen::Matrix<long double, 3, 1>;
    std::vector<Matrix> R;
    std::vector<Vector> t;
    int next = 0;
    const auto valueOf = [&](const Joint& joint) {
      const int k = joint.coordinate < 0 ? next : joint.coordinate;
      next = std::max(next, k + 1);
      return static_cast<long double>(joint.multiplier) * static_cast<long double>(q[k]) +
             static_cast<long double>(joint.offset);
    };
    for (std::size_t i = 0; i < joints.size(); ++i) {
      const Joint& joint = joints[i];
      const bool root = parents[i] < 0;
      const Matrix R_P = root ? Matrix(Matrix::Identity()) : R[parents[i]];
      const Vector t_P = root ? Vector(Vector::Zero()) : t[parents[i]];
      Matrix R_L = R_P * joint.X_PJ.linear().cast<long double>();
      Vector t_L = t_P + R_P * joint.X_PJ.translation().cast<long double>();
      const Vector axis = joint.axis.cast<long double>();
      if (joint.type == JointType::kPrismatic) {
        t_L += R_L * axis * valueOf(joint);
      } else if (joint.type == JointType::kRevolute) {
        const long double angle = axis.norm() * valueOf(joint);
        R_L = (R_L * Eigen::AngleAxis<long double>(angle, axis.normalized()).matrix()).eval();
      }
      R.push_back(R_L);
      t.push_back(t_L);
    }
    std::vector<Transform3d> result;
    for (const Body& body : bodies) {
      Transform3d X = body.X_LB;
      if (body.link >= 0) {
        const Vector at = t[body.link] + R[body.link] * X.translation().cast<long double>();
        const Matrix turned = R[body.link] * X.linear().cast<long double>();
        X.linear() = turned.cast<double>();
        X.translation() = at.cast<double>();
      }
      result.push_back(X);
    }
    return result;
  }

  /// Returns the answer of fcl::collide, or fcl::distance <= separation.
  bool meet(int a, const Transform3d& X_WA, int b, const Transform3d& X_WB,
            double separation) const {
    const auto *first = bodies[a].geometry.get(), *second = bodies[b].geometry.get();
    fcl::CollisionResultd contacts;
    if (fcl::collide(first, X_WA, second, X_WB, fcl::CollisionRequestd(), contacts) > 0)
      return true;
    if (!(separation > 0)) return false;
    fcl::DistanceResultd result;
    result.min_distance = 2 * separation;
    return fcl::distance(first, X_WA, second, X_WB, fcl::DistanceRequestd(), result) <= separation;
  }
  bool meetAt(const Joints& q, double separation = 0) const {
    const auto X = poses(q);
    const int count = static_cast<int>(bodies.size());
    for (int a = 0; a < count; ++a) {
      for (int b = a + 1; b < count; ++b) {
        if (checked(a, b) && meet(a, X[a], b, X[b], separation)) return true;
      }
    }
    return false;
  }
  /// The first of n + 1 samples in contact, by its s; 2 if there is none.
  double firstSample(const Joints& q0, const Joints& q1, int n, double separation = 0) const {
    for (int k = 0; k <= n; ++k) {
      if (meetAt(between(q0, q1, 1.0 * k / n), separation)) return 1.0 * k / n;
    }
    return 2;
  }
};

/// Returns a body that slides along x, and another one that stands, if any, which may come first.
inline RobotCase slider(const BodyGeometry& body, const BodyGeometry& obstacle = nullptr,
                        bool obstacle_first = false) {
  RobotCase robot;
  robot.addLink(-1, joint(JointType::kPrismatic, {0, 0, 0}, {1, 0, 0}));
  if (obstacle && obstacle_first) robot.addBody(-1, obstacle);
  robot.addBody(0, body);
  if (obstacle && !obstacle_first) robot.addBody(-1, obstacle);
  return robot;
}

/// Answers of random paths, of which some must be clear and others not.
struct MotionTally {
  int clear = 0, contact = 0, unresolved = 0;
  int first_unresolved = 0;  ///< of first contacts
  MotionCounts counts;

  void add(const MotionResult& answer) {
    clear += answer.verdict == MotionVerdict::kClear ? 1 : 0;
    contact += answer.verdict == MotionVerdict::kContact ? 1 : 0;
    unresolved += answer.verdict == MotionVerdict::kUnresolved ? 1 : 0;
    counts.configurations += answer.counts.configurations;
    counts.narrow_queries += answer.counts.narrow_queries;
  }
  int all() const { return clear + contact + unresolved; }
  void expectBothKinds() const {
    EXPECT_GT(clear, all() / 10);
    EXPECT_GT(contact, all() / 10);
    std::printf(
        "%d clear, %d in contact, %d unresolved; a path: %.1f configurations, %.1f queries\n",
        clear, contact, unresolved, 1.0 * counts.configurations / all(),
        1.0 * counts.narrow_queries / all());
  }
};

/// Asks for any contact and for the first one, and compares both answers with n + 1 samples.
inline void expectRight(const RobotCase& robot, const Joints& q0, const Joints& q1, int n,
                        MotionTally& tally, double separation = 0) {
  MotionRequest request;
  request.min_separation = separation;
  const MotionResult any = checkMotion(robot.linkage, q0, q1, request);
  request.first_contact = true;
  const MotionResult first = checkMotion(robot.linkage, q0, q1, request);
  tally.add(any);
  tally.first_unresolved += first.verdict == MotionVerdict::kUnresolved ? 1 : 0;
  const double sample = robot.firstSample(q0, q1, n, separation);
  for (const MotionResult& answer : {any, first}) {
    if (answer.verdict == MotionVerdict::kClear) {
      EXPECT_EQ(sample, 2) << "a contact was missed";
      EXPECT_EQ(answer.from, 0);
      EXPECT_EQ(answer.to, 1);
      EXPECT_EQ(answer.body_a, -1);
      continue;
    }
    EXPECT_LE(0, answer.from);
    EXPECT_LE(answer.from, answer.to);
    EXPECT_LE(answer.to, 1);
    EXPECT_LE(answer.to - answer.from, request.resolution);
    ASSERT_LT(answer.body_a, answer.body_b);
    EXPECT_TRUE(robot.checked(answer.body_a, answer.body_b));
    if (answer.verdict != MotionVerdict::kContact) continue;
    const Joints q = between(q0, q1, answer.to);
    EXPECT_TRUE(robot.meet(answer.body_a, robot.linkage.pose(answer.body_a, q), answer.body_b,
                           robot.linkage.pose(answer.body_b, q), separation))
        << "the static query finds no contact at " << answer.to;
  }
  if (first.verdict == MotionVerdict::kContact) {
    EXPECT_GE(sample, first.from) << "an earlier contact";
    EXPECT_NE(any.verdict, MotionVerdict::kClear);
  }
  if (any.verdict == MotionVerdict::kContact) {
    EXPECT_NE(first.verdict, MotionVerdict::kClear);
  }
}

}  // namespace kios::testing
