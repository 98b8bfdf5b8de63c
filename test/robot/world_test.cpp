// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// A robot whose surroundings change answers as one that is built anew.

#include <algorithm>
#include <atomic>
#include <cmath>

#include "robot/robot_files.h"
#include "scenes/shapes.h"
#include "together.h"

namespace kios::testing {
namespace {

using Geometry = std::shared_ptr<const fcl::CollisionGeometryd>;

Geometry geometryOf(Random& random) {
  const double r = random.uniform(0.02, 0.15);
  switch (static_cast<int>(random.uniform(0, 5))) {
    case 0:
      return std::make_shared<fcl::Sphered>(r);
    case 1:
      return std::make_shared<fcl::Boxd>(r, 2 * r, 0.5 * r);
    case 2:
      return std::make_shared<fcl::Cylinderd>(r, 2 * r);
    case 3: {
      const scenes::Mesh mesh = scenes::icosphere(r, 1);
      return makeModel(mesh.vertices, mesh.triangles);
    }
    default: {
      auto ball = std::make_shared<fcl::Sphered>(r);
      ball->cost_density = 0;  // of no cost, and not occupied
      ball->threshold_occupied = 2;
      return random.unit() < 0.2 ? Geometry(ball) : std::make_shared<fcl::Boxd>(r, r, r);
    }
  }
}

Transform3d poseOf(Random& random) {
  Transform3d X = Transform3d::Identity();
  Vector3d axis(random.uniform(-1, 1), random.uniform(-1, 1), 0.5);
  X.linear() = Eigen::AngleAxisd(random.uniform(-3, 3), axis.normalized()).matrix();
  X.translation() << random.uniform(-0.9, 0.9), random.uniform(-0.9, 0.9), random.uniform(0, 1.4);
  if (random.unit() < 0.02) X.translation() *= 1e9;
  return X;
}

/// What a robot was told, by which another one is built.
struct World {
  struct Thing {
    std::string name, link;  ///< empty: an obstacle
    Geometry geometry;
    Transform3d X = Transform3d::Identity();
    std::vector<std::string> touch;
    double padding = 0;
  };
  std::vector<Thing> things;
  std::set<std::pair<std::string, std::string>> ignored;
  std::map<std::string, double> of_links;

