// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "scene_file.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/cone.h>
#include <fcl/geometry/shape/cylinder.h>
#include <fcl/geometry/shape/plane.h>
#include <fcl/geometry/shape/sphere.h>
#include "mesh_file.h"
#include "text_file.h"
#include "urdf.h"
#include "yaml_file.h"

namespace kios::robot {
namespace {

using fcl::Transform3d;
using fcl::Vector3d;

/// Reads MoveIt's message PlanningScene. A key is one of the message's, whether it matters here or
/// not, or refused: what is misspelt would be an obstacle that isn't there.
class SceneReader : YamlFile {
 public:
  SceneReader(const std::string& file, const Description& robot) : YamlFile(file), robot_(robot) {}

  Scene read() {
    const std::string content = contentOf(file_);
    const std::size_t second = content.find('\n') + 1;
    if (second > 0 && content.compare(second, 2, "* ") == 0) {
      refuse(file_ +
             ": it is a scene in MoveIt's text format, .scene; read is the message "
             "PlanningScene in YAML.");
    }
    YAML::Node root;
    try {
      std::vector<YAML::Node> documents = YAML::LoadAll(content);
      if (documents.size() > 1 && !documents[1].IsNull()) {
        refuseHere(documents[1], "a second document; a scene is one.");
      }
      if (!documents.empty()) root = documents[0];
    } catch (const YAML::Exception& error) {
      refuseAt(file_, error.mark.line + 1, "it is no YAML: " + error.msg + ".");
    }
    if (!root.IsMap() || !(root["world"] || root["robot_state"] || root["name"] ||
                           root["allowed_collision_matrix"])) {
      refuse(file_ + ": it holds no planning scene: there is no world in it.");
    }
    map(root, {"name", "robot_state", "robot_model_name", "fixed_frame_transforms",
               "allowed_collision_matrix", "link_padding", "link_scale", "object_colors", "world",
               "is_diff"});
    for (const YAML::Node& frame : list(root["fixed_frame_transforms"])) {
      const YAML::Node X = map(frame, {"header", "child_frame_id", "transform"})["transform"];
      if (!X) refuseHere(frame, "a transform is missing.");
      map(X, {"translation", "rotation"});
      frames_[scalar(frame["child_frame_id"], frame)] = pose(X["translation"], X["rotation"], X);
    }
    if (const YAML::Node world = root["world"]) {
      const YAML::Node octomap = map(world, {"collision_objects", "octomap"})["octomap"];
      if (octomap && octomap.IsMap() && octomap["octomap"] && octomap["octomap"].IsMap() &&
          !list(octomap["octomap"]["data"]).empty()) {
        refuseHere(octomap, "an octomap isn't read from here; add it as a file, .bt or .ot.");
      }
      for (const YAML::Node& object : list(world["collision_objects"])) readObject(object, -1);
    }
    if (const YAML::Node state = root["robot_state"]) {
      map(state, {"joint_state", "multi_dof_joint_state", "attached_collision_objects", "is_diff"});
      for (const YAML::Node& attached : list(state["attached_collision_objects"])) {
        readAttached(attached);
      }
    }
    readMatrix(root["allowed_collision_matrix"]);
    readLinks(root);
    return std::move(scene_);
  }

 private:
  Transform3d frameOf(const YAML::Node& object, int link) const {
    const YAML::Node header = object["header"];
    std::string frame;
    if (header && map(header, {"seq", "stamp", "frame_id"})["frame_id"] &&
        header["frame_id"].IsScalar()) {
      frame = header["frame_id"].Scalar();
    }
    if (!frame.empty() && frame[0] == '/') frame.erase(0, 1);
    if (frame.empty()) return Transform3d::Identity();
    if (link >= 0) {
      if (frame == robot_.links[link].name) return Transform3d::Identity();
      refuseHere(header,
                 "what is attached must be posed in its link's frame, not in '" + frame + "'.");
    }
    const auto known = frames_.find(frame);
    if (known != frames_.end()) return known->second;
    if (frame == "world") return Transform3d::Identity();
    const int placed_in = robot_.linkOf(frame);
    if (placed_in < 0) {
      refuseHere(header,
                 "obstacles must be posed in the frame 'world', one of "
                 "fixed_frame_transforms, or a link's, not in '" +
                     frame + "'.");
    }
    Transform3d X = Transform3d::Identity();
    for (int at = placed_in; at != robot_.root();) {
      const auto joint = std::find_if(robot_.joints.begin(), robot_.joints.end(),
                                      [&](const UrdfJoint& known) { return known.child == at; });
      if (joint->moves()) {
        refuseHere(header, "the joint '" + joint->name + "' moves the frame '" + frame +
                               "'; pose the obstacle in the frame 'world', or attach it.");
      }
      X = rigidProduct(joint->X_PJ, X);
      at = joint->parent;
    }
    return X;
  }

