// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// What fcl_kios.Robot is made of.
#include "fcl_kios/robot/robot.h"

#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <pybind11/stl.h>

#include "arrays.h"
#include "columns.h"
#include "configurations.h"
#include "files/octomap.h"
#include "mesh.h"
#include "objects.h"
#include "without_gil.h"

namespace kios::python {
namespace {

using Names = std::vector<std::string>;

/// A robot that queries read without the GIL. Changes wait until they have ended.
class AskedRobot {
 public:
  explicit AskedRobot(Robot robot) : robot_(std::move(robot)) {}

  const Robot& robot() const { return robot_; }
  template <typename Ask>
  auto ask(const Ask& question) {
    const Reading reading(&turns_);
    const WithoutGil released;
    return question(robot_);
  }
  template <typename Ask>
  auto askEach(std::size_t n, const BatchOptions& options, const char* what, const Ask& question) {
    const Reading reading(&turns_);
    return runEach(n, options, what, question);
  }
  template <typename Change>
  void change(const Change& how) {
    awaitTurn([this] { return ifRead(turns_); }, "robot");
    how(robot_);
  }
  Turns* turns() { return &turns_; }

 private:
  Robot robot_;
  Turns turns_{};
};

/// Asks what may take long: Ctrl-C ends it at once, and the robot isn't changed until it has ended.
template <typename Ask>
auto askLong(py::object self, const Ask& question) {
  struct Kept {
    py::object self;
    std::invoke_result_t<Ask, const Robot&> answer = {};
  };
  auto& asked = self.cast<AskedRobot&>();
  const auto kept = std::make_shared<Kept>(Kept{std::move(self)});
  readInterruptibly(
      Reading(asked.turns()), kept,
      [kept = kept.get(), robot = &asked.robot(), question] { kept->answer = question(*robot); });
  return std::move(kept->answer);
}

Eigen::VectorXd configuration(py::handle q, const Robot& robot) {
  return Configurations(q, "q", robot).only("q");
}

template <typename Vector>
py::array_t<double> arrayOf(const Vector& v) {
  return py::array_t<double>(static_cast<py::ssize_t>(v.size()), v.data());
}

std::shared_ptr<const fcl::CollisionGeometryd> geometryOf(py::handle geometry) {
  if (py::isinstance<Mesh>(geometry)) return geometry.cast<const Mesh&>().share();
  if (py::isinstance<fcl::CollisionGeometryd>(geometry)) {
    return geometry.cast<std::shared_ptr<fcl::CollisionGeometryd>>();
  }
  throw py::type_error("geometry must be a Mesh or a geometry of fcl_kios.fcl.");
}

fcl::Transform3d poseOf(py::handle X, const char* name) { return Poses(X, name).only(name); }

std::unique_ptr<AskedRobot> loaded(const std::string& urdf, const std::string& srdf,
                                   const std::map<std::string, std::string>& packages,
                                   double padding) {
  const WithoutGil released;
  return std::make_unique<AskedRobot>(loadRobot(urdf, srdf, {packages, padding}));
}

py::object contact(AskedRobot& self, py::handle q) {
  const Eigen::VectorXd at = configuration(q, self.robot());
  const auto found = self.ask([&](const Robot& robot) { return robot.contact(at); });
  if (!found) return py::none();
  return py::make_tuple(found->a, found->b, toArray(found->point), found->element_a,
                        found->element_b, found->id_a, found->id_b);
}

py::object contacts(AskedRobot& self, py::handle q, const BatchOptions& options) {
  const Configurations asked(q, "q", self.robot());
  return column(
      self.askEach(asked.size, options, asked.batch(),
                   [&](std::size_t i) { return self.robot().contact(asked[i]).has_value(); }),
      asked.single);
}

/// Tables of clearances; gradients are NaN where there is no pair.
py::tuple tableOf(const std::vector<RobotClearance>& found, bool single, Eigen::Index k) {
  py::array_t<double> gradients({static_cast<py::ssize_t>(found.size()), py::ssize_t{k}});
  double* to = gradients.mutable_data();
  for (const RobotClearance& c : found) {
    for (Eigen::Index i = 0; i < k; ++i) {
      *to++ = c.gradient.size() == k ? c.gradient[i] : std::numeric_limits<double>::quiet_NaN();
    }
  }
  using C = RobotClearance;
  return columns(found, single, &C::a, &C::b, &C::clearance, &C::lower_bound, &C::point_a,
                 &C::point_b, &C::element_a, &C::element_b, &C::id_a, &C::id_b) +
         py::make_tuple(single ? py::object(gradients[py::int_(0)]) : gradients);
}

py::tuple clearances(AskedRobot& self, py::handle q, int among, double rel_err, double abs_err,
                     double far_enough, bool gradient, const BatchOptions& options) {
  const Configurations asked(q, "q", self.robot());
  ClearanceRequest request;
  request.among = static_cast<RobotPairs>(among);
  request.rel_err = rel_err;
  request.abs_err = abs_err;
  request.far_enough = far_enough;
  request.gradient = gradient;
  const auto found = self.askEach(asked.size, options, asked.batch(), [&](std::size_t i) {
    return self.robot().clearance(asked[i], request);
  });
  return tableOf(found, asked.single, asked.k);
}

py::tuple within(AskedRobot& self, py::handle q, double margin) {
  const Eigen::VectorXd at = configuration(q, self.robot());
  return tableOf(self.ask([&](const Robot& robot) { return robot.clearances(at, margin); }), false,
                 at.size());
}

py::tuple checkMotions(AskedRobot& self, py::handle q0, py::handle q1, double min_separation,
                       bool first_contact, double resolution, long long max_queries,
                       bool within_limits, const BatchOptions& options) {
  const Configurations from(q0, "q0", self.robot()), to(q1, "q1", self.robot());
  if (from.size != to.size && !from.single && !to.single) {
    throw std::invalid_argument("fcl_kios: there are " + std::to_string(from.size) + " q0, but " +
                                std::to_string(to.size) + " q1.");
  }
  RobotMotionRequest request;
  request.min_separation = min_separation;
  request.first_contact = first_contact;
  request.resolution = resolution;
  request.max_queries = max_queries;
  request.within_limits = within_limits;
  const bool single = from.single && to.single;
  const auto found = self.askEach(
      from.single ? to.size : from.size, options, single ? "" : "motion", [&](std::size_t i) {
        return self.robot().checkMotion(from[from.single ? 0 : i], to[to.single ? 0 : i], request);
      });
  using M = RobotMotion;
  return columns(
      found, single, [](const M& m) { return static_cast<int>(m.verdict); }, &M::from, &M::to,
      &M::a, &M::b, [](const M& m) { return m.counts.queries; });
}

py::tuple tupleOf(const RobotRange& range) {
  return py::make_tuple(range.lower, range.upper,
                        range.at.empty() ? py::object(py::none()) : arrayOf(range.at), range.a,
                        range.b, toArray(range.point_a), toArray(range.point_b), range.complete,
                        range.queries);
}

/// Brackets the least clearance on a path (m, k), or in a box, of which these are the two ends.
py::list leastClearances(py::object self, py::handle ends, bool is_box, bool each, double abs_err,
                         double rel_err, double ceiling, long long max_queries,
                         bool within_limits) {
  const Configurations asked(ends, is_box ? "box" : "path", self.cast<AskedRobot&>().robot());
  RangeRequest request;
  request.abs_err = abs_err;
  request.rel_err = rel_err;
  request.ceiling = ceiling;
  request.max_queries = max_queries;
  std::vector<Eigen::VectorXd> path;
  for (std::size_t i = 0; i < asked.size; ++i) path.push_back(asked[i]);
  const bool two = path.size() == 2;
  if (!two && (is_box || each)) {
    throw std::invalid_argument(std::string("fcl_kios: ") +
                                (is_box ? "a box has lower and upper ends."
                                        : "each pair is asked about on a path of two ends."));
  }
  const auto ranges = askLong(std::move(self), [=](const Robot& robot) {
    JointBox box;
    if (is_box) {
      box = {{path[0].begin(), path[0].end()}, {path[1].begin(), path[1].end()}};
    }
    if (each) {
      return is_box ? robot.leastClearances(box, request, within_limits)
                    : robot.leastClearances(path[0], path[1], request);
    }
    return std::vector{is_box ? robot.leastClearance(box, request, within_limits)
                              : robot.leastClearance(path, request)};
  });
  py::list list;
  for (const RobotRange& range : ranges) list.append(tupleOf(range));
  return list;
}

py::list linkPairs(py::object self, long long max_boxes, double max_seconds,
                   const py::object& threads) {
  PairRequest request;
  request.max_boxes = max_boxes;
  request.max_seconds = max_seconds;
  request.threads = threadsOf(threads);
  py::list list;
  for (const LinkPair& pair :
       askLong(std::move(self), [=](const Robot& robot) { return robot.linkPairs(request); })) {
    list.append(py::make_tuple(pair.a, pair.b, static_cast<int>(pair.verdict), pair.adjacent,
                               pair.q.size() > 0 ? py::object(arrayOf(pair.q)) : py::none()));
  }
  return list;
}

py::object poses(AskedRobot& self, const std::string& name, py::handle q) {
  const Configurations asked(q, "q", self.robot());
  py::array_t<double> array({static_cast<py::ssize_t>(asked.size), py::ssize_t{4}, py::ssize_t{4}});
  double* const to = array.mutable_data();
  self.askEach(asked.size, {py::none(), py::none()}, asked.batch(), [&](std::size_t i) {
    Eigen::Map<Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(to + 16 * i) =
        self.robot().pose(name, asked[i]).matrix();
    return true;
  });
  return asked.single ? py::object(array[py::int_(0)]) : array;
}

py::object withinLimits(AskedRobot& self, py::handle q, double slack) {
  const Configurations asked(q, "q", self.robot());
  return column(
      self.askEach(asked.size, {py::int_(1), py::none()}, asked.batch(),
                   [&](std::size_t i) { return self.robot().withinLimits(asked[i], slack); }),
      asked.single);
}

py::tuple group(const AskedRobot& self, const std::string& name) {
  const RobotGroup found = self.robot().group(name);
  const py::array_t<std::int64_t> places(py::array_t<int>(
      static_cast<py::ssize_t>(found.coordinates.size()), found.coordinates.data()));
  return py::make_tuple(found.joints, places, found.links, found.end_effectors);
}

using Name = const std::string&;
using Change = std::function<void(Robot&)>;

/// Binds what changes a robot. Arguments are read first: numpy may let other threads go on, whose
/// queries must not run beside the change.
template <typename... Arguments>
void bindChange(py::class_<AskedRobot>& c, const char* name,
                Change (*read)(const Robot&, Arguments...)) {
  c.def(name, [read](AskedRobot& self, Arguments... arguments) {
    self.change(read(self.robot(), arguments...));
  });
}

Change add(const Robot& /*robot*/, Name name, py::handle geometry, py::handle X_W) {
  return [name, own = geometryOf(geometry), X = poseOf(X_W, "X_W")](Robot& robot) {
    robot.addObstacle(name, own, X);
  };
}
Change addPoints(const Robot& /*robot*/, Name name, py::handle points, double radius) {
  return [name, radius, asked = Points(points, "points")](Robot& robot) {
    const auto size = static_cast<Eigen::Index>(asked.size);
    robot.addPoints(name, Eigen::Map<const Eigen::Matrix3Xd>(asked.data, 3, size), radius);
  };
}
Change addOctomap(const Robot& /*robot*/, Name name, Name file, py::handle X_W) {
  const fcl::Transform3d X = poseOf(X_W, "X_W");
  std::shared_ptr<const fcl::CollisionGeometryd> octree;
  try {
    const WithoutGil released;
    octree = files::readOctomap(file);
  } catch (const std::exception& error) {
    throw std::invalid_argument(std::string("fcl_kios: ") + error.what());
  }
  return [=](Robot& robot) { robot.addObstacle(name, octree, X); };
}
Change addScene(const Robot& /*robot*/, Name file) {
  return [file](Robot& robot) { robot.addScene(file); };
}
Change move(const Robot& /*robot*/, Name name, py::handle X_W) {
  return [name, X = poseOf(X_W, "X_W")](Robot& robot) { robot.moveObstacle(name, X); };
}
Change attach(const Robot& /*robot*/, Name name, Name link, py::handle geometry, py::handle X_LB,
              const Names& touch) {
  return [=, own = geometryOf(geometry), X = poseOf(X_LB, "X_LB")](Robot& robot) {
    robot.attach(name, link, own, X, touch);
  };
}
Change attachObstacle(const Robot& of, Name name, Name link, py::handle q, const Names& touch) {
  return [name, link, touch, at = configuration(q, of)](Robot& robot) {
    robot.attachObstacle(name, link, at, touch);
  };
}
Change detach(const Robot& of, Name name, py::handle q) {
  return [name, at = configuration(q, of)](Robot& robot) { robot.detach(name, at); };
}
Change remove(const Robot& /*robot*/, Name name) {
  return [name](Robot& robot) { robot.remove(name); };
}
Change ignore(const Robot& /*robot*/, const std::vector<std::pair<std::string, std::string>>& all) {
  std::vector<LinkPair> pairs;
  for (const auto& [a, b] : all) pairs.push_back({a, b, PairVerdict::kNever, false, {}, 0, 0});
  return [pairs](Robot& robot) { robot.ignore(pairs); };
}
Change ignorePair(const Robot& /*robot*/, Name a, Name b, bool ignored) {
  return [a, b, ignored](Robot& robot) { robot.ignorePair(a, b, ignored); };
}
Change setPadding(const Robot& /*robot*/, Name name, double metres) {
  return [name, metres](Robot& robot) { robot.setPadding(name, metres); };
}

}  // namespace

// Python's fcl_kios.Robot, which derives from it, has the signatures and docstrings.
void bindRobot(py::module_& m) {
  py::class_<AskedRobot> c(m, "_Robot");
  const auto tell = [&c](const char* name, const char* text, auto of) {
    c.def_property_readonly(
        name, [of](const AskedRobot& self) { return std::invoke(of, self.robot()); }, text);
  };
  tell("name", "The URDF's name.", &Robot::name);
  tell("joints", "Names by coordinate.", &Robot::joints);
  tell("links", "Names, in the URDF's order.", &Robot::links);
  tell("lower", "(k,) limits; infinite of continuous joints.",
       [](const Robot& robot) { return arrayOf(robot.lower()); });
  tell("upper", "(k,) limits; infinite of continuous joints.",
       [](const Robot& robot) { return arrayOf(robot.upper()); });
  tell("states", "Names of the SRDF's group states.", &Robot::states);
  tell("groups", "Names of the SRDF's planning groups.", &Robot::groups);
  tell("warnings", "What files name that isn't there, or is left out.", &Robot::warnings);
  bindChange(c, "_add", &add);
  bindChange(c, "_add_points", &addPoints);
  bindChange(c, "_add_octomap", &addOctomap);
  bindChange(c, "_add_scene", &addScene);
  bindChange(c, "_move", &move);
  bindChange(c, "_attach", &attach);
  bindChange(c, "_attach_obstacle", &attachObstacle);
  bindChange(c, "_detach", &detach);
  bindChange(c, "_remove", &remove);
  bindChange(c, "_ignore_pair", &ignorePair);
  bindChange(c, "_ignore", &ignore);
  bindChange(c, "_set_padding", &setPadding);
  c.def(py::init(&loaded))
      .def(py::init(
          [](const AskedRobot& other) { return std::make_unique<AskedRobot>(other.robot()); }))
      .def("_state",
           [](const AskedRobot& self, Name name) { return arrayOf(self.robot().state(name)); })
      .def("_allowed",
           [](const AskedRobot& self, Name a, Name b) { return self.robot().allowed(a, b); })
      .def("_group", &group)
      .def("_pose", &poses)
      .def("_within_limits", &withinLimits)
      .def("_contact", &contact)
      .def("_contacts", &contacts)
      .def("_clearances", &clearances)
      .def("_within", &within)
      .def("_check_motions", &checkMotions)
      .def("_least_clearances", &leastClearances)
      .def("_link_pairs", &linkPairs);
}

}  // namespace kios::python