  Robot build(const Robot& base) const {
    Robot robot = base;
    for (const Thing& thing : things) {
      if (thing.link.empty()) {
        robot.addObstacle(thing.name, thing.geometry, thing.X);
      } else {
        robot.attach(thing.name, thing.link, thing.geometry, thing.X, thing.touch);
      }
      if (thing.padding > 0) robot.setPadding(thing.name, thing.padding);
    }
    for (const auto& [a, b] : ignored) robot.ignorePair(a, b);
    for (const auto& [link, padding] : of_links) robot.setPadding(link, padding);
    return robot;
  }
  void forget(const std::string& name) {
    for (auto at = ignored.begin(); at != ignored.end();) {
      at = at->first == name || at->second == name ? ignored.erase(at) : std::next(at);
    }
    // What may touch it no longer does, if it comes again.
    for (Thing& thing : things) {
      auto& touch = thing.touch;
      touch.erase(std::remove(touch.begin(), touch.end(), name), touch.end());
    }
  }
};

void expectSame(const Robot& robot, const Robot& fresh, const VectorXd& q, const VectorXd& to) {
  const auto names = [](const Robot& of) {
    std::vector<std::string> all;
    for (const RobotElement& element : of.elements()) {
      all.push_back(element.name + (element.attached ? " attached" : ""));
    }
    return all;
  };
  ASSERT_EQ(names(robot), names(fresh));
  const auto contact = robot.contact(q);
  ASSERT_EQ(contact.has_value(), fresh.contact(q).has_value());
  const std::vector<RobotClearance> all = robot.clearances(q, 0.3),
                                    other = fresh.clearances(q, 0.3);
  ASSERT_EQ(all.size(), other.size());
  std::map<std::pair<std::string, std::string>, double> expected;
  for (const RobotClearance& pair : other) expected[{pair.a, pair.b}] = pair.clearance;
  for (const RobotClearance& pair : all) {
    const auto known = expected.find({pair.a, pair.b});
    ASSERT_TRUE(known != expected.end()) << pair.a << " " << pair.b;
    EXPECT_EQ(pair.clearance, known->second) << pair.a << " " << pair.b;
  }
  if (contact) {
    ASSERT_TRUE(expected.count({contact->a, contact->b}) == 1) << contact->a << " " << contact->b;
    EXPECT_LT((expected[{contact->a, contact->b}]), 1e-6);
  }
  for (const RobotPairs among : {RobotPairs::kAll, RobotPairs::kItself, RobotPairs::kObstacles}) {
    ClearanceRequest request;
    request.among = among;
    EXPECT_EQ(robot.clearance(q, request).clearance, fresh.clearance(q, request).clearance);
  }
  MotionRequest request;
  request.first_contact = true;
  const RobotMotion motion = robot.checkMotion(q, to, request),
                    same = fresh.checkMotion(q, to, request);
  ASSERT_EQ(motion.verdict, same.verdict);
  EXPECT_EQ(motion.counts.pairs, same.counts.pairs);
  if (motion.verdict == MotionVerdict::kContact) {
    EXPECT_NEAR(motion.to, same.to, 1e-5);
    ASSERT_LT(motion.body_a, motion.body_b);
    const std::vector<RobotElement> elements = robot.elements();
    EXPECT_EQ(elements[static_cast<std::size_t>(motion.body_a)].name, motion.a);
    EXPECT_EQ(elements[static_cast<std::size_t>(motion.body_b)].name, motion.b);
  }
  RangeRequest range;
  range.rel_err = 0.05;
  range.abs_err = 1e-3;
  const RobotRange least = robot.leastClearance(q, to, range),
                   again = fresh.leastClearance(q, to, range);
  EXPECT_LE(least.lower, again.upper + 1e-9);
  EXPECT_LE(again.lower, least.upper + 1e-9);
  EXPECT_EQ(least.complete, again.complete);
}

VectorXd configuration(const Robot& robot, Random& random) {
  VectorXd q(robot.coordinates());
  for (int k = 0; k < q.size(); ++k) {
    q[k] = std::clamp(random.uniform(-1.5, 1.5), robot.lower()[k], robot.upper()[k]);
  }
  q[0] *= 0.2;
  q[1] *= 0.2;
  return q;
}

void changeAtRandom(std::uint64_t seed, int steps, bool padded) {
  Random random(seed);
  const Folder folder;
  const Robot base = loadRobot(manyJoints(folder));
  World world;
  Robot robot = base;
  Robot kept = base;  // copies stay as they were
  World kept_world;
  int named = 0;
  const auto pick = [&](bool attached) -> World::Thing* {
    std::vector<World::Thing*> all;
    for (World::Thing& thing : world.things) {
      if (thing.link.empty() != attached) all.push_back(&thing);
    }
    if (all.empty()) return nullptr;
    return all[static_cast<std::size_t>(random.unit() * 0.999 * static_cast<double>(all.size()))];
  };
  const auto anyLink = [&] {
    return robot.links()[static_cast<std::size_t>(random.unit() * 8.99)];
  };
  for (int step = 0; step < steps; ++step) {
    SCOPED_TRACE("seed " + std::to_string(seed) + ", step " + std::to_string(step));
    const VectorXd q = configuration(base, random);
    const double what = random.unit();
    if (what < 0.3 || world.things.empty()) {
      World::Thing thing;
      thing.name = "thing" + std::to_string(named++);
      thing.geometry = geometryOf(random);
      thing.X = poseOf(random);
      robot.addObstacle(thing.name, thing.geometry, thing.X);
      world.things.push_back(thing);
    } else if (what < 0.55) {
      if (World::Thing* const thing = pick(false)) {
        thing->X = poseOf(random);
        robot.moveObstacle(thing->name, thing->X);
      }
    } else if (what < 0.65) {
      World::Thing* const thing = pick(random.unit() < 0.3);
      if (thing) {
        const std::string name = thing->name;
        robot.remove(name);
        world.things.erase(world.things.begin() + (thing - world.things.data()));
        world.forget(name);
      }
    } else if (what < 0.75) {
      if (World::Thing* const thing = pick(false)) {
        thing->link = anyLink();
        thing->touch = {anyLink(), "thing1", "not there"};
        thing->X = robot.pose(thing->link, q).inverse() * robot.pose(thing->name, q);
        robot.attachObstacle(thing->name, thing->link, q, thing->touch);
      }
    } else if (what < 0.85) {
      if (World::Thing* const thing = pick(true)) {
        thing->X = robot.pose(thing->name, q);
        thing->link.clear();
        thing->touch.clear();
        robot.detach(thing->name, q);
      }
    } else if (what < 0.95) {
      World::Thing* const thing = pick(random.unit() < 0.3);
      const std::string link = anyLink();
      if (thing && std::count(thing->touch.begin(), thing->touch.end(), link) == 0) {
        const auto pair = std::make_pair(thing->name, link);
        const bool was = world.ignored.count(pair) != 0;
        robot.ignorePair(link, thing->name, !was);
        if (was) {
          world.ignored.erase(pair);
        } else {
          world.ignored.insert(pair);
        }
      }
    } else if (padded) {
      World::Thing* const thing = pick(random.unit() < 0.5);
      const double padding = random.unit() < 0.5 ? 0 : random.unit() < 0.5 ? 0.01 : 0.02;
      if (thing && random.unit() < 0.8) {
        thing->padding = padding;
        robot.setPadding(thing->name, padding);
      } else {
        const std::string link = anyLink();
        world.of_links[link] = padding;
        robot.setPadding(link, padding);
      }
    }
    VectorXd to = q;
    for (double& x : to) x += random.uniform(-0.3, 0.3);
    expectSame(robot, world.build(base), q, to);
    if (step % 17 == 5) {
      kept = robot;
      kept_world = world;
    }
    if (step % 17 == 11) expectSame(kept, kept_world.build(base), q, to);
    if (::testing::Test::HasFatalFailure()) return;
  }
}

TEST(RobotWorld, ChangesAsIfBuiltAnew) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) changeAtRandom(seed, 60, seed % 2 == 0);
}