  /// False if it removes one.
  bool readObject(const YAML::Node& node, int link) {
    map(node,
        {"header", "pose", "id", "type", "primitives", "primitive_poses", "meshes", "mesh_poses",
         "planes", "plane_poses", "subframe_names", "subframe_poses", "operation"});
    Object object;
    object.name = scalar(node["id"], node);
    object.link = link;
    if (robot_.linkOf(object.name) >= 0)
      refuseHere(node, "'" + object.name + "' is a link's name.");
    const std::string operation =
        node["operation"] ? scalar(node["operation"], node) : std::string("0");
    if (operation == "1" || operation == "REMOVE" || operation == "remove") {
      scene_.removed.push_back(object.name);
      return false;
    }
    const bool adds = operation == "0" || operation == "ADD" || operation == "add" ||
                      (operation.size() == 1 && operation[0] == '\0') || operation == "\\0";
    if (!adds) refuseHere(node["operation"], "only the operations ADD and REMOVE are read.");
    for (const Object& other : scene_.objects) {
      if (other.name == object.name) {
        refuseHere(node, "'" + object.name + "' is there twice.");
      }
    }
    readElements(node, "primitives", "primitive_poses", object);
    readElements(node, "meshes", "mesh_poses", object);
    readElements(node, "planes", "plane_poses", object);
    if (object.elements.empty()) refuseHere(node, "'" + object.name + "' has no shape.");
    object.X = frameOf(node, link);
    const YAML::Node own = node["pose"];
    if (own && own.IsMap()) {
      object.X = rigidProduct(object.X, pose(own));
    } else if (object.elements.size() == 1) {  // the object's frame is its only shape's
      object.X = rigidProduct(object.X, object.elements[0].X);
      object.elements[0].X.setIdentity();
    }
    scene_.objects.push_back(std::move(object));
    return true;
  }

  void readElements(const YAML::Node& node, const char* shapes, const char* poses, Object& object) {
    const auto items = list(node[shapes]), places = list(node[poses]);
    if (places.size() > items.size() || (!places.empty() && places.size() < items.size())) {
      refuseHere(node, "'" + object.name + "' has " + std::to_string(items.size()) + " " + shapes +
                           ", but " + std::to_string(places.size()) + " " + poses + ".");
    }
    for (std::size_t i = 0; i < items.size(); ++i) {
      Element element;
      const std::string kind = shapes;
      try {
        element.geometry = kind == "primitives" ? primitive(items[i])
                           : kind == "meshes"   ? mesh(items[i])
                                                : plane(items[i]);
        element.measured = measure(element.geometry);
      } catch (const std::exception& error) {
        const std::string text = error.what(), prefix = "fcl_kios: ";
        if (text.rfind(prefix + file_, 0) == 0) throw;
        refuseHere(items[i], text.rfind(prefix, 0) == 0 ? text.substr(prefix.size()) : text);
      }
      if (!places.empty()) element.X = pose(places[i]);
      object.elements.push_back(std::move(element));
    }
  }

  Geometry primitive(const YAML::Node& node) const {
    map(node, {"type", "dimensions", "polygon"});
    const std::string type = scalar(node["type"], node);
    if (!node["dimensions"]) refuseHere(node, "its dimensions are missing.");
    const std::vector<double> d = numbers(node["dimensions"], "");
    const auto require = [&](std::size_t count) {
      if (d.size() < count) {
        refuseHere(node, "a " + type + " has " + std::to_string(count) + " dimensions.");
      }
      for (std::size_t i = 0; i < count; ++i) {
        if (!(d[i] >= 0)) refuseHere(node, "a dimension is negative.");
      }
    };
    if (type == "box" || type == "1") {
      require(3);
      return std::make_shared<fcl::Boxd>(d[0], d[1], d[2]);
    }
    if (type == "sphere" || type == "2") {
      require(1);
      return std::make_shared<fcl::Sphered>(d[0]);
    }
    if (type == "cylinder" || type == "3") {
      require(2);
      return std::make_shared<fcl::Cylinderd>(d[1], d[0]);
    }
    if (type == "cone" || type == "4") {
      require(2);
      return std::make_shared<fcl::Coned>(d[1], d[0]);
    }
    refuseHere(node, "there is no primitive '" + type + "'; box, sphere, cylinder and cone are.");
  }

