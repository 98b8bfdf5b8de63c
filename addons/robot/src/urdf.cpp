// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "urdf.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/cylinder.h>
#include <fcl/geometry/shape/sphere.h>
#include "fcl_kios/linkage.h"
#include "mesh_file.h"
#include "mesh_path.h"
#include "text_file.h"
#include "volume/rounding.h"
#include "xml_file.h"

namespace kios::robot {
namespace {

using Eigen::Vector3d;
using XmlElement = XmlFile::Element;

/// fcl_kios: is what our messages begin with.
std::string textOf(const std::exception& error) {
  const std::string text = error.what(), prefix = "fcl_kios: ";
  return text.rfind(prefix, 0) == 0 ? text.substr(prefix.size()) : text;
}

class UrdfReader {
 public:
  UrdfReader(const std::string& file, const std::map<std::string, std::string>& packages)
      : xml_(file, "robot"), packages_(packages) {}

  Description read() {
    const XmlElement& root = xml_.root();
    result_.name = xml_.attribute(root, "name");
    for (const XmlElement* e = root.FirstChildElement("link"); e;
         e = e->NextSiblingElement("link")) {
      readLink(*e);
    }
    if (result_.links.empty()) xml_.refuse(root, "it has no <link>.");
    for (const XmlElement* e = root.FirstChildElement("joint"); e;
         e = e->NextSiblingElement("joint")) {
      readJoint(*e);
    }
    for (const auto& [joint, element] : mimics_) readMimic(joint, *element);
    requireTree();
    return std::move(result_);
  }

 private:
  void readLink(const XmlElement& e) {
    UrdfLink link;
    link.name = xml_.attribute(e, "name");
    if (result_.linkOf(link.name) >= 0) xml_.refuse(e, "a link of this name is there already.");
    for (const XmlElement* c = e.FirstChildElement("collision"); c;
         c = c->NextSiblingElement("collision")) {
      Element element;
      element.X = xml_.origin(*c);
      element.geometry = readGeometry(xml_.child(*c, "geometry"));
      link.elements.push_back(std::move(element));
    }
    result_.links.push_back(std::move(link));
  }

  Geometry readGeometry(const XmlElement& e) {
    const XmlElement* const shape = e.FirstChildElement();
    if (!shape) xml_.refuse(e, "it needs a <mesh>, <box>, <sphere>, <cylinder> or <capsule>.");
    if (shape->NextSiblingElement()) {
      xml_.refuse(*shape->NextSiblingElement(), "a second shape; write a <collision> for each.");
    }
    const std::string kind = shape->Name();
    const auto length = [&](const char* name) {
      const double x = xml_.number(*shape, name);
      if (!(x >= 0)) xml_.refuse(*shape, std::string("its ") + name + " is negative.");
      return x;
    };
    Geometry geometry;
    if (kind == "mesh") {
      geometry = readMeshElement(*shape);
    } else if (kind == "box") {
      const Vector3d size = xml_.vector(*shape, "size");
      if (!(size.minCoeff() >= 0)) xml_.refuse(*shape, "its size is negative.");
      geometry = std::make_shared<fcl::Boxd>(size);
    } else if (kind == "sphere") {
      geometry = std::make_shared<fcl::Sphered>(length("radius"));
    } else if (kind == "cylinder") {
      geometry = std::make_shared<fcl::Cylinderd>(length("radius"), length("length"));
    } else if (kind == "capsule") {
      geometry = std::make_shared<fcl::Capsuled>(length("radius"), length("length"));
    } else {
      xml_.refuse(*shape, "there is no such shape; mesh, box, sphere, cylinder and capsule are.");
    }
    try {
      measure(geometry);
    } catch (const std::exception& error) {
      xml_.refuse(*shape, textOf(error));
    }
    return geometry;
  }

  Geometry readMeshElement(const XmlElement& e) {
    const std::string uri = xml_.attribute(e, "filename");
    const Vector3d scale = xml_.vector(e, "scale", Vector3d::Ones());
    if (!((scale.array() != 0).all())) xml_.refuse(e, "a factor of its scale is 0.");
    try {
      const std::string file = resolve(uri, xml_.name(), packages_);
      Geometry& known = meshes_[{file, {scale.x(), scale.y(), scale.z()}}];
      if (!known) known = readMesh(file, scale, result_.warnings);
      return known;
    } catch (const std::exception& error) {
      xml_.refuse(e, textOf(error));
    }
  }