TEST(RobotWorld, CopiesChangeInThreadsOfTheirOwn) {
  const Folder folder;
  Random random(3);
  Robot robot = loadRobot(manyJoints(folder));
  for (int i = 0; i < 100; ++i) {
    robot.addObstacle("o" + std::to_string(i), geometryOf(random), poseOf(random));
  }
  const VectorXd q = VectorXd::Zero(8);
  const double before = robot.clearance(q).clearance;
  std::vector<std::vector<Transform3d>> places(4);
  for (auto& own : places) {
    for (int i = 0; i < 40; ++i) own.push_back(poseOf(random));
  }
  const auto moveAll = [&](Robot own, std::size_t thread) {
    double sum = 0;
    for (std::size_t i = 0; i < places[thread].size(); ++i) {
      own.moveObstacle("o" + std::to_string(2 * i), places[thread][i]);
      if (i % 8 == 3) own.remove("o" + std::to_string(2 * i + 1));
      if (i % 8 == 4) own = Robot(own);
      sum += own.clearance(q).clearance + (own.checkMotion(q, q).verdict == MotionVerdict::kClear);
    }
    return sum;
  };
  std::vector<double> alone, at_once(places.size());
  for (std::size_t t = 0; t < places.size(); ++t) alone.push_back(moveAll(robot, t));
  std::atomic<int> wrong{0};
  together(static_cast<int>(places.size()), [&](int thread) {
    const auto t = static_cast<std::size_t>(thread);
    at_once[t] = moveAll(robot, t);  // copied here, while others copy and ask
    wrong += robot.clearance(q).clearance == before ? 0 : 1;
  });
  EXPECT_EQ(at_once, alone);
  EXPECT_EQ(wrong, 0);
}

}  // namespace
}  // namespace kios::testing
