// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// First contacts in worlds of one dimension, where the configurations in contact are known: several
// bodies slide along x among several obstacles, and meet whenever their intervals of x do.

#include <algorithm>

#include "linkage/robot_cases.h"
#include "shapes.h"

namespace kios::testing {
namespace {

Transform3d along(double x) { return Transform3d(Eigen::Translation3d(x, 0, 0)); }

struct Interval {
  double from, to;
};

/// Bodies cross each other, so that their surfaces meet whenever their intervals do.
struct LineWorld {
  RobotCase robot;
  std::vector<Interval> movers, obstacles;

  explicit LineWorld(const std::vector<double>& speeds) {
    for (const double speed : speeds) {
      robot.addLink(-1, joint(JointType::kPrismatic, {0, 0, 0}, {speed, 0, 0}));
    }
  }
  static BodyGeometry plate(const Interval& x, bool shape, bool upright) {
    const Vector3d size(x.to - x.from, upright ? 0.2 : 1, upright ? 1 : 0.2);
    if (shape) return std::make_shared<fcl::Boxd>(size);
    return modelOf(scenes::subdividedBox(size, 1));
  }
  void addMover(int link, const Interval& x, bool shape) {
    movers.push_back(x);
    links_.push_back(link);
    const int id = robot.addBody(link, plate(x, shape, true), along(0.5 * (x.from + x.to)));
    for (const int other : ids_) robot.ignorePair(other, id);
    ids_.push_back(id);
  }
  void addObstacle(const Interval& x, bool shape) {
    obstacles.push_back(x);
    robot.addBody(-1, plate(x, shape, false), along(0.5 * (x.from + x.to)));
  }
  /// One mesh of several plates.
  void addObstacle(const std::vector<Interval>& parts) {
    std::vector<Mesh> plates;
    for (const Interval& x : parts) {
      obstacles.push_back(x);
      plates.push_back(transformed(scenes::subdividedBox({x.to - x.from, 1, 0.2}, 1), 1,
                                   {0.5 * (x.from + x.to), 0, 0}));
    }
    robot.addBody(-1, modelOf(scenes::merged(plates)));
  }

  /// Returns the first s in [0, 1] of all pairs of a mover and an obstacle; 2 if there is none.
  double first() const {
    double least = 2;
    for (std::size_t i = 0; i < movers.size(); ++i) {
      const double speed = robot.joints[links_[i]].axis.x();
      for (const Interval& o : obstacles) {
        const double a = (o.from - movers[i].to) / speed, b = (o.to - movers[i].from) / speed;
        const double from = std::max(0.0, std::min(a, b)), to = std::max(a, b);
        if (from <= std::min(1.0, to)) least = std::min(least, from);
      }
    }
    return least;
  }
  /// Returns the least distance of any pair at s; 0 or less in contact.
  double gapAt(double s) const {
    double least = 1e9;
    for (std::size_t i = 0; i < movers.size(); ++i) {
      const double moved = s * robot.joints[links_[i]].axis.x();
      for (const Interval& o : obstacles) {
        least =
            std::min(least, std::max(o.from - movers[i].to - moved, movers[i].from + moved - o.to));
      }
    }
    return least;
  }

