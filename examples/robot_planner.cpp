// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// A six-axis arm reaches from one bay of a shelf into another, by OMPL's RRTConnect. Edges of the
// tree are checked in two ways: proven as a whole by kios::checkMotion(), in the motion validator
// of proving_validator.h, and sampled by OMPL's discrete validator over FCL's OBBRSS with its
// dynamic AABB trees, at OMPL's default of a hundredth of the space's extent and at 0.01 rad.
// Models are built in the time that is measured, and nothing is prepared before. Then every edge of
// the sampled plans is checked: some pass through the shelf between two samples.
//
// With the addon fcl_kios::robot it also plans for a robot from its files (robot_files.cpp).
//
// usage: robot_planner [SEEDS]
//        robot_planner URDF SRDF SCENE FROM TO     (SRDF and SCENE may be -, see robot_files.cpp)
#include <fcl_kios/fcl_kios.h>
#include <ompl/base/ScopedState.h>
#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/base/terminationconditions/IterationTerminationCondition.h>
#include <ompl/geometric/PathGeometric.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>
#include <ompl/util/RandomNumbers.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <set>
#include <stdexcept>
#include <utility>
#include <vector>

#include "proving_validator.h"
#include "shapes.h"

int planFromFiles(int argc, char** argv);  // robot_files.cpp

