// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "commands.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <sstream>

#include "show.h"
#include "way.h"

namespace kios::robot_tool {

namespace fs = std::filesystem;
using Eigen::VectorXd;

constexpr double kSlack = 1e-4;  // for limits and states that were rounded

void refuse(const std::string& what) { throw std::invalid_argument(what); }

std::string format(const char* how, ...) {
  char text[1024];
  std::va_list values;
  va_start(values, how);
  std::vsnprintf(text, sizeof(text), how, values);
  va_end(values);
  return text;
}

std::string textOf(const VectorXd& q, const char* between) {
  std::string text;
  for (const double x : q) text += (text.empty() ? "" : between) + format("%.9g", x);
  return text;
}

Json listOf(const VectorXd& v) {
  Json list = Json::array();
  for (const double x : v) list.push_back(std::isfinite(x) ? Json(x) : Json());
  return list;
}

double limited(const Robot& robot, const Options& options, Eigen::Index i, double x,
               const std::string& option) {
  const double limit = std::min(std::max(x, robot.lower()[i]), robot.upper()[i]);
  if (options.beyond_limits || x == limit) return x;
  if (std::abs(x - limit) <= kSlack) return limit;
  refuse(option + ": " + robot.joints()[static_cast<std::size_t>(i)] +
         format(" is %.9g, but its limits are %.9g and %.9g; --beyond-limits takes it.", x,
                robot.lower()[i], robot.upper()[i]));
}

namespace {

/// The coordinates of a configuration, whatever they are.
VectorXd valuesOf(const Robot& robot, const std::string& text, const std::string& option) {
  if (text.empty()) return robot.lower().cwiseMax(0.0).cwiseMin(robot.upper());
  for (const std::string& state : robot.states()) {
    if (state == text) return robot.state(text);
  }
  std::vector<double> values;
  std::istringstream stream(text);
  for (std::string item; std::getline(stream, item, ',');) {
    std::size_t end = 0;
    try {
      values.push_back(std::stod(item, &end));
      end = item.find_first_not_of(" \t\r", end) == std::string::npos ? item.size() : end;
    } catch (const std::exception&) {
      end = 0;
    }
    if (end == item.size() && !item.empty()) continue;
    if (text.find_first_not_of("0123456789+-.eE \t") == std::string::npos) {
      refuse(option + ": numbers are parted by commas, as in 0,0.5,-1; it is '" + text + "'.");
    }
    try {
      return robot.state(text);
    } catch (const std::invalid_argument& error) {
      refuse(option + ": " + sentenceOf(error));
    }
  }
  const VectorXd q =
      Eigen::Map<const VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
  if (q.size() != robot.coordinates()) {
    refuse(option + ": it has " + std::to_string(q.size()) + " coordinates, but " + robot.name() +
           " has " + std::to_string(robot.coordinates()) + ".");
  }
  return q;
}

}  // namespace

VectorXd configuration(const Robot& robot, const Options& options, const std::string& text,
                       const std::string& option) {
  const VectorXd q = valuesOf(robot, text, option);
  if (options.beyond_limits || robot.withinLimits(q, kSlack)) return q;
  for (Eigen::Index i = 0; i < q.size(); ++i) limited(robot, options, i, q[i], option);
  return q;
}

std::vector<VectorXd> pathOf(const Robot& robot, const Options& options, std::size_t least) {
  std::vector<VectorXd> path;
  if (options.path.empty()) {
    path.push_back(configuration(robot, options, options.at, "--from"));
    if (least < 2 && options.to.empty()) return path;
    path.push_back(configuration(robot, options, options.to, "--to"));
    return path;
  }
  const std::string& name = options.path;
  std::ifstream file;
  if (name != "-") file.open(name);
  if (name != "-" && (!file || fs::is_directory(name))) refuse(name + ": it can't be read.");
  std::istream& stream = name == "-" ? std::cin : file;
  int number = 0;
  for (std::string line; std::getline(stream, line);) {
    ++number;
    if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
    const std::string place = (name == "-" ? "standard input" : name);
    path.push_back(configuration(robot, options, line, place + ", line " + std::to_string(number)));
  }
  if (path.size() < least) {
    refuse(name + ": it has " + std::to_string(path.size()) + " configurations; at least " +
           std::to_string(least) + " are needed, one a line.");
  }
  return path;
}

std::string sentenceOf(const std::exception& error) {
  constexpr char kLibrary[] = "fcl_kios: ";
  const std::string what = error.what();
  return what.rfind(kLibrary, 0) == 0 ? what.substr(sizeof(kLibrary) - 1) : what;
}

namespace {

/// Loads it, and refuses in words of the command line what the library does in those of its call.
Robot loadInOurWords(const Options& options, const RobotOptions& robot_options) {
  try {
    return loadRobot(options.urdf, options.srdf, robot_options);
  } catch (const std::invalid_argument& error) {
    std::string text = sentenceOf(error);
    const std::string by_library = "in `packages`";
    const std::size_t at = text.find(by_library);
    if (at != std::string::npos) text.replace(at, by_library.size(), "by --package NAME=FOLDER");
    refuse(text);
  }
}

}  // namespace

Robot load(const Options& options) {
  const auto inTwo = [](const std::string& text, const char* must) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos) refuse(std::string(must) + ", but is " + text + ".");
    return std::pair(text.substr(0, equals), text.substr(equals + 1));
  };
  RobotOptions robot_options;
  robot_options.padding = options.padding;
  for (const std::string& package : options.packages) {
    const auto [name, folder] = inTwo(package, "--package must be NAME=FOLDER");
    if (!fs::is_directory(folder)) refuse("--package " + package + ": there is no such folder.");
    robot_options.packages[name] = folder;
  }
  Robot robot = loadInOurWords(options, robot_options);
  for (const std::string& octomap : options.octomaps) {  // first, as scenes may name them
    const auto [name, file] = inTwo(octomap, "--octomap must be NAME=FILE");
    robot.addOctomap(name, file);
  }
  for (const std::string& scene : options.scenes) robot.addScene(scene);
  for (const std::string& warning : robot.warnings()) {
    std::fprintf(stderr, "kios_robot: warning: %s\n", warning.c_str());
  }
  if (options.strict && !robot.warnings().empty()) {
    refuse("there are warnings, which --strict makes errors.");
  }
  return robot;
}

