// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// kios_robot range: the least clearance over ranges of joints, or over a path.
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "commands.h"

namespace kios::robot_tool {
namespace {

using Eigen::VectorXd;

/// The ranges of --joint; the other coordinates stay where --at has them.
JointBox boxOf(const Robot& robot, const Options& options) {
  VectorXd q = configuration(robot, options, options.at, "--at");
  for (Eigen::Index i = 0; i < q.size(); ++i) q[i] = limited(robot, options, i, q[i], "--at");
  JointBox box{{q.data(), q.data() + q.size()}, {q.data(), q.data() + q.size()}};
  for (const std::string& joint : options.joints) {
    const std::size_t equals = joint.find('='), dots = joint.find("..", equals);
    const std::string name = joint.substr(0, equals);
    const auto& names = robot.joints();
    const auto at = std::find(names.begin(), names.end(), name) - names.begin();
    if (at == static_cast<std::ptrdiff_t>(names.size())) {
      refuse("--joint " + joint + ": " + robot.name() + " has no coordinate '" + name +
             "'; kios_robot info lists them.");
    }
    double low = robot.lower()[at], high = robot.upper()[at];
    if (equals != std::string::npos) {
      const auto number = [&](const std::string& text) {
        try {
          std::size_t end = 0;
          const double x = std::stod(text, &end);
          if (end == text.size() && std::isfinite(x)) return x;
        } catch (const std::logic_error&) {  // said below
        }
        refuse("--joint must be NAME=LOWER..UPPER, as elbow=-1..2, but is " + joint + ".");
      };
      if (dots == std::string::npos) number("");
      const auto end = [&](const std::string& text) {
        return limited(robot, options, at, number(text), "--joint " + joint);
      };
      low = end(joint.substr(equals + 1, dots - equals - 1));
      high = end(joint.substr(dots + 2));
    }
    box.lower[static_cast<std::size_t>(at)] = low;
    box.upper[static_cast<std::size_t>(at)] = high;
  }
  return box;
}

/// The ends of a range of one joint as a path, for the page: of a whole turn, from -pi to pi.
std::vector<VectorXd> pathOf(const JointBox& box) {
  constexpr double kPi = 3.14159265358979323846;
  std::vector<VectorXd> path(2, VectorXd(static_cast<Eigen::Index>(box.lower.size())));
  int ranges = 0;
  for (std::size_t i = 0; i < box.lower.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    path[0][at] = std::isfinite(box.lower[i]) ? box.lower[i] : -kPi;
    path[1][at] = std::isfinite(box.upper[i]) ? box.upper[i] : kPi;
    ranges += box.lower[i] < box.upper[i] ? 1 : 0;
  }
  if (ranges > 1) refuse("--html shows the range of one joint, or a path.");
  return path;
}

Json finite(double x) { return std::isfinite(x) ? Json(x) : Json(); }

Json toJson(const RobotRange& range) {
  Json json = {{"lower", finite(range.lower)},
               {"upper", finite(range.upper)},
               {"complete", range.complete},
               {"queries", range.queries}};
  if (!range.a.empty()) {
    json["a"] = range.a;
    json["b"] = range.b;
  }
  if (range.at.empty()) return json;
  json["at"] = range.at;
  json["point_a"] = listOf(range.point_a);
  json["point_b"] = listOf(range.point_b);
  return json;
}

std::string toText(const RobotRange& range) {
  std::string text = format("%.9g to %.9g m", range.lower, range.upper);
  if (!range.a.empty()) text += ": " + range.a + " and " + range.b;
  if (!range.at.empty()) {
    text += " at " + textOf(Eigen::Map<const VectorXd>(range.at.data(),
                                                       static_cast<Eigen::Index>(range.at.size())));
  }
  if (!range.complete) text += format(", open after %lld queries", range.queries);
  return text + "\n";
}

}  // namespace

Answer range(const Robot& robot, const Options& options) {
  const bool box = !options.joints.empty();
  std::vector<VectorXd> path;
  JointBox joints;
  if (box) {
    joints = boxOf(robot, options);
  } else {
    path = kios::robot_tool::pathOf(robot, options, 2);
  }
  const RobotRange least = box ? robot.leastClearance(joints, options.range, !options.beyond_limits)
                               : robot.leastClearance(path, options.range);
  Answer answer;
  answer.status = least.lower > 0 ? 0 : 1;
  answer.json = toJson(least);
  answer.text = "least clearance " + toText(least);
  if (options.each) {
    if (path.size() > 2) refuse("--each is of --joint, or of --from and --to.");
    answer.json["pairs"] = Json::array();
    const auto pairs = box ? robot.leastClearances(joints, options.range, !options.beyond_limits)
                           : robot.leastClearances(path[0], path[1], options.range);
    for (const RobotRange& pair : pairs) {
      answer.json["pairs"].push_back(toJson(pair));
      answer.text += "  " + toText(pair);
    }
  }
  if (!options.html.empty()) {
    const Answer page = writePage(robot, options, box ? pathOf(joints) : path);
    answer.json["html"] = page.json["html"];
    answer.text += page.text;
  }
  return answer;
}

}  // namespace kios::robot_tool