namespace {

namespace ob = ompl::base;
namespace og = ompl::geometric;
using Space = ob::RealVectorStateSpace;
using Clock = std::chrono::steady_clock;

constexpr int kJoints = 6;

double secondsSince(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

/// A body that stands still, or that joint `link` carries.
struct Part {
  int link;
  shapes::Mesh<double> mesh;
};

/// The joints: each in the frame of the link before, and the axis about which it turns.
struct Axis {
  fcl::Vector3d place, axis;
};
const Axis kAxes[kJoints] = {{{0, 0, 0.1}, {0, 0, 1}}, {{0, 0, 0.15}, {0, 1, 0}},
                             {{0, 0, 0.5}, {0, 1, 0}}, {{0, 0, 0.25}, {0, 0, 1}},
                             {{0, 0, 0.2}, {0, 1, 0}}, {{0, 0, 0.1}, {0, 0, 1}}};

std::vector<Part> parts() {
  std::vector<Part> all;
  const double lengths[kJoints] = {0.12, 0.45, 0.22, 0.18, 0.08, 0.12};
  for (int i = 0; i < kJoints; ++i) {
    Part part = {i, {}};
    const double width = 0.1 - 0.01 * i;
    shapes::addBox<double>(part.mesh, {width, width, lengths[i]}, {0, 0, 0.5 * lengths[i]}, 10);
    all.push_back(part);
  }
  // A shelf around the arm's front: thin boards, a back, and posts.
  Part shelf = {-1, {}};
  for (const double z : {0.02, 0.42, 0.82}) {
    shapes::addBox<double>(shelf.mesh, {0.4, 1.2, 0.004}, {0.62, 0, z}, 24);
  }
  shapes::addBox<double>(shelf.mesh, {0.004, 1.2, 0.8}, {0.82, 0, 0.42}, 24);
  for (const double y : {-0.6, -0.02, 0.6}) {
    shapes::addBox<double>(shelf.mesh, {0.01, 0.01, 0.8}, {0.43, y, 0.42}, 12);
  }
  all.push_back(shelf);
  Part ring = {-1, shapes::bumpyTorus<double>(0.16, 0.03, 80, 30)};
  for (auto& p : ring.mesh.vertices) p += fcl::Vector3d(0.3, -0.5, 0.6);
  all.push_back(ring);
  return all;
}

/// Links that touch each other at their joints, or that sit on one.
bool adjacent(int a, int b) { return a >= 0 && b >= 0 && std::abs(a - b) <= 2; }

template <typename BV>
std::shared_ptr<fcl::BVHModel<BV>> modelOf(const shapes::Mesh<double>& mesh) {
  auto model = std::make_shared<fcl::BVHModel<BV>>();
  if (model->beginModel() != fcl::BVH_OK ||
      model->addSubModel(mesh.vertices, mesh.triangles) != fcl::BVH_OK ||
      model->endModel() != fcl::BVH_OK) {
    throw std::runtime_error("FCL built no model.");
  }
  return model;
}

kios::Linkage linkageOf(const std::vector<Part>& parts) {
  kios::Linkage linkage;
  for (int i = 0; i < kJoints; ++i) {
    kios::Joint joint;
    joint.type = kios::JointType::kRevolute;
    joint.X_PJ.translation() = kAxes[i].place;
    joint.axis = kAxes[i].axis;
    linkage.addLink(i - 1, joint);
  }
  for (const Part& part : parts) linkage.addBody(part.link, modelOf<kios::kIOSd>(part.mesh));
  for (std::size_t a = 0; a < parts.size(); ++a) {
    for (std::size_t b = a + 1; b < parts.size(); ++b) {
      if (adjacent(parts[a].link, parts[b].link)) {
        linkage.ignorePair(static_cast<int>(a), static_cast<int>(b));
      }
    }
  }
  return linkage;
}

/// FCL's scene over OBBRSS, for one configuration at a time.
class Sampler {
 public:
  explicit Sampler(const std::vector<Part>& parts) : parts_(parts) {
    for (const Part& part : parts) {
      objects_.push_back(std::make_unique<fcl::CollisionObjectd>(modelOf<fcl::OBBRSSd>(part.mesh)));
      objects_.back()->setUserData(const_cast<Part*>(&part));
      (part.link < 0 ? still_ : moving_).registerObject(objects_.back().get());
    }
    moving_.setup();
    still_.setup();
  }

  bool isFree(const ob::State* state) {
    const double* const q = state->as<Space::StateType>()->values;
    fcl::Transform3d X[kJoints];
    for (int i = 0; i < kJoints; ++i) {
      X[i] = (i == 0 ? fcl::Transform3d::Identity() : X[i - 1]) *
             fcl::Translation3d(kAxes[i].place) * fcl::AngleAxisd(q[i], kAxes[i].axis);
    }
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      if (parts_[i].link < 0) continue;
      objects_[i]->setTransform(X[parts_[i].link]);
      objects_[i]->computeAABB();
    }
    moving_.update();
    contact_ = false;
    moving_.collide(&still_, this, &Sampler::callback);
    if (!contact_) moving_.collide(this, &Sampler::callback);
    return !contact_;
  }

 private:
  static bool callback(fcl::CollisionObjectd* a, fcl::CollisionObjectd* b, void* data) {
    auto& self = *static_cast<Sampler*>(data);
    const auto linkOf = [](const fcl::CollisionObjectd* object) {
      return static_cast<const Part*>(object->getUserData())->link;
    };
    if (adjacent(linkOf(a), linkOf(b))) return false;
    fcl::CollisionResultd result;
    fcl::collide(a, b, fcl::CollisionRequestd(), result);
    self.contact_ = self.contact_ || result.isCollision();
    return self.contact_;
  }

  const std::vector<Part>& parts_;
  std::vector<std::unique_ptr<fcl::CollisionObjectd>> objects_;
  fcl::DynamicAABBTreeCollisionManagerd moving_, still_;
  bool contact_ = false;
};

struct Plan {
  std::vector<std::vector<double>> states;
  double seconds = 0;  ///< models included
};

/// `step` is the length between samples in joint space, 0 for the proof.
Plan solve(const std::vector<Part>& parts, double step, unsigned seed) {
  ompl::RNG::setSeed(seed);
  auto space = std::make_shared<Space>(kJoints);
  space->setBounds(-2.9, 2.9);
  auto si = std::make_shared<ob::SpaceInformation>(space);
  std::unique_ptr<kios::Linkage> linkage;
  std::unique_ptr<Sampler> sampler;

  const auto begin = Clock::now();
  if (step == 0) {
    linkage = std::make_unique<kios::Linkage>(linkageOf(parts));
    const auto proof = [&](const auto& q0, const auto& q1, const auto& request) {
      return checkMotion(*linkage, q0, q1, request);
    };
    const auto validator = std::make_shared<ProvingValidator>(si, proof);
    si->setStateValidityChecker(
        [validator](const ob::State* state) { return validator->checkMotion(state, state); });
    si->setMotionValidator(validator);
  } else {
    sampler = std::make_unique<Sampler>(parts);
    si->setStateValidityChecker([&](const ob::State* state) { return sampler->isFree(state); });
    si->setStateValidityCheckingResolution(step / space->getMaximumExtent());
  }
  si->setup();
  ob::ScopedState<Space> start(space), goal(space);
  const double from[kJoints] = {0.57, 0.68, 1.95, 0.27, -1.26, 0},
               to[kJoints] = {-0.4, 0.52, 1.55, 0.5, -1.38, 0};
  for (int i = 0; i < kJoints; ++i) {
    start[static_cast<unsigned>(i)] = from[i];
    goal[static_cast<unsigned>(i)] = to[i];
  }
  auto problem = std::make_shared<ob::ProblemDefinition>(si);
  problem->setStartAndGoalStates(start, goal);
  og::RRTConnect planner(si);
  planner.setRange(0.8);
  planner.setProblemDefinition(problem);
  planner.setup();
  ob::IterationTerminationCondition enough(200000);
  static_cast<ob::Planner&>(planner).solve(enough);
  Plan plan;
  plan.seconds = secondsSince(begin);
  if (!problem->hasExactSolution()) return plan;
  for (const ob::State* state : problem->getSolutionPath()->as<og::PathGeometric>()->getStates()) {
    plan.states.emplace_back();
    space->copyToReals(plan.states.back(), state);
  }
  return plan;
}

/// Edges of a plan that aren't clear.
int touchingEdges(const kios::Linkage& linkage, const Plan& plan) {
  int count = 0;
  for (std::size_t i = 1; i < plan.states.size(); ++i) {
    const auto vector = [&](std::size_t k) {
      return Eigen::VectorXd(Eigen::Map<const Eigen::VectorXd>(plan.states[k].data(), kJoints));
    };
    const auto answer = checkMotion(linkage, vector(i - 1), vector(i));
    count += answer.verdict == kios::MotionVerdict::kClear ? 0 : 1;
  }
  return count;
}

}  // namespace