  int linkNamed(const XmlElement& joint, const char* role) const {
    const XmlElement& e = xml_.child(joint, role);
    const std::string name = xml_.attribute(e, "link");
    const int link = result_.linkOf(name);
    if (link < 0) xml_.refuse(joint, "there is no link '" + name + "', its " + role + ".");
    return link;
  }

  void readJoint(const XmlElement& e) {
    UrdfJoint joint;
    joint.name = xml_.attribute(e, "name");
    for (const UrdfJoint& other : result_.joints) {
      if (other.name == joint.name) xml_.refuse(e, "a joint of this name is there already.");
    }
    const std::string type = xml_.attribute(e, "type");
    const std::map<std::string, UrdfJointType> types = {
        {"fixed", UrdfJointType::kFixed},           {"revolute", UrdfJointType::kRevolute},
        {"continuous", UrdfJointType::kContinuous}, {"prismatic", UrdfJointType::kPrismatic},
        {"planar", UrdfJointType::kPlanar},         {"floating", UrdfJointType::kFloating}};
    const auto known = types.find(type);
    if (known == types.end()) {
      xml_.refuse(e, "its type '" + type +
                         "' must be revolute, continuous, prismatic, fixed, planar or floating.");
    }
    joint.type = known->second;
    joint.parent = linkNamed(e, "parent");
    joint.child = linkNamed(e, "child");
    joint.X_PJ = xml_.origin(e);
    const bool has_axis = joint.moves() && joint.type != UrdfJointType::kFloating;
    if (const XmlElement* const axis = has_axis ? xml_.optionalChild(e, "axis") : nullptr) {
      joint.axis = xml_.vector(*axis, "xyz");
      if (!(joint.axis.stableNorm() > 0)) xml_.refuse(*axis, "the axis is of length 0.");
      joint.axis = (joint.axis / joint.axis.stableNorm()).normalized();
    }
    joint.lower = -kInfinity;
    joint.upper = kInfinity;
    if (joint.type == UrdfJointType::kRevolute || joint.type == UrdfJointType::kPrismatic) {
      const XmlElement& limit = xml_.child(e, "limit");
      joint.lower = limitOf(limit, "lower");
      joint.upper = limitOf(limit, "upper");
      if (!(joint.lower <= joint.upper) || joint.lower == kInfinity || joint.upper == -kInfinity) {
        xml_.refuse(limit, "its lower limit exceeds the upper one.");
      }
      // Exporters write no limits as infinite or huge ones: more turns than a joint ever makes.
      constexpr double kEndless = 1e6;
      if (joint.type == UrdfJointType::kRevolute && joint.lower <= -kEndless &&
          joint.upper >= kEndless) {
        joint.type = UrdfJointType::kContinuous;
        joint.lower = -kInfinity;
        joint.upper = kInfinity;
      } else if (!std::isfinite(joint.lower) || !std::isfinite(joint.upper)) {
        xml_.refuse(limit, "only both limits of a revolute joint may be infinite.");
      }
    }
    const XmlElement* const mimic = xml_.optionalChild(e, "mimic");
    if (mimic && joint.moves()) mimics_.emplace_back(result_.joints.size(), mimic);
    result_.joints.push_back(std::move(joint));
  }

  double limitOf(const XmlElement& limit, const char* name) const {
    const char* const text = limit.Attribute(name);
    for (const double sign : {-1.0, 1.0}) {
      for (const char* const word : {"inf", "Inf", "INF", "infinity", "Infinity"}) {
        if (text && text == (sign < 0 ? "-" : "") + std::string(word)) return sign * kInfinity;
      }
    }
    return xml_.number(limit, name, 0);
  }

  int jointNamed(const std::string& name) const {
    for (std::size_t i = 0; i < result_.joints.size(); ++i) {
      if (result_.joints[i].name == name) return static_cast<int>(i);
    }
    return -1;
  }

  const XmlElement* mimicOf(int joint) const {
    for (const auto& [other, element] : mimics_) {
      if (static_cast<int>(other) == joint) return element;
    }
    return nullptr;
  }

