// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The Panda and the UR5 among meshes, boxes and cylinders against FCL's OBBRSS of every pair. Where
// the two differ an oracle in long double says which is right. KIOS_ROBOT_CONFIGURATIONS sets how
// many configurations, of which a tenth begin an edge: 10000 for the full comparison.

#include <cmath>
#include <cstdlib>

#include "robot/robot_files.h"
#include "scenes/mesh.h"
#include "scenes/oracle.h"
#include "shape/shape_oracle.h"

namespace kios::testing {
namespace {

int configurations() {
  const char* const asked = std::getenv("KIOS_ROBOT_CONFIGURATIONS");
  return asked ? std::atoi(asked) : 1000;
}

scenes::Mesh toMesh(const fcl::CollisionGeometryd& geometry) {
  const auto& model = static_cast<const Modeld&>(geometry);
  return {{model.vertices, model.vertices + model.num_vertices},
          {model.tri_indices, model.tri_indices + model.num_tris}};
}

/// All pairs of elements, by FCL.
class BruteForce {
 public:
  explicit BruteForce(const Robot& robot) : robot_(robot), elements_(robot.elements()) {
    for (const RobotElement& element : elements_) {
      geometry_.push_back(element.geometry->getObjectType() == fcl::OT_BVH
                              ? scenes::buildModel<fcl::OBBRSSd>(toMesh(*element.geometry))
                              : std::const_pointer_cast<fcl::CollisionGeometryd>(element.geometry));
    }
    for (std::size_t i = 0; i < elements_.size(); ++i) {
      for (std::size_t k = i + 1; k < elements_.size(); ++k) {
        const RobotElement &a = elements_[i], &b = elements_[k];
        const bool checked = !(a.obstacle && b.obstacle) && a.name != b.name;
        if (checked && !robot.allowed(a.name, b.name)) pairs_.push_back({i, k});
      }
    }
  }

  bool inContact(const VectorXd& q) const { return any(q, &BruteForce::byFcl); }
  bool inContactByOracle(const VectorXd& q) const { return any(q, &BruteForce::byOracle); }

 private:
  struct Pair {
    std::size_t a, b;
  };

  template <typename Test>
  bool any(const VectorXd& q, const Test& test) const {
    std::vector<Transform3d> X;
    for (const RobotElement& element : elements_) {
      X.push_back(robot_.pose(element.name, q) * Transform3d(element.X));
    }
    for (const Pair& pair : pairs_) {
      if ((this->*test)(pair, X[pair.a], X[pair.b])) return true;
    }
    return false;
  }

  bool byFcl(const Pair& pair, const Transform3d& X_WA, const Transform3d& X_WB) const {
    fcl::CollisionResultd result;
    return fcl_own::collide<double>(geometry_[pair.a].get(), X_WA, geometry_[pair.b].get(), X_WB,
                                    fcl::CollisionRequestd(), result) > 0;
  }

  bool byOracle(const Pair& pair, const Transform3d& X_WA, const Transform3d& X_WB) const {
    const auto& a = *elements_[pair.a].geometry;
    const auto& b = *elements_[pair.b].geometry;
    if (b.getObjectType() == fcl::OT_BVH) {
      return scenes::MeshOracle(toMesh(a), toMesh(b)).collide(X_WA, X_WB);
    }
    ShapeSpec spec;
    if (b.getNodeType() == fcl::GEOM_BOX) {
      spec = {Shape::kBox, static_cast<const fcl::Boxd&>(b).side, 0, {}};
    } else {
      const auto& cylinder = static_cast<const fcl::Cylinderd&>(b);
      spec = {Shape::kCylinder, {cylinder.radius, cylinder.lz, 0}, 0, {}};
    }
    const double radius = spec.size.norm();
    const Transform3d X_BA = X_WB.inverse() * X_WA;
    const scenes::Mesh mesh = toMesh(a);
    for (const fcl::Triangle& t : mesh.triangles) {
      ExactTriangle placed;
      double nearest = 1e300, longest = 0;
      for (int i = 0; i < 3; ++i) {
        const Vector3d p = X_BA * mesh.vertices[t[i]];
        placed[i] = p.cast<Real>();
        nearest = std::min(nearest, p.norm());
        longest = std::max(longest, (mesh.vertices[t[i]] - mesh.vertices[t[(i + 1) % 3]]).norm());
      }
      if (nearest < radius + longest && leastLevel(spec, placed, false) <= 0) return true;
    }
    return false;
  }