 private:
  std::vector<int> links_, ids_;
};

struct Tally {
  int clear = 0, contact = 0, unresolved = 0;
};

void expectFirst(const LineWorld& world, double resolution, Tally& tally) {
  constexpr double kRounding = 1e-11;
  const int n = world.robot.linkage.coordinates();
  const Joints q0 = Joints::Zero(n), q1 = Joints::Ones(n);
  MotionRequest request;
  request.first_contact = true;
  request.resolution = resolution;
  const MotionResult answer = checkMotion(world.robot.linkage, q0, q1, request);
  const double first = world.first();
  switch (answer.verdict) {
    case MotionVerdict::kClear:
      ++tally.clear;
      EXPECT_EQ(first, 2);
      break;
    case MotionVerdict::kContact: {
      ++tally.contact;
      EXPECT_LE(answer.from, first + kRounding) << "it is not clear before";
      EXPECT_GE(answer.to, first - kRounding);
      EXPECT_LE(answer.to - answer.from, resolution);
      const Joints q = between(q0, q1, answer.to);
      EXPECT_TRUE(world.robot.meet(answer.body_a, world.robot.linkage.pose(answer.body_a, q),
                                   answer.body_b, world.robot.linkage.pose(answer.body_b, q), 0));
      break;
    }
    case MotionVerdict::kUnresolved: {
      ++tally.unresolved;
      EXPECT_LE(answer.from, first + kRounding);
      EXPECT_LE(answer.to - answer.from, resolution);
      EXPECT_LE(std::min(world.gapAt(answer.from), world.gapAt(answer.to)),
                2 * resolution + kRounding);
      break;
    }
    default:
      ADD_FAILURE() << "no budget was asked for";
  }
  request.first_contact = false;
  const MotionResult any = checkMotion(world.robot.linkage, q0, q1, request);
  if (any.verdict == MotionVerdict::kClear) {
    EXPECT_EQ(first, 2);
  }
  if (any.verdict == MotionVerdict::kContact) {
    EXPECT_LE(world.gapAt(any.to), kRounding);
  }
}

double randomResolution(Random& random) { return std::exp2(-20 * std::pow(random.unit(), 1.5)); }

// What lies within a resolution of each other is what two pairs, or two parts of one, confuse.
LineWorld randomWorld(Random& random, double resolution, bool shapes) {
  std::vector<double> speeds(1 + static_cast<std::size_t>(random.uniform(0, 2)));
  for (double& v : speeds) v = (random.unit() < 0.5 ? -1 : 1) * random.uniform(0.5, 2);
  LineWorld world(speeds);
  const auto isShape = [&] { return shapes && random.unit() < 0.5; };
  const double near = random.uniform(-0.2, 1.4);
  const int movers = 1 + static_cast<int>(random.uniform(0, 3));
  for (int i = 0; i < movers; ++i) {
    const double at = random.uniform(-1, 1) * resolution;
    const int link = static_cast<int>(random.uniform(0, static_cast<double>(speeds.size())));
    world.addMover(link, {at, at + random.uniform(0.01, 0.1)}, isShape());
  }
  const int obstacles = 1 + static_cast<int>(random.uniform(0, 4));
  for (int i = 0; i < obstacles; ++i) {
    const double speed = speeds[i % speeds.size()];
    const auto part = [&] {
      const double at = speed * (near + random.uniform(-2, 2) * resolution);
      return Interval{at, at + random.uniform(0.05, 1) * std::max(1e-3, resolution)};
    };
    if (random.unit() < 0.3) {
      world.addObstacle(std::vector<Interval>{part(), part(), part()});
    } else {
      world.addObstacle(part(), isShape());
    }
  }
  return world;
}

void runWorlds(bool shapes, int count, std::uint64_t seed) {
  Random random(seed);
  Tally tally;
  for (int i = 0; i < count; ++i) {
    const double resolution = randomResolution(random);
    const LineWorld world = randomWorld(random, resolution, shapes);
    SCOPED_TRACE("world " + std::to_string(i) + ", resolution " + std::to_string(resolution));
    expectFirst(world, resolution, tally);
    if (::testing::Test::HasFailure()) return;
  }
  EXPECT_GT(tally.clear, count / 50);
  EXPECT_GT(tally.contact, count / 3);
  EXPECT_LT(tally.unresolved, count / 10);
}

TEST(FirstContacts, OfMeshesAreTheFirst) { runWorlds(false, 6000, 1); }
TEST(FirstContacts, OfMeshesAndShapesAreTheFirst) { runWorlds(true, 3000, 2); }

// A path that begins in contact, leaves it, and comes to the next one within a resolution.
TEST(FirstContacts, OfPathsThatBeginInContact) {
  Tally tally;
  for (const double resolution : {0x1p-20, 0x1p-14, 0x1p-10, 0x1p-6, 0.13}) {
    for (int k = 0; k < 60; ++k) {
      LineWorld world({1.0});
      world.addMover(0, {-0.01, 0}, false);
      const double next = resolution * (0.05 + 0.003 * k);
      world.addObstacle(std::vector<Interval>{{-0.5, 1e-5 * resolution - 0.01},
                                              {next, next + 0.05 * resolution}});
      expectFirst(world, resolution, tally);
    }
  }
  EXPECT_EQ(tally.contact, 300);
}

// They touch at the start, exactly, and part: nothing but the start's own query sees it.
TEST(FirstContacts, AtTheStartAlone) {
  for (const double speed : {0.5, 1.0}) {
    LineWorld world({speed});
    world.addMover(0, {0, 0.0625}, false);
    world.addObstacle({-0.125, 0}, false);
    MotionRequest request;
    request.first_contact = true;
    const MotionResult answer =
        checkMotion(world.robot.linkage, Joints::Zero(1), Joints::Ones(1), request);
    EXPECT_EQ(answer.verdict, MotionVerdict::kContact);
    EXPECT_EQ(answer.from, 0);
    EXPECT_EQ(answer.to, 0);
  }
}

// FCL's GJK sees spheres touch cones that they pass at a small distance; a slab proves they don't.
TEST(FirstContacts, OfShapesHoldNoContradiction) {
  Random random(3);
  int contacts = 0, unresolved = 0;
  for (int i = 0; i < 2000; ++i) {
    const auto sphere = std::make_shared<fcl::Sphered>(random.uniform(0.05, 1));
    const auto cone = std::make_shared<fcl::Coned>(random.uniform(0.05, 1), random.uniform(0.1, 2));
    RobotCase robot = slider(sphere);
    // Along the tangent of the cone's side, at a gap of 1e-12 to 1e-6.
    const double r = cone->radius, h = cone->lz, up = random.uniform(0.1, 0.9);
    const double phi = random.uniform(-3, 3), gap = std::pow(10, random.uniform(-12, -6));
    const Vector3d normal = Vector3d(h * std::cos(phi), h * std::sin(phi), r).normalized();
    const Vector3d tangent(-std::sin(phi), std::cos(phi), 0);
    const Vector3d place =
        Vector3d(r * (1 - up) * std::cos(phi), r * (1 - up) * std::sin(phi), h * (up - 0.5)) +
        (sphere->radius + gap) * normal;
    Eigen::Matrix3d axes;
    axes << tangent, normal, tangent.cross(normal);
    Transform3d X = Transform3d::Identity();
    X.linear() = axes.transpose();
    X.translation() = Vector3d(-1 + 4 * random.uniform(0.1, 0.9), 0, 0) - X.linear() * place;
    robot.addBody(-1, cone, X);
    MotionRequest request;
    request.first_contact = true;
    const MotionResult answer =
        checkMotion(robot.linkage, Joints::Constant(1, -1), Joints::Constant(1, 3), request);
    contacts += answer.verdict == MotionVerdict::kContact ? 1 : 0;
    unresolved += answer.verdict == MotionVerdict::kUnresolved ? 1 : 0;
    EXPECT_LE(answer.counts.queries, 10000) << gap;
    if (gap > 1e-10) {
      EXPECT_EQ(answer.verdict, MotionVerdict::kClear) << gap;
    }
    if (answer.verdict == MotionVerdict::kClear) continue;
    EXPECT_LE(answer.to - answer.from, request.resolution) << gap;
  }
  std::printf("%d in contact and %d unresolved of 2000\n", contacts, unresolved);
}

// Thin bodies are met after pairs that can't be decided, too.
TEST(FirstContacts, AnyContactIsLookedForBesideWhatIsUndecided) {
  Random random(4);
  for (int i = 0; i < 200; ++i) {
    LineWorld world({1.0, 1e-18});
    world.addMover(0, {-0.01, 0}, false);
    const double x = random.uniform(0.1, 0.9), thick = 1e-4;
    world.addObstacle({x, x + thick}, false);
    // A pair that hardly moves touches but for rounding.
    world.robot.addBody(1, LineWorld::plate({0, 0.125}, false, true), along(10));
    world.robot.addBody(-1, LineWorld::plate({0, 0.125}, false, false), along(10.125 + 1e-15));
    const Joints q0 = Joints::Zero(2), q1 = Joints::Ones(2);
    const MotionResult answer = checkMotion(world.robot.linkage, q0, q1);
    EXPECT_EQ(answer.verdict, MotionVerdict::kContact) << i;
    EXPECT_NEAR(answer.to, x, 0.01 + 2 * thick);
  }
}

}  // namespace
}  // namespace kios::testing
