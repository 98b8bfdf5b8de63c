// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// A bracket has to pass through a window, by two of OMPL's planners. What they ask, is this state
// valid and what is its clearance, an FCL scene answers, in which the bounding volume is the one
// template parameter. Each planner runs over FCL's OBBRSS and over k-IOS with the same seed: the
// plans must be the same, only the time differs.
//
// usage: ompl_planner [SEED [REPEATS]]
#include <fcl_kios/fcl_kios.h>
#include <ompl/base/ScopedState.h>
#include <ompl/base/samplers/MaximizeClearanceValidStateSampler.h>
#include <ompl/base/spaces/SE3StateSpace.h>
#include <ompl/base/terminationconditions/IterationTerminationCondition.h>
#include <ompl/geometric/PathGeometric.h>
#include <ompl/geometric/planners/est/BiEST.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>
#include <ompl/util/RandomNumbers.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <stdexcept>
#include <vector>

#include "shapes.h"

namespace {

namespace ob = ompl::base;
namespace og = ompl::geometric;
using SE3 = ob::SE3StateSpace;

/// Obstacles in one of FCL's managers, and the robot.
template <typename BV>
class World {
 public:
  World() : robot_(model(bracket())) {
    // A wall at x = 0 with a window of 1.3 x 1.3, and two rings behind it.
    shapes::Mesh<double> wall;
    for (const double side : {-1.0, 1.0}) {
      shapes::addBox<double>(wall, {0.2, 4, 1.35}, {0, 0, 1.325 * side}, 20);
      shapes::addBox<double>(wall, {0.2, 1.35, 1.3}, {0, 1.325 * side, 0}, 20);
    }
    const auto ring = shapes::bumpyTorus<double>(0.9, 0.15, 60, 24);
    fcl::Transform3d upright = fcl::Transform3d::Identity();
    upright.linear() = fcl::AngleAxisd(1.2, fcl::Vector3d::UnitY()).toRotationMatrix();
    obstacles_.emplace_back(model(wall));
    for (const double x : {0.9, 1.6}) {
      upright.translation() = fcl::Vector3d(x, 0.3, 0.2);
      obstacles_.emplace_back(model(ring), upright);
    }
    for (auto& obstacle : obstacles_) manager_.registerObject(&obstacle);
    manager_.setup();
  }

  bool collides(const fcl::Transform3d& X_robot) {
    move(X_robot);
    fcl::DefaultCollisionData<double> data;
    manager_.collide(&robot_, &data, fcl::DefaultCollisionFunction<double>);
    return data.result.isCollision();
  }

  double clearance(const fcl::Transform3d& X_robot) {
    move(X_robot);
    fcl::DefaultDistanceData<double> data;
    manager_.distance(&robot_, &data, fcl::DefaultDistanceFunction<double>);
    return data.result.min_distance;
  }

 private:
  static std::shared_ptr<fcl::BVHModel<BV>> model(const shapes::Mesh<double>& mesh) {
    auto model = std::make_shared<fcl::BVHModel<BV>>();
    if (model->beginModel() != fcl::BVH_OK ||
        model->addSubModel(mesh.vertices, mesh.triangles) != fcl::BVH_OK ||
        model->endModel() != fcl::BVH_OK) {
      throw std::runtime_error("FCL built no model.");
    }
    return model;
  }

  static shapes::Mesh<double> bracket() {
    shapes::Mesh<double> mesh;
    shapes::addBox<double>(mesh, {1, 0.15, 0.15}, {0.25, 0, 0}, 12);
    shapes::addBox<double>(mesh, {0.15, 0.6, 0.15}, {-0.2, 0.3, 0}, 12);
    return mesh;
  }

  void move(const fcl::Transform3d& X_robot) {
    robot_.setTransform(X_robot);
    robot_.computeAABB();
  }

  fcl::CollisionObjectd robot_;
  std::vector<fcl::CollisionObjectd> obstacles_;
  fcl::DynamicAABBTreeCollisionManagerd manager_;
};

/// Counts the questions of a plan, and their answers.
struct Asked {
  long long validity = 0, valid = 0, clearance = 0;
  double sum_of_clearances = 0;
};

/// OMPL's question, handed to the scene. For one thread, as the world's robot moves.
template <typename BV>
class Checker : public ob::StateValidityChecker {
 public:
  Checker(const ob::SpaceInformationPtr& si, World<BV>& world, Asked& asked)
      : ob::StateValidityChecker(si), world_(world), asked_(asked) {
    specs_.clearanceComputationType = ob::StateValidityCheckerSpecs::EXACT;
  }

  bool isValid(const ob::State* state) const override {
    ++asked_.validity;
    const bool valid = si_->satisfiesBounds(state) && !world_.collides(pose(state));
    if (valid) ++asked_.valid;
    return valid;
  }
  double clearance(const ob::State* state) const override {
    ++asked_.clearance;
    const double clearance = world_.clearance(pose(state));
    asked_.sum_of_clearances += clearance;
    return clearance;
  }

 private:
  static fcl::Transform3d pose(const ob::State* state) {
    const auto& s = *state->as<SE3::StateType>();
    const auto& q = s.rotation();
    fcl::Transform3d X = fcl::Transform3d::Identity();
    X.linear() = fcl::Quaterniond(q.w, q.x, q.y, q.z).toRotationMatrix();
    X.translation() = fcl::Vector3d(s.getX(), s.getY(), s.getZ());
    return X;
  }