Answer writePage(const Robot& robot, const Options& options, const std::vector<VectorXd>& path) {
  const fs::path folder = fs::absolute(options.html).parent_path();
  if (!fs::is_directory(folder)) refuse("--html: there is no folder " + folder.string() + ".");
  const std::string page =
      showPage(robot, fs::path(options.urdf).stem().string(), path, options.separation);
  std::ofstream file(options.html, std::ios::binary);
  if (!(file << page) || !file.flush()) refuse(options.html + ": the page can't be written.");
  return {{{"html", options.html}, {"bytes", page.size()}},
          options.html + format(": %.1f MB\n", 1e-6 * static_cast<double>(page.size())),
          0};
}

namespace {

/// Answers `one` for --at, or for each line of --path; the status is the largest.
template <typename One>
Answer forEach(const Robot& robot, const Options& options, const One& one) {
  if (options.path.empty()) return one(configuration(robot, options, options.at, "--at"));
  Answer all;
  all.json["configurations"] = Json::array();
  for (const VectorXd& q : pathOf(robot, options, 1)) {
    Answer answer = one(q);
    all.text += answer.text;
    all.status = std::max(all.status, answer.status);
    all.json["configurations"].push_back(std::move(answer.json));
  }
  return all;
}

Json toJson(const RobotClearance& c) {
  if (c.a.empty()) return nullptr;
  Json json = {{"a", c.a},
               {"b", c.b},
               {"element_a", c.element_a},
               {"element_b", c.element_b},
               {"clearance", c.clearance},
               {"lower_bound", c.lower_bound},
               {"point_a", listOf(c.point_a)},
               {"point_b", listOf(c.point_b)},
               {"id_a", c.id_a},
               {"id_b", c.id_b}};
  if (c.gradient.size() > 0) json["gradient"] = listOf(c.gradient);
  return json;
}

}  // namespace

Answer info(const Robot& robot, const Options& /*options*/) {
  Answer answer;
  answer.json = {{"robot", robot.name()},        {"links", robot.links()},
                 {"coordinates", Json::array()}, {"states", Json::object()},
                 {"groups", Json::object()},     {"warnings", robot.warnings()}};
  answer.text = format("%zu links, %d coordinates (radians, metres)\n", robot.links().size(),
                       robot.coordinates());
  const Json lower = listOf(robot.lower()), upper = listOf(robot.upper());
  for (int i = 0; i < robot.coordinates(); ++i) {
    const std::string& name = robot.joints()[static_cast<std::size_t>(i)];
    answer.json["coordinates"].push_back(
        {{"name", name}, {"lower", lower[i]}, {"upper", upper[i]}});
    answer.text +=
        format("  %-32s %.6g to %.6g\n", name.c_str(), robot.lower()[i], robot.upper()[i]);
  }
  for (const std::string& name : robot.groups()) {
    const RobotGroup group = robot.group(name);
    answer.json["groups"][name] = {
        {"joints", group.joints}, {"links", group.links}, {"end_effectors", group.end_effectors}};
    std::string text;
    for (const std::string& joint : group.joints) text += (text.empty() ? "" : ", ") + joint;
    answer.text += format("  group %-26s ", name.c_str()) + text + "\n";
  }
  for (const std::string& name : robot.states()) {
    std::string text;
    try {
      const VectorXd q = robot.state(name);
      answer.json["states"][name] = listOf(q);
      text = textOf(q);
    } catch (const std::exception& error) {
      answer.json["states"][name] = nullptr;
      text = sentenceOf(error);
    }
    answer.text += format("  state %-26s ", name.c_str()) + text + "\n";
  }
  return answer;
}

