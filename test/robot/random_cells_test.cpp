// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Robots that carry and meet anything, of any size and anywhere, with paddings and marked solids:
// contacts, clearances, their bounds and motions against fcl::collide and fcl::distance of each
// pair, which other tests judge.

#include <algorithm>
#include <cmath>
#include <map>

#include "not_finite.h"
#include "robot/robot_files.h"
#include "scenes/shapes.h"

namespace kios::testing {
namespace {

using Geometry = std::shared_ptr<const fcl::CollisionGeometryd>;
using Names = std::pair<std::string, std::string>;

int below(Random& random, int n) { return std::min(n - 1, static_cast<int>(random.unit() * n)); }

bool isMesh(const Geometry& geometry) { return geometry->getObjectType() == fcl::OT_BVH; }

Geometry randomMesh(Random& random, double size) {
  const double kind = random.unit();
  scenes::Mesh mesh = scenes::subdividedBox({size, 0.7 * size, 1.2 * size}, 2);
  if (kind < 0.3) {
    mesh = scenes::bumpyTorus(144);
    for (Vector3d& p : mesh.vertices) p *= size;
  } else if (kind < 0.5) {
    mesh = scenes::sheet(size, size, 3, 3, 0);
  }
  const auto model = makeModel(mesh.vertices, mesh.triangles);
  if (kind > 0.7) markSolid(*model);
  return model;
}

Geometry randomShape(Random& random, double size, bool carried) {
  const double thin = random.unit() < 0.2 ? 0 : random.unit();
  const Vector3d n =
      Vector3d(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)).normalized();
  switch (below(random, carried ? 6 : 8)) {
    case 0:
      return std::make_shared<fcl::Boxd>(size, size * thin, size * random.unit());
    case 1:
      return std::make_shared<fcl::Sphered>(size * thin);
    case 2:
      return std::make_shared<fcl::Cylinderd>(size * thin, size);
    case 3:
      return std::make_shared<fcl::Capsuled>(size * thin, size);
    case 4:
      return std::make_shared<fcl::Coned>(size, size * thin);
    case 5:
      return std::make_shared<fcl::Ellipsoidd>(size, 0.5 * size, size * random.uniform(0.1, 1));
    case 6:
      return std::make_shared<fcl::Halfspaced>(n, -size);
    default:
      return std::make_shared<fcl::Planed>(n, -size);
  }
}

/// Holds a robot of two links that fly, one with an arm, and what they carry and meet. Pairs of two
/// shapes are allowed: their contacts are FCL's.
class Case {
 public:
  Case(const Robot& bare, std::uint64_t seed) : robot_(bare), random_(seed) {
    scale_ = random_.unit() < 0.6 ? 1 : std::pow(10, random_.uniform(-6, 6));
    far_ = random_.unit() < 0.7 ? 0 : scale_ * std::pow(10, random_.uniform(0, 6));
    rounding_ = 1e-9 * (scale_ + far_);
    const int carried = 1 + below(random_, 4), obstacles = 1 + below(random_, 7);
    for (int i = 0; i < carried + obstacles; ++i) add(i, i < carried);
    for (const Thing& a : things_) {
      for (const Thing& b : things_) {
        if (a.name < b.name && !isMesh(a.geometry) && !isMesh(b.geometry)) {
          robot_.ignorePair(a.name, b.name);
        }
      }
    }
  }

  void expectRight() {
    for (int i = 0; i < 12; ++i) {
      VectorXd q(robot_.coordinates());
      for (double& x : q) x = random_.uniform(-3, 3);
      for (const int first : {0, 7}) {
        for (int k = 0; k < 3; ++k) q[first + k] = scale_ * random_.uniform(-1.5, 1.5);
        q[first] += far_;
      }
      ask(q);
      if (i < 2) askMotion(q);
    }
  }
  static int contacts;

 private:
  struct Thing {
    std::string name, link;  ///< without a link an obstacle
    Geometry geometry;
    double padding;
  };

  void add(int i, bool carried) {
    const double size = scale_ * std::pow(10, random_.uniform(-1.5, 0.5));
    const Geometry geometry =
        random_.unit() < 0.5 ? randomMesh(random_, size) : randomShape(random_, size, carried);
    const std::string links[] = {"a", "b", "c"}, name = "t" + std::to_string(i);
    const std::string link = carried ? links[below(random_, 3)] : "";
    Transform3d X = shifted(scale_ * random_.uniform(-1, 1), scale_ * random_.uniform(-1, 1),
                            scale_ * random_.uniform(-1, 1));
    if (!carried) X.translation().x() += far_;
    X.rotate(Eigen::AngleAxisd(random_.uniform(-3, 3), Vector3d(0.6, 0, 0.8)));
    if (carried) {
      robot_.attach(name, link, geometry, X);
    } else {
      robot_.addObstacle(name, geometry, X);
    }
    const double u = random_.unit();
    const double padding = u < 0.4   ? 0
                           : u < 0.5 ? 1e-300
                           : u < 0.6 ? 1e-12 * scale_
                                     : scale_ * std::pow(10, random_.uniform(-4, 0));
    robot_.setPadding(name, padding);
    things_.push_back({name, link, geometry, padding});
  }