  World<BV>& world_;
  Asked& asked_;
};

enum class Task { kConnect, kClearance };

struct Plan {
  std::vector<std::vector<double>> states;
  double least_clearance = 0;
  Asked asked;
  double seconds = 0;
};

/// A seed and a number of iterations fix all that a planner does, but for the checker's answers.
template <typename BV>
Plan solve(World<BV>& world, Task task, unsigned seed) {
  ompl::RNG::setSeed(seed);
  auto space = std::make_shared<SE3>();
  ob::RealVectorBounds bounds(3);
  bounds.setLow(-2.5);
  bounds.setHigh(2.5);
  space->setBounds(bounds);
  auto si = std::make_shared<ob::SpaceInformation>(space);
  Plan plan;
  auto checker = std::make_shared<Checker<BV>>(si, world, plan.asked);
  si->setStateValidityChecker(checker);
  si->setStateValidityCheckingResolution(0.02);
  if (task == Task::kClearance) {  // of several samples, the one of most clearance
    si->setValidStateSamplerAllocator([](const ob::SpaceInformation* space_information) {
      return std::make_shared<ob::MaximizeClearanceValidStateSampler>(space_information);
    });
  }
  si->setup();

  ob::ScopedState<SE3> start(space), goal(space);
  start->setXYZ(-1.5, 0.4, -0.5);
  start->rotation().setIdentity();
  goal->setXYZ(2.2, -0.6, 0.6);
  goal->rotation().setAxisAngle(0, 1, 0, 1.5);
  auto problem = std::make_shared<ob::ProblemDefinition>(si);
  problem->setStartAndGoalStates(start, goal, 0.3);

  ob::PlannerPtr planner;
  if (task == Task::kConnect) {
    planner = std::make_shared<og::RRTConnect>(si);
  } else {
    auto tree = std::make_shared<og::BiEST>(si);
    tree->setRange(3);
    planner = tree;
  }
  planner->setProblemDefinition(problem);
  planner->setup();

  ob::IterationTerminationCondition enough(20000);
  const auto begin = std::chrono::steady_clock::now();
  planner->solve(enough);
  plan.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();

  if (problem->hasExactSolution()) {
    const auto asked = plan.asked;
    auto& path = *problem->getSolutionPath()->as<og::PathGeometric>();
    plan.least_clearance = std::numeric_limits<double>::infinity();
    for (const ob::State* state : path.getStates()) {
      plan.states.emplace_back();
      space->copyToReals(plan.states.back(), state);
      plan.least_clearance = std::min(plan.least_clearance, checker->clearance(state));
    }
    plan.asked = asked;
  }
  return plan;
}

/// Both were asked the same of the same states, so not even rounding may differ in the plans; the
/// clearances may, by that.
bool same(const Plan& a, const Plan& b) {
  const double rounding = 1e-14 * static_cast<double>(a.asked.clearance);
  return a.states == b.states && a.asked.validity == b.asked.validity &&
         a.asked.valid == b.asked.valid && a.asked.clearance == b.asked.clearance &&
         std::abs(a.asked.sum_of_clearances - b.asked.sum_of_clearances) <= rounding &&
         std::abs(a.least_clearance - b.least_clearance) <= 1e-14;
}

/// Runs both volumes in turn; false if they don't come to one plan, or to none.
bool compare(const char* name, Task task, unsigned seed, int repeats) {
  World<fcl::OBBRSSd> obbrss;
  World<kios::kIOSd> kios;
  double their_best = 0, our_first = 0, our_best = 0;
  for (int i = 0; i < repeats; ++i) {
    const Plan theirs = solve(obbrss, task, seed), ours = solve(kios, task, seed);
    if (ours.states.empty()) {
      std::fprintf(stderr, "%s, seed %u: no plan\n", name, seed);
      return false;
    }
    if (!same(theirs, ours)) {
      std::fprintf(stderr, "%s, seed %u: the plans differ\n", name, seed);
      return false;
    }
    if (i == 0) {
      std::printf("%-22s %6zu %9lld %10lld %9.3f", name, ours.states.size(), ours.asked.validity,
                  ours.asked.clearance, ours.least_clearance);
      our_first = ours.seconds;  // with the preparation of the models
    }
    their_best = i == 0 ? theirs.seconds : std::min(their_best, theirs.seconds);
    our_best = i == 0 ? ours.seconds : std::min(our_best, ours.seconds);
  }
  std::printf(" %8.1f %8.1f %8.1f\n", 1e3 * their_best, 1e3 * our_first, 1e3 * our_best);
  return true;
}

}  // namespace

int main(int argc, char** argv) {
  const int seed = argc > 1 ? std::atoi(argv[1]) : 1;
  const int repeats = argc > 2 ? std::atoi(argv[2]) : 3;
  if (seed < 1 || repeats < 1) {
    std::fprintf(stderr, "usage: ompl_planner [SEED [REPEATS]], both at least 1\n");
    return 2;
  }
  ompl::msg::setLogLevel(ompl::msg::LOG_NONE);  // it would warn of each new seed
  std::printf("%-22s %6s %9s %10s %9s %8s %8s %8s\n%-22s %6s %9s %10s %9s %8s %8s %8s\n", "", "",
              "asked", "asked", "least", "OBBRSS", "k-IOS", "k-IOS", "planner", "states",
              "validity", "clearance", "clearance", "ms", "first", "ms");
  const auto n = static_cast<unsigned>(seed);
  const bool connected = compare("RRTConnect", Task::kConnect, n, repeats);
  const bool cleared = compare("BiEST, with clearance", Task::kClearance, n, repeats);
  if (connected && cleared) std::printf("the plans are the same, bit for bit\n");
  return connected && cleared ? 0 : 1;
}