int main(int argc, char** argv) {
#ifdef HAVE_ROBOT
  if (argc > 2) return planFromFiles(argc, argv);
#endif
  const int seeds = argc > 1 ? std::atoi(argv[1]) : 10;
  if (seeds < 1) {
    std::fprintf(stderr, "usage: robot_planner [SEEDS], at least 1\n");
    return 2;
  }
  ompl::msg::setLogLevel(ompl::msg::LOG_NONE);  // it would warn of each new seed
  const std::vector<Part> all = parts();
  const kios::Linkage judge = linkageOf(all);
  const double extent = std::sqrt(kJoints) * 5.8;
  const struct {
    const char* name;
    double step;
  } ways[] = {{"proven, k-IOS", 0},
              {"sampled, OBBRSS, 0.01 rad", 0.01},
              {"sampled, OBBRSS, 1 % of the extent", 0.01 * extent}};
  std::printf("%-36s %6s %10s %10s %8s %9s\n", "", "plans", "median ms", "worst ms", "edges",
              "touching");
  bool right = true;
  for (const auto& way : ways) {
    std::vector<double> times;
    std::size_t edges = 0;
    int touching = 0;
    for (int seed = 1; seed <= seeds; ++seed) {
      const Plan plan = solve(all, way.step, static_cast<unsigned>(seed));
      if (plan.states.empty()) continue;
      times.push_back(1e3 * plan.seconds);
      edges += plan.states.size() - 1;
      touching += touchingEdges(judge, plan);
    }
    right = right && !times.empty() && (way.step > 0 || touching == 0);
    std::sort(times.begin(), times.end());
    std::printf("%-36s %6zu %10.1f %10.1f %8zu %9d\n", way.name, times.size(),
                times.empty() ? 0 : times[times.size() / 2], times.empty() ? 0 : times.back(),
                edges, touching);
  }
  return right ? 0 : 1;
}