Answer contact(const Robot& robot, const Options& options) {
  return forEach(robot, options, [&](const VectorXd& q) -> Answer {
    const auto found = robot.contact(q);
    if (!found) return {{{"contact", false}}, "free\n", 0};
    Answer answer;
    answer.status = 1;
    answer.json = {{"contact", true},
                   {"a", found->a},
                   {"b", found->b},
                   {"element_a", found->element_a},
                   {"element_b", found->element_b},
                   {"id_a", found->id_a},
                   {"id_b", found->id_b},
                   {"point", listOf(found->point)}};
    answer.text =
        "contact of " + found->a + " and " + found->b + " at " + textOf(found->point, " ") + "\n";
    if (found->id_a >= 0)
      answer.text += format("  triangle %td of ", found->id_a) + found->a + "\n";
    if (found->id_b >= 0)
      answer.text += format("  triangle %td of ", found->id_b) + found->b + "\n";
    return answer;
  });
}

Answer clearance(const Robot& robot, const Options& options) {
  return forEach(robot, options, [&](const VectorXd& q) {
    Answer answer;
    const auto least = [&](RobotPairs among, const char* name, const char* words) {
      ClearanceRequest clearance_options;
      clearance_options.among = among;
      const RobotClearance c = robot.clearance(q, clearance_options);
      answer.json[name] = toJson(c);
      if (c.a.empty()) {
        answer.text += std::string("no pair is checked ") + words + "\n";
        return;
      }
      answer.text += format("%.9g m %s: ", c.clearance, words) + c.a + " at " +
                     textOf(c.point_a, " ") + ", " + c.b + " at " + textOf(c.point_b, " ") +
                     "\n  d/dq " + textOf(c.gradient) + "\n";
      if (!(c.clearance > 0)) answer.status = 1;
    };
    least(RobotPairs::kObstacles, "to_obstacles", "to obstacles");
    least(RobotPairs::kItself, "to_itself", "to itself");
    answer.json["within"] = Json::array();
    for (const RobotClearance& pair : robot.clearances(q, options.within)) {
      answer.json["within"].push_back(toJson(pair));
      answer.text += format("  %.9g ", pair.clearance) + pair.a + " " + pair.b + "\n";
    }
    return answer;
  });
}

Answer motion(const Robot& robot, const Options& options) {
  const std::vector<VectorXd> path = pathOf(robot, options, 2);
  MotionRequest request;
  request.min_separation = options.separation;
  request.first_contact = options.first;
  const RobotMotion found = Way(path).check(robot, request);
  const bool clear = found.verdict == MotionVerdict::kClear;
  Answer answer;
  answer.status = clear ? 0 : 1;
  answer.json = {{"verdict", nameOf(found.verdict)},
                 {"from", found.from},
                 {"to", found.to},
                 {"configurations", found.counts.configurations},
                 {"narrow_queries", found.counts.narrow_queries}};
  if (clear) {
    answer.text = format("clear, all along: proven by %lld configurations and %lld queries\n",
                         found.counts.configurations, found.counts.narrow_queries);
    return answer;
  }
  answer.json["a"] = found.a;
  answer.json["b"] = found.b;
  answer.text = std::string(nameOf(found.verdict)) + ": " + found.a + " and " + found.b +
                format(" at %.9g to %.9g of the way\n", found.from, found.to);
  return answer;
}

Answer pairs(const Robot& robot, const Options& options) {
  PairRequest pair_options;
  pair_options.max_boxes = options.boxes;
  pair_options.max_seconds = options.seconds;
  const bool terminal = isatty(STDERR_FILENO) != 0;
  if (terminal) {
    pair_options.progress = [](std::size_t settled, std::size_t all) {
      std::fprintf(stderr, "\r%zu of %zu pairs settled ", settled, all);
    };
  }
  const auto all = robot.linkPairs(pair_options);
  if (terminal) std::fputs("\r\033[K", stderr);
  const char* const names[] = {"always", "never", "sometimes", "open"};
  Answer answer;
  answer.json["pairs"] = Json::array();
  for (const LinkPair& pair : all) {
    const char* const verdict = names[static_cast<std::size_t>(pair.verdict)];
    const bool allowed = robot.allowed(pair.a, pair.b), open = pair.verdict == PairVerdict::kOpen;
    if (open) answer.status = 1;
    Json json = {{"a", pair.a},        {"b", pair.b},
                 {"verdict", verdict}, {"adjacent", pair.adjacent},
                 {"allowed", allowed}, {"boxes", pair.boxes}};
    if (pair.q.size() > 0) json["q"] = listOf(pair.q);
    answer.json["pairs"].push_back(std::move(json));
    answer.text += format("%-9s ", verdict) + pair.a + " " + pair.b;
    if (pair.adjacent) answer.text += ", joined by a joint";
    if (pair.verdict == PairVerdict::kNever)
      answer.text += format(", proven by %lld boxes", pair.boxes);
    if (pair.verdict == PairVerdict::kSometimes) {
      answer.text += (allowed ? ", BUT IT IS ALLOWED, at " : ", at ") + textOf(pair.q);
    }
    answer.text += "\n";
  }
  if (options.srdf_out) answer.text = robot.toSrdf(all);
  return answer;
}

Answer show(const Robot& robot, const Options& options) {
  return writePage(robot, options, pathOf(robot, options, 1));
}

}  // namespace kios::robot_tool