  const Robot& robot_;
  std::vector<RobotElement> elements_;
  std::vector<std::shared_ptr<fcl::CollisionGeometryd>> geometry_;
  std::vector<Pair> pairs_;
};

/// Boxes, cylinders and a mesh around an arm on a table.
Robot amidObstacles(const std::string& name, const Folder& folder) {
  Robot robot = loadMbm(name);
  Random random(3);
  for (int i = 0; i < 9; ++i) {
    Transform3d X =
        shifted(random.uniform(-0.9, 0.9), random.uniform(-0.9, 0.9), random.uniform(0.1, 1.1));
    X.rotate(Eigen::AngleAxisd(random.uniform(-3, 3), Vector3d::UnitX()));
    std::shared_ptr<const fcl::CollisionGeometryd> geometry;
    if (i % 3 == 0) {
      geometry = std::make_shared<fcl::Boxd>(0.3, random.uniform(0.02, 0.3), 0.2);
    } else if (i % 3 == 1) {
      geometry = std::make_shared<fcl::Cylinderd>(random.uniform(0.02, 0.1), 0.3);
    } else {
      geometry = loadMesh(folder.write("o.obj", boxObj(0.1, 0.05, 0.02 * i)));
    }
    robot.addObstacle("o" + std::to_string(i), geometry, X);
  }
  return robot;
}

struct Counts {
  int contact = 0, differ = 0;
};

void expectSame(bool ours, const BruteForce& brute, const VectorXd& q, Counts& counts) {
  const bool theirs = brute.inContact(q);
  counts.contact += ours ? 1 : 0;
  if (ours == theirs) return;
  ++counts.differ;
  EXPECT_EQ(ours, brute.inContactByOracle(q)) << q.transpose();
}

void expectContactsAsBruteForce(const std::string& name) {
  if (mbmFolder(name).empty()) GTEST_SKIP() << "no MotionBenchMaker data";
  const Folder folder;
  for (const bool alone : {true, false}) {
    const Robot robot = alone ? loadMbm(name) : amidObstacles(name, folder);
    const BruteForce brute(robot);
    Random random(17);
    const int count = configurations() / 2;
    Eigen::MatrixXd q(robot.coordinates(), count);
    for (int i = 0; i < count; ++i) q.col(i) = randomConfiguration(robot, random);
    const std::vector<char> contacts = robot.contacts(q);
    Counts counts;
    for (int i = 0; i < count; ++i) {
      expectSame(contacts[static_cast<std::size_t>(i)] != 0, brute, q.col(i), counts);
    }
    EXPECT_GT(counts.contact, count / 200);
    EXPECT_LT(counts.contact, count);
    std::printf("%s%s: %d of %d in contact, FCL differs in %d\n", name.c_str(),
                alone ? "" : " amid obstacles", counts.contact, count, counts.differ);
  }
}

void expectEdgesAsBruteForce(const std::string& name) {
  if (mbmFolder(name).empty()) GTEST_SKIP() << "no MotionBenchMaker data";
  const Folder folder;
  const Robot robot = amidObstacles(name, folder);
  const BruteForce brute(robot);
  Random random(19);
  Counts counts;
  int clear = 0, contact = 0;
  for (int i = 0; i < configurations() / 10; ++i) {
    VectorXd q0;
    do {
      q0 = randomConfiguration(robot, random);
    } while (robot.contact(q0));
    VectorXd q1 = q0;
    for (int k = 0; k < q1.size(); ++k) q1[k] += random.uniform(-0.4, 0.4);
    const RobotMotion motion = robot.checkMotion(q0, q1);
    if (motion.verdict == MotionVerdict::kClear) {
      ++clear;
      constexpr int kSamples = 40;
      for (int s = 0; s <= kSamples; ++s) {
        expectSame(false, brute, q0 + (1.0 * s / kSamples) * (q1 - q0), counts);
      }
    } else {
      ASSERT_EQ(motion.verdict, MotionVerdict::kContact);
      ++contact;
      expectSame(true, brute, motion.to == 1 ? q1 : VectorXd(q0 + motion.to * (q1 - q0)), counts);
    }
  }
  EXPECT_GT(clear, 5);
  EXPECT_GT(contact, 5);
  std::printf("%s: %d edges clear, %d in contact, FCL differs in %d configurations\n", name.c_str(),
              clear, contact, counts.differ);
}

TEST(RobotBruteForce, PandaContacts) { expectContactsAsBruteForce("panda"); }
TEST(RobotBruteForce, Ur5Contacts) { expectContactsAsBruteForce("ur5"); }
TEST(RobotBruteForce, PandaEdges) { expectEdgesAsBruteForce("panda"); }
TEST(RobotBruteForce, Ur5Edges) { expectEdgesAsBruteForce("ur5"); }

}  // namespace
}  // namespace kios::testing