  /// Follows the joints that mimic each other to the one that mimics nobody.
  void readMimic(std::size_t index, const XmlElement& mimic) {
    UrdfJoint& joint = result_.joints[index];
    const auto single = [](const UrdfJoint& j) {
      return j.moves() && j.type != UrdfJointType::kPlanar && j.type != UrdfJointType::kFloating;
    };
    if (!single(joint)) {
      xml_.refuse(mimic, "'" + joint.name + "' has several coordinates and can't mimic a joint.");
    }
    const XmlElement* e = &mimic;
    std::size_t steps = 0;
    while (e) {
      const std::string name = xml_.attribute(*e, "joint");
      const int mimicked = jointNamed(name);
      if (mimicked < 0) {  // a joint on its own, also to those that mimic it
        if (steps == 0) {
          result_.warnings.push_back(xml_.at(*e, "there is no joint '" + name + "' that '" +
                                                     joint.name +
                                                     "' could mimic; it moves on its own."));
        }
        return;
      }
      joint.mimics = mimicked;
      if (!single(result_.joints[joint.mimics])) {
        xml_.refuse(*e, "'" + joint.name + "' can't mimic '" + name +
                            "', which is no revolute, continuous or prismatic joint.");
      }
      const double multiplier = xml_.number(*e, "multiplier", 1),
                   offset = xml_.number(*e, "offset", 0);
      joint.offset += joint.multiplier * offset;
      joint.multiplier *= multiplier;
      constexpr double kMost = 0x1p100;
      if (!(std::abs(joint.multiplier) <= kMost && std::abs(joint.offset) <= kMost)) {
        xml_.refuse(*e, "its multiplier or offset is too large.");
      }
      e = mimicOf(joint.mimics);
      if (++steps > mimics_.size()) xml_.refuse(mimic, "joints mimic each other in a circle.");
    }
  }

  void requireTree() {
    const std::size_t count = result_.links.size();
    std::vector<int> parent(count, -1);
    for (const UrdfJoint& joint : result_.joints) {
      if (parent[joint.child] >= 0) {
        xml_.refuse(xml_.root(),
                    "two joints carry the link '" + result_.links[joint.child].name +
                        "'; loops can't be served: leave out the joint that closes it.");
      }
      parent[joint.child] = joint.parent;
    }
    std::string roots;
    int num_roots = 0;
    for (std::size_t i = 0; i < count; ++i) {
      if (parent[i] >= 0) continue;
      ++num_roots;
      roots += (num_roots > 1 ? "', '" : "'") + result_.links[i].name;
    }
    if (num_roots > 1) {
      xml_.refuse(xml_.root(), "it has " + std::to_string(num_roots) + " roots: links " + roots +
                                   "' are carried by no joint; join them.");
    }
    for (std::size_t i = 0; i < count; ++i) {
      std::size_t steps = 0;
      for (int link = static_cast<int>(i); link >= 0; link = parent[link]) {
        if (++steps > count) {
          xml_.refuse(xml_.root(), "the link '" + result_.links[i].name +
                                       "' is carried by itself, in a circle.");
        }
      }
    }
  }

  using MeshKey = std::pair<std::string, std::vector<double>>;

  XmlFile xml_;
  const std::map<std::string, std::string>& packages_;
  Description result_;
  std::vector<std::pair<std::size_t, const XmlElement*>> mimics_;
  std::map<MeshKey, Geometry> meshes_;  // each file is read once
};

}  // namespace

int Description::linkOf(const std::string& name) const {
  for (std::size_t i = 0; i < links.size(); ++i) {
    if (links[i].name == name) return static_cast<int>(i);
  }
  return -1;
}

int Description::root() const {
  std::vector<char> carried(links.size(), 0);
  for (const UrdfJoint& joint : joints) carried[joint.child] = 1;
  return static_cast<int>(std::find(carried.begin(), carried.end(), 0) - carried.begin());
}

std::shared_ptr<const Linkage> measure(const Geometry& geometry) {
  const auto alone = std::make_shared<Linkage>();
  alone->addBody(-1, geometry);
  return alone;
}

Description readUrdf(const std::string& file, const std::map<std::string, std::string>& packages) {
  return UrdfReader(file, packages).read();
}

}  // namespace kios::robot
