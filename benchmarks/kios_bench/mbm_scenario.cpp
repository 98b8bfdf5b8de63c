// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// MotionBenchMaker's problems: one planner over three ways to tell whether an edge is free.
#include <fcl/broadphase/broadphase_dynamic_AABB_tree.h>
#include <unistd.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <map>

#include "fcl_kios/fcl_kios.h"
#include "fcl_kios/robot/robot.h"
#include "robot_impl.h"
#include "rrt_connect.h"
#include "scenario.h"

namespace kios::bench {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;
using Eigen::VectorXd;

constexpr double kStep = 0.01;  // of samples, in the largest joint

double secondsSince(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

/// Holds FCL's dynamic AABB trees over OBBRSS, as MoveIt asks them: the robot against itself and
/// against the world.
class ObbrssCell {
 public:
  explicit ObbrssCell(const Robot& robot) : robot_(robot) {
    const auto& arm = *robot.impl().arm;
    for (const auto& body : arm.bodies) {
      add(moving_, body.geometry, arm.links[static_cast<std::size_t>(body.entity)], body.node,
          body.X_LB);
    }
    for (const auto& object : robot.impl().objects) {
      const int node = object.link < 0 ? -1 : arm.tree.nodeOf(object.link);
      for (const auto& element : object.elements) {
        add(node < 0 ? still_ : moving_, element.geometry, object.name, node, object.X * element.X);
      }
    }
    moving_.setup();
    still_.setup();
  }

  bool isFree(const VectorXd& q) {
    const auto& tree = robot_.impl().arm->tree;
    tree.place(q, placed_);
    for (auto& part : parts_) {
      if (part->node < 0) continue;
      part->object.setTransform(placed_[static_cast<std::size_t>(part->node)].pose(part->X));
      part->object.computeAABB();
    }
    moving_.update();
    contact_ = false;
    moving_.collide(this, &ObbrssCell::callback);
    if (!contact_) moving_.collide(&still_, this, &ObbrssCell::callback);
    return !contact_;
  }

 private:
  struct Part {
    std::string name;
    int node;
    fcl::Transform3d X;
    fcl::CollisionObjectd object;
  };

  std::shared_ptr<fcl::CollisionGeometryd> converted(const robot::Geometry& geometry) {
    auto& known = models_[geometry.get()];
    if (known) return known;
    if (geometry->getObjectType() != fcl::OT_BVH) {
      known = std::const_pointer_cast<fcl::CollisionGeometryd>(geometry);
      return known;
    }
    const auto& model = static_cast<const Modeld&>(*geometry);
    auto obbrss = std::make_shared<fcl::BVHModel<fcl::OBBRSSd>>();
    obbrss->beginModel(model.num_tris, model.num_vertices);
    obbrss->addSubModel(
        std::vector<fcl::Vector3d>(model.vertices, model.vertices + model.num_vertices),
        std::vector<fcl::Triangle>(model.tri_indices, model.tri_indices + model.num_tris));
    obbrss->endModel();
    known = obbrss;
    return known;
  }

  void add(fcl::DynamicAABBTreeCollisionManagerd& manager, const robot::Geometry& geometry,
           const std::string& name, int node, const fcl::Transform3d& X) {
    parts_.push_back(std::unique_ptr<Part>(
        new Part{name, node, X, fcl::CollisionObjectd(converted(geometry), X)}));
    parts_.back()->object.setUserData(parts_.back().get());
    manager.registerObject(&parts_.back()->object);
  }

  static bool callback(fcl::CollisionObjectd* a, fcl::CollisionObjectd* b, void* data) {
    auto& self = *static_cast<ObbrssCell*>(data);
    const Part &first = *static_cast<const Part*>(a->getUserData()),
               &second = *static_cast<const Part*>(b->getUserData());
    if (first.node == second.node ||
        self.robot_.impl().allowed.count(robot::namePair(first.name, second.name)) != 0) {
      return false;
    }
    fcl::CollisionResultd result;
    fcl_own::collide(a->collisionGeometry().get(), a->getTransform(), b->collisionGeometry().get(),
                     b->getTransform(), fcl::CollisionRequestd(), result);
    self.contact_ = self.contact_ || result.isCollision();
    return self.contact_;
  }

  const Robot& robot_;
  std::map<const void*, std::shared_ptr<fcl::CollisionGeometryd>> models_;
  std::vector<std::unique_ptr<Part>> parts_;
  std::vector<robot::PlacedLink> placed_;
  fcl::DynamicAABBTreeCollisionManagerd moving_, still_;
  bool contact_ = false;
};

/// Samples in the order of OMPL's discrete validator: the end, then by halves.
template <typename IsFree>
IsFreeEdge sampled(const IsFree& is_free) {
  return [is_free](const VectorXd& q0, const VectorXd& q1) {
    if (!is_free(q1)) return false;
    const int steps =
        static_cast<int>(std::ceil((q1 - q0).template lpNorm<Eigen::Infinity>() / kStep));
    std::vector<std::pair<int, int>> waiting = {{1, steps - 1}};
    for (std::size_t next = 0; next < waiting.size(); ++next) {
      const auto [low, high] = waiting[next];
      if (low > high) continue;
      const int middle = (low + high) / 2;
      if (!is_free(VectorXd(q0 + static_cast<double>(middle) / steps * (q1 - q0)))) return false;
      waiting.emplace_back(low, middle - 1);
      waiting.emplace_back(middle + 1, high);
    }
    return true;
  };
}

/// Finds a problem's start and goal by the robot's coordinates.
bool readRequest(const fs::path& file, const Robot& robot, PlanRequest& request) {
  const YAML::Node root = YAML::LoadFile(file.string());
  request.start = request.goal = VectorXd::Zero(robot.coordinates());
  int found = 0;
  const auto set = [&](VectorXd& q, const YAML::Node& name, const YAML::Node& value) {
    const auto at = std::find(robot.joints().begin(), robot.joints().end(), name.as<std::string>());
    if (at == robot.joints().end()) return;
    q[at - robot.joints().begin()] = value.as<double>();
    ++found;
  };
  const YAML::Node state = root["start_state"]["joint_state"];
  for (std::size_t i = 0; i < state["name"].size(); ++i) {
    set(request.start, state["name"][i], state["position"][i]);
  }
  for (const YAML::Node& joint : root["goal_constraints"][0]["joint_constraints"]) {
    set(request.goal, joint["joint_name"], joint["position"]);
  }
  request.lower = robot.lower();
  request.upper = robot.upper();
  return found == 2 * robot.coordinates();
}

struct Tally {
  const char* name;
  std::vector<double> seconds = {};  ///< of solved problems
  double all_seconds = 0;
  long long edges = 0, path_edges = 0, refuted = 0;
  int solved = 0;
};

double median(std::vector<double> values) {
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

void planAll(const std::string& name, const fs::path& folder, const fs::path& problems,
             const Options& options, Report& report) {
  const int wanted = options.frames > 0 ? options.frames : options.quick ? 7 : 70;
  const auto begin = Clock::now();
  const Robot bare =
      loadRobot((folder / (name + ".urdf")).string(), (folder / (name + ".srdf")).string());
  std::printf("mbm/%s: loaded in %.1f ms\n", name.c_str(), 1e3 * secondsSince(begin));
  std::vector<fs::path> sets;
  for (const auto& entry : fs::directory_iterator(problems)) sets.push_back(entry.path());
  std::sort(sets.begin(), sets.end());
  Tally tallies[] = {{"proven"}, {"sampled_kios"}, {"fcl_obbrss"}};
  int in_contact = 0, asked = 0;
  double first_plan = 0;
  for (int i = 0; i < wanted; ++i) {
    const fs::path& set = sets[static_cast<std::size_t>(i) % sets.size()];
    char number[16];
    std::snprintf(number, sizeof number, "%04d", 1 + i / static_cast<int>(sets.size()));
    const fs::path scene = set / (std::string("scene") + number + ".yaml");
    PlanRequest request;
    request.seconds = options.quick ? 0.2 : 2;
    request.seed = options.seed + static_cast<std::uint64_t>(i);
    if (!fs::exists(scene)) continue;
    if (!readRequest(set / (std::string("request") + number + ".yaml"), bare, request)) continue;
    Robot robot = bare;
    robot.addScene(scene.string());
    ++asked;
    if (robot.contact(request.start) || robot.contact(request.goal)) {
      ++in_contact;
      continue;
    }
    ObbrssCell obbrss(robot);
    const IsFreeEdge proven = [&](const VectorXd& q0, const VectorXd& q1) {
      return robot.checkMotion(q0, q1).verdict == MotionVerdict::kClear;
    };
    const IsFreeEdge ways[] = {proven,
                               sampled([&](const VectorXd& q) { return !robot.contact(q); }),
                               sampled([&](const VectorXd& q) { return obbrss.isFree(q); })};
    for (std::size_t way = 0; way < 3; ++way) {
      Tally& tally = tallies[way];
      const Plan plan = rrtConnect(request, ways[way]);
      if (way == 0 && first_plan == 0) first_plan = plan.seconds;
      tally.edges += plan.edges;
      tally.all_seconds += plan.seconds;
      if (plan.path.empty()) continue;
      ++tally.solved;
      tally.seconds.push_back(plan.seconds);
      for (std::size_t k = 1; k < plan.path.size(); ++k) {
        ++tally.path_edges;
        const RobotMotion judged = robot.checkMotion(plan.path[k - 1], plan.path[k]);
        tally.refuted += judged.verdict == MotionVerdict::kContact ? 1 : 0;
      }
    }
  }
  std::printf("%d problems, %d of them with a start or goal in contact; first plan %.2f ms\n",
              asked, in_contact, 1e3 * first_plan);
  std::printf("%-14s %7s %10s %10s %12s %10s %8s\n", "", "solved", "median ms", "mean ms",
              "edges a s", "path edges", "refuted");
  std::vector<Row> rows;
  const double base = median(tallies[2].seconds);
  for (const Tally& tally : tallies) {
    double sum = 0;
    for (const double s : tally.seconds) sum += s;
    const double mean = tally.solved > 0 ? sum / tally.solved : 0, middle = median(tally.seconds);
    std::printf("%-14s %7d %10.3f %10.3f %12.0f %10lld %8lld\n", tally.name, tally.solved,
                1e3 * middle, 1e3 * mean,
                static_cast<double>(tally.edges) / std::max(tally.all_seconds, 1e-9),
                tally.path_edges, tally.refuted);
    Row row;
    row.scenario = "mbm/" + name;
    row.query = "plan";
    row.bv = tally.name;
    row.frames = static_cast<std::size_t>(asked - in_contact);
    row.seed = options.seed;
    row.times.median_us = 1e6 * middle;
    row.times.ratio_to_fcl_obbrss = middle > 0 ? Maybe(base / middle) : Maybe();
    row.errors.wrong = static_cast<std::size_t>(tally.refuted);
    rows.push_back(row);
  }
  report.addUnprinted(rows);
}

}  // namespace

void runMbm(const Options& options, Report& report) {
  const auto data = findData(options);
  if (!data || !fs::exists(*data / "mbm")) {
    throw Skipped(
        "it needs MotionBenchMaker's robots and problems in DATA/mbm; name DATA by --data");
  }
  const fs::path unpacked =
      fs::temp_directory_path() / ("kios_bench_mbm_" + std::to_string(getpid()));
  struct Remove {
    fs::path path;
    ~Remove() {
      std::error_code error;
      fs::remove_all(path, error);
    }
  } const remove{unpacked};
  for (const char* const name : {"panda", "ur5"}) {
    const fs::path folder = *data / "mbm" / name, into = unpacked / name;
    fs::create_directories(into);
    const std::string command =
        "tar -xjf '" + (folder / "problems.tar.bz2").string() + "' -C '" + into.string() + "'";
    if (std::system(command.c_str()) != 0) throw Skipped("tar couldn't unpack the problems");
    planAll(name, folder, into / "problems", options, report);
  }
}

}  // namespace kios::bench