  Geometry mesh(const YAML::Node& node) const {
    if (node.IsMap() && node["mesh_resource"]) {
      refuseHere(node, "a mesh_resource isn't read; a mesh is its vertices and triangles here.");
    }
    map(node, {"vertices", "triangles"});
    std::vector<Vector3d> vertices;
    for (const YAML::Node& v : list(node["vertices"])) {
      vertices.emplace_back(Eigen::Map<const Vector3d>(numbers(v, "xyz").data()));
    }
    std::vector<fcl::Triangle> triangles;
    for (const YAML::Node& t : list(node["triangles"])) {
      const auto corners =
          numbers(t.IsMap() ? map(t, {"vertex_indices"})["vertex_indices"] : t, "");
      std::size_t ids[3] = {};
      bool fits = corners.size() == 3;
      for (std::size_t k = 0; k < 3 && fits; ++k) {
        fits = corners[k] >= 0 && corners[k] < static_cast<double>(vertices.size()) &&
               corners[k] == std::floor(corners[k]);
        if (fits) ids[k] = static_cast<std::size_t>(corners[k]);
      }
      if (!fits) refuseHere(t, "a triangle must be three indices of vertices.");
      triangles.emplace_back(ids[0], ids[1], ids[2]);
    }
    if (triangles.empty()) refuseHere(node, "a mesh without triangles.");
    return weld(std::move(vertices), std::move(triangles));
  }

  Geometry plane(const YAML::Node& node) const {
    const YAML::Node coef = map(node, {"coef"})["coef"];
    if (!coef) refuseHere(node, "its coef is missing.");
    const std::vector<double> c = numbers(coef, "abcd");
    const Vector3d n(c[0], c[1], c[2]);
    const double length = n.stableNorm();
    if (!(length > 0)) refuseHere(coef, "the plane's normal is zero.");
    return std::make_shared<fcl::Planed>(n / length, -c[3] / length);
  }

  void readAttached(const YAML::Node& node) {
    map(node, {"link_name", "object", "touch_links", "detach_posture", "weight"});
    const std::string name = scalar(node["link_name"], node);
    const int link = robot_.linkOf(name);
    if (link < 0) refuseHere(node, "there is no link '" + name + "'.");
    if (!node["object"]) refuseHere(node, "the object is missing.");
    const bool adds = readObject(node["object"], link);
    for (const YAML::Node& touched : list(node["touch_links"])) {
      const std::string other = scalar(touched, node);
      if (adds) scene_.objects.back().touch.push_back(other);
    }
  }

  void readMatrix(const YAML::Node& matrix) {
    if (!matrix || matrix.IsNull()) return;
    map(matrix, {"entry_names", "entry_values", "default_entry_names", "default_entry_values"});
    std::vector<std::string> names;
    for (const YAML::Node& name : list(matrix["entry_names"]))
      names.push_back(scalar(name, matrix));
    const auto rows = list(matrix["entry_values"]);
    if (rows.size() != names.size()) {
      refuseHere(matrix, "it names " + std::to_string(names.size()) + ", but has " +
                             std::to_string(rows.size()) + " rows.");
    }
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const auto row = list(rows[i].IsMap() ? map(rows[i], {"enabled"})["enabled"] : rows[i]);
      if (row.size() != names.size()) {
        refuseHere(rows[i], "the row of '" + names[i] + "' has " + std::to_string(row.size()) +
                                " values, not " + std::to_string(names.size()) + ".");
      }
      for (std::size_t j = i + 1; j < row.size(); ++j) {
        scene_.pairs.emplace_back(namePair(names[i], names[j]), truth(row[j]));
      }
    }
    const auto others = list(matrix["default_entry_names"]),
               values = list(matrix["default_entry_values"]);
    if (others.size() != values.size())
      refuseHere(matrix, "its defaults are names without values.");
    for (std::size_t i = 0; i < others.size(); ++i) {
      scene_.others.emplace_back(scalar(others[i], matrix), truth(values[i]));
    }
  }

  void readLinks(const YAML::Node& root) {
    for (const YAML::Node& item : list(root["link_padding"])) {
      const double padding = number(map(item, {"link_name", "padding"})["padding"], item);
      if (!(padding >= 0)) refuseHere(item, "a padding is negative.");
      const std::string link = scalar(item["link_name"], item);
      if (robot_.linkOf(link) < 0) refuseHere(item, "there is no link '" + link + "'.");
      scene_.paddings[link] = padding;
    }
    for (const YAML::Node& item : list(root["link_scale"])) {
      if (number(map(item, {"link_name", "scale"})["scale"], item) != 1) {
        refuseHere(item, "links can't be scaled; pad them instead.");
      }
    }
  }

  const Description& robot_;
  std::map<std::string, Transform3d> frames_;
  Scene scene_;
};

}  // namespace

Scene readScene(const std::string& file, const Description& robot) {
  try {
    return SceneReader(file, robot).read();
  } catch (const YAML::Exception& error) {
    refuseAt(file, error.mark.line + 1, error.msg + ".");
  }
}

}  // namespace kios::robot
