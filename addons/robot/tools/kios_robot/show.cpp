// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "show.h"

#include <algorithm>

#include "commands.h"
#include "shape_mesh.h"
#include "viewer/viewer.h"
#include "way.h"

namespace kios::robot_tool {
namespace {

using Eigen::VectorXd;
using fcl::Transform3d;
using fcl::Vector3d;

constexpr int kSteps = 100;      // of a path
constexpr int kLeastSteps = 10;  // of a part of it

bool isEndless(const fcl::CollisionGeometryd& geometry) {
  return geometry.getNodeType() == fcl::GEOM_HALFSPACE || geometry.getNodeType() == fcl::GEOM_PLANE;
}

/// Links alternate, so that neighbours can be told apart.
Json colorOf(const RobotElement& element, std::size_t link) {
  if (element.obstacle) return {214, 180, 132};
  if (element.attached) return {122, 178, 120};
  return link % 2 == 0 ? Json{208, 213, 220} : Json{128, 150, 180};
}

/// The page's frame: the world's, moved so that the middle of all that is shown is the origin.
struct Frame {
  Eigen::AlignedBox3d box;

  Json segment(const RobotClearance& near) const {
    const auto placed = [&](const Vector3d& p) { return listOf(VectorXd(p - box.center())); };
    return {placed(near.point_a), placed(near.point_b)};
  }
  std::vector<float> matrix(Transform3d X) const {
    X.translation() -= box.center();
    std::vector<float> values;
    for (int i = 0; i < 16; ++i) values.push_back(static_cast<float>(X.matrix().data()[i]));
    return values;
  }
};

/// A configuration of the path with what the panel says of it.
Json frameOf(const Robot& robot, const std::vector<RobotElement>& elements, const VectorXd& q,
             double at, const Frame& frame) {
  std::vector<float> poses;
  for (const RobotElement& element : elements) {
    const auto matrix = frame.matrix(robot.pose(element.name, q) * Transform3d(element.X));
    poses.insert(poses.end(), matrix.begin(), matrix.end());
  }
  const RobotClearance near = robot.clearance(q);
  const auto contact = robot.contact(q);
  Json result = {{"at", at}, {"q", listOf(q)}, {"poses", viewer::base64(poses)}};
  result["contact"] = contact.has_value();
  if (near.a.empty()) return result;
  result["nearest"] = {contact ? contact->a : near.a, contact ? contact->b : near.b};
  result["clearance"] = near.clearance;
  result["segment"] = frame.segment(near);
  return result;
}

/// Brackets of the least clearance on each step of a path: nothing is nearer, nor is less seen.
Json bandOf(const Robot& robot, const Way& way, const std::vector<double>& times) {
  RangeRequest request;
  request.rel_err = 0.05;
  request.max_queries = 500;  // a page of a hundred steps
  Json band = Json::array();
  for (std::size_t i = 0; i + 1 < times.size(); ++i) {
    const RobotRange step = robot.leastClearance(way.at(times[i]), way.at(times[i + 1]), request);
    band.push_back({step.lower, step.upper});
  }
  return band;
}

Json sceneMesh(const RobotElement& element, const ShapeMesh& mesh, const Json& color) {
  std::vector<float> positions;
  for (const Vector3d& p : mesh.vertices) {
    for (int i = 0; i < 3; ++i) positions.push_back(static_cast<float>(p[i]));
  }
  return {{"name", element.name},
          {"obstacle", element.obstacle},
          {"positions", viewer::base64(positions)},
          {"triangles", viewer::base64(mesh.corners)},
          {"levels", Json::array()},
          {"color", color},
          {"matrix", Json::array()}};
}

}  // namespace

std::string showPage(const Robot& robot, const std::string& title,
                     const std::vector<VectorXd>& path, double min_separation) {
  const Way way(path);
  std::vector<double> times = {0};
  Json motion, stops = Json::array();
  if (way.parts() > 0) {
    const int steps = way.parts() * std::max((kSteps - 1) / way.parts() + 1, kLeastSteps);
    for (int i = 1; i <= steps; ++i) times.push_back(static_cast<double>(i) / steps);
    MotionRequest request;
    request.first_contact = true;
    request.min_separation = min_separation;
    const RobotMotion answer = way.check(robot, request);
    motion = {{"verdict", nameOf(answer.verdict)}, {"from", answer.from}, {"to", answer.to}};
    if (answer.verdict != MotionVerdict::kClear) {
      motion["pair"] = {answer.a, answer.b};
      times.push_back(answer.to);
      std::sort(times.begin(), times.end());
      times.erase(std::unique(times.begin(), times.end()), times.end());
    }
    for (int i = 0; way.parts() > 1 && i <= way.parts(); ++i) {
      const auto at = std::lower_bound(times.begin(), times.end(), way.timeOf(i));
      stops.push_back(at - times.begin());
    }
  }

  std::vector<RobotElement> elements;
  std::vector<ShapeMesh> meshes;
  Json notes = Json::array();
  Frame frame;
  for (const RobotElement& element : robot.elements()) {
    if (isEndless(*element.geometry)) continue;
    const ShapeMesh mesh = meshOf(*element.geometry, 0);
    for (std::size_t i = 0; i < times.size(); i += element.obstacle ? times.size() : 10) {
      const Transform3d X = robot.pose(element.name, way.at(times[i])) * Transform3d(element.X);
      for (const Vector3d& p : mesh.vertices) frame.box.extend(X * p);
    }
  }
  if (frame.box.isEmpty()) frame.box.extend(Vector3d::Zero());
  const double radius = std::max(0.5 * frame.box.diagonal().norm(), 1e-6);
  for (const RobotElement& element : robot.elements()) {
    ShapeMesh mesh = meshOf(*element.geometry, 1.5 * radius);
    if (mesh.corners.empty()) {
      notes.push_back(element.name + " is not shown: an octree.");
      continue;
    }
    elements.push_back(element);
    meshes.push_back(std::move(mesh));
  }

  Json scene = {{"radius", radius}, {"segment", nullptr}, {"meshes", Json::array()}};
  std::size_t link = 0;
  for (std::size_t i = 0; i < elements.size(); ++i) {
    if (i > 0 && elements[i].name != elements[i - 1].name) ++link;
    scene["meshes"].push_back(sceneMesh(elements[i], meshes[i], colorOf(elements[i], link)));
  }
  Json frames = Json::array();
  for (const double s : times) {
    frames.push_back(frameOf(robot, elements, way.at(s), s, frame));
  }
  const Json content = {{"title", title},   {"joints", robot.joints()},
                        {"notes", notes},   {"motion", motion},
                        {"frames", frames}, {"stops", stops},
                        {"scene", scene},   {"band", bandOf(robot, way, times)}};
  return viewer::page(viewer::kPageText,
                      content.dump(-1, ' ', false, Json::error_handler_t::replace));
}

}  // namespace kios::robot_tool
