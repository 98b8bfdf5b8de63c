// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// robot_planner URDF SRDF SCENE FROM TO: RRTConnect for a robot of any number of joints, each edge
// proven. SRDF and SCENE (MoveIt's, in YAML) may be `-`; FROM and TO are group states of the SRDF,
// or numbers between commas. Prints the path, a configuration a line.
#include <fcl_kios/robot/robot.h>
#include <ompl/base/ScopedState.h>
#include <ompl/base/terminationconditions/IterationTerminationCondition.h>
#include <ompl/geometric/PathGeometric.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>
#include <ompl/util/Console.h>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <memory>
#include <sstream>
#include <string>

#include "proving_validator.h"

namespace {

namespace ob = ompl::base;
namespace og = ompl::geometric;
using Eigen::VectorXd;

constexpr double kTurn = 6.283185307179586;  // limits of what has none

VectorXd configuration(const kios::Robot& robot, const std::string& text) {
  if (text.find(',') == std::string::npos) return robot.state(text);
  VectorXd q(robot.coordinates());
  std::istringstream stream(text);
  std::string item;
  for (double& value : q) value = std::getline(stream, item, ',') ? std::stod(item) : 0;
  return q;
}

int plan(const kios::Robot& robot, const VectorXd& from, const VectorXd& to) {
  ompl::msg::setLogLevel(ompl::msg::LOG_NONE);  // stdout is the path's
  const int n = robot.coordinates();
  auto space = std::make_shared<ob::RealVectorStateSpace>();
  for (int i = 0; i < n; ++i) {
    space->addDimension(std::max(robot.lower()[i], -kTurn), std::min(robot.upper()[i], kTurn));
  }
  auto si = std::make_shared<ob::SpaceInformation>(space);
  si->setStateValidityChecker(
      [&](const ob::State* state) { return !robot.contact(coordinates(*si, state)); });
  si->setMotionValidator(std::make_shared<ProvingValidator>(
      si, [&](const VectorXd& q0, const VectorXd& q1, const kios::MotionRequest& request) {
        return robot.checkMotion(q0, q1, request);
      }));
  si->setup();
  ob::ScopedState<> start(space), goal(space);
  for (int i = 0; i < n; ++i) {
    start[static_cast<unsigned>(i)] = from[i];
    goal[static_cast<unsigned>(i)] = to[i];
  }
  auto problem = std::make_shared<ob::ProblemDefinition>(si);
  problem->setStartAndGoalStates(start, goal);
  og::RRTConnect planner(si);
  planner.setRange(1);
  planner.setProblemDefinition(problem);
  planner.setup();
  ob::IterationTerminationCondition enough(200000);
  static_cast<ob::Planner&>(planner).solve(enough);
  if (!problem->hasExactSolution()) {
    std::fprintf(stderr, "robot_planner: no path was found\n");
    return 1;
  }
  auto* const path = problem->getSolutionPath()->as<og::PathGeometric>();
  for (const ob::State* state : path->getStates()) {
    const VectorXd q = coordinates(*si, state);
    for (int i = 0; i < n; ++i) std::printf("%s%.6g", i > 0 ? "," : "", q[i]);
    std::printf("\n");
  }
  return 0;
}

}  // namespace

int planFromFiles(int argc, char** argv) {
  if (argc != 6) {
    std::fprintf(stderr, "usage: robot_planner URDF SRDF SCENE FROM TO\n");
    return 2;
  }
  try {
    const auto file = [&](int i) { return std::string(argv[i]) == "-" ? "" : argv[i]; };
    kios::Robot robot = kios::loadRobot(file(1), file(2));
    if (*file(3) != '\0') robot.addScene(file(3));
    const VectorXd from = configuration(robot, argv[4]), to = configuration(robot, argv[5]);
    for (const VectorXd& q : {from, to}) {
      if (const auto contact = robot.contact(q)) {
        std::fprintf(stderr, "robot_planner: %s and %s are in contact at %s\n", contact->a.c_str(),
                     contact->b.c_str(), argv[q == from ? 4 : 5]);
        return 1;
      }
    }
    return plan(robot, from, to);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "robot_planner: %s\n", error.what());
    return 2;
  }
}