  /// Asks for each pair; `unsure` where rounding of a shape's distance decides.
  void computeTruth(const VectorXd& q) {
    clearances_.clear();
    touches_ = unsure_ = false;
    for (std::size_t i = 0; i < things_.size(); ++i) {
      for (std::size_t k = i + 1; k < things_.size(); ++k) {
        const Thing &a = things_[i], &b = things_[k];
        if (a.link == b.link || robot_.allowed(a.name, b.name)) continue;
        const Transform3d X_WA = robot_.pose(a.name, q), X_WB = robot_.pose(b.name, q);
        fcl::DistanceResultd distance;
        fcl::CollisionResultd contacts;
        fcl::distance(a.geometry.get(), X_WA, b.geometry.get(), X_WB, fcl::DistanceRequestd(),
                      distance);
        const bool touch = fcl::collide(a.geometry.get(), X_WA, b.geometry.get(), X_WB,
                                        fcl::CollisionRequestd(), contacts) > 0;
        const double separation = a.padding + b.padding,
                     clearance = std::max(0.0, distance.min_distance) - separation;
        touches_ |= separation > 0 ? clearance <= 0 : touch;
        unsure_ |= !(isMesh(a.geometry) && isMesh(b.geometry)) && std::abs(clearance) < rounding_;
        clearances_[{a.name, b.name}] = clearance;
      }
    }
  }
  double least() const {
    double least = kInfinity;
    for (const auto& [names, clearance] : clearances_) least = std::min(least, clearance);
    return least;
  }

  void ask(const VectorXd& q) {
    computeTruth(q);
    const bool contact = robot_.contact(q).has_value();
    contacts += contact ? 1 : 0;
    EXPECT_TRUE(contact == touches_ || unsure_);
    EXPECT_EQ(robot_.contacts(q)[0] != 0, contact);
    const RobotClearance exact = robot_.clearance(q);
    if (!clearances_.empty()) {
      EXPECT_NEAR(exact.clearance, least(), rounding_);
    }
    ClearanceRequest options;
    options.rel_err = random_.unit() < 0.5 ? 0 : random_.uniform(0, 2);
    options.abs_err = random_.unit() < 0.5 ? 0 : scale_ * random_.uniform(0, 0.1);
    if (random_.unit() < 0.5) options.far_enough = scale_ * random_.uniform(-0.2, 1);
    const RobotClearance near = robot_.clearance(q, options);
    EXPECT_LE(near.lower_bound, least() + rounding_);
    EXPECT_GE(near.clearance, least() - rounding_);
    const double within = scale_ * random_.uniform(-0.3, 1);
    const auto listed = robot_.clearances(q, within);
    for (const auto& [names, clearance] : clearances_) {
      if (clearance > within - rounding_) continue;
      EXPECT_TRUE(std::any_of(listed.begin(), listed.end(),
                              [&, &pair = names](const auto& found) {
                                return Names(found.a, found.b) == pair ||
                                       Names(found.b, found.a) == pair;
                              }))
          << names.first << " " << names.second;
    }
  }

  void askMotion(const VectorXd& q0) {
    VectorXd q1 = q0;
    for (double& x : q1) x += random_.uniform(-0.1, 0.1) * std::min(1.0, scale_);
    MotionRequest request;
    request.max_queries = 20000;
    const RobotMotion motion = robot_.checkMotion(q0, q1, request);
    if (motion.verdict == MotionVerdict::kContact) {
      EXPECT_NE(motion.a, motion.b);
      computeTruth(q0 + motion.to * (q1 - q0));
      EXPECT_TRUE(touches_ || unsure_) << motion.a << " " << motion.b;
    }
    if (motion.verdict != MotionVerdict::kClear) return;
    for (int i = 0; i <= 20; ++i) {
      computeTruth(q0 + i / 20.0 * (q1 - q0));
      EXPECT_TRUE(!touches_ || unsure_) << i;
    }
  }

  Robot robot_;
  Random random_;
  std::vector<Thing> things_;
  double scale_ = 1, far_ = 0, rounding_ = 0;
  std::map<Names, double> clearances_;
  bool touches_ = false, unsure_ = false;
};

int Case::contacts = 0;

TEST(RandomCells, AgreeWithAllPairs) {
  const Folder folder;
  const Robot bare = loadRobot(folder.write(
      "r.urdf",
      "<robot name='r'>" + link("w") + link("a") + link("b") + link("c") +
          joint("f", "floating", "w", "a") +
          joint("g", "revolute", "a", "b",
                "<origin xyz='0.3 0 0'/><axis xyz='0 1 0'/><limit lower='-2' upper='2'/>") +
          joint("h", "floating", "w", "c") + "</robot>"));
  constexpr int kCases = 400;
  for (int i = 0; i < kCases && !::testing::Test::HasFailure(); ++i) {
    SCOPED_TRACE(i);
    Case(bare, 1000 + static_cast<std::uint64_t>(i)).expectRight();
  }
  EXPECT_GT(Case::contacts, kCases);
  EXPECT_LT(Case::contacts, 11 * kCases);
}

}  // namespace
}  // namespace kios::testing
