// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "text_file.h"
#include "urdf.h"
#include "xml_file.h"

namespace kios::robot {

using XmlElement = XmlFile::Element;

namespace {

/// Reads planning groups: joints, links (with the joints that carry them), chains and groups.
class GroupReader {
 public:
  GroupReader(const XmlFile& xml, Description& robot, const std::set<std::string>& virtual_joints)
      : xml_(xml), robot_(robot), virtual_joints_(virtual_joints) {}

  void read() {
    for (const XmlElement* e = xml_.root().FirstChildElement("group"); e;
         e = e->NextSiblingElement("group")) {
      const std::string name = nameIn(*e, "name");
      if (name.empty()) continue;
      elements_[name].push_back(e);
      robot_.groups[name];
    }
    for (const auto& [name, elements] : elements_) {
      for (const XmlElement* const element : elements) add(*element, name);
    }
    addSubgroups();
    for (const XmlElement* e = xml_.root().FirstChildElement("end_effector"); e;
         e = e->NextSiblingElement("end_effector")) {
      const char* const parent = e->Attribute("parent_group");
      const auto group = robot_.groups.find(parent ? parent : "");
      if (group == robot_.groups.end()) continue;
      const std::string name = nameIn(*e, "group");
      if (!name.empty()) group->second.end_effectors.push_back(name);
    }
  }

 private:
  /// What isn't there is left out, as MoveIt does.
  void warn(const XmlElement& e, const std::string& what) const {
    robot_.warnings.push_back(xml_.at(e, what));
  }

  /// An attribute; empty, with a warning, if it is missing.
  std::string nameIn(const XmlElement& e, const char* attribute) const {
    const char* const name = e.Attribute(attribute);
    if (name && *name != '\0') return name;
    warn(e, std::string("it is left out, as it has no ") + attribute + ".");
    return "";
  }

  /// Adds all but the groups of which it is made.
  void add(const XmlElement& element, const std::string& name) {
    UrdfGroup& group = robot_.groups[name];
    for (const XmlElement* e = element.FirstChildElement(); e; e = e->NextSiblingElement()) {
      const std::string kind = e->Name();
      if (kind == "chain") {
        addChain(*e, group);
      } else if (kind == "joint" || kind == "link") {
        addNamed(*e, kind == "joint", group);
      } else if (kind == "group") {
        const std::string other = nameIn(*e, "name");
        if (elements_.count(other) != 0) {
          users_[other].push_back(name);
          ++waits_for_[name];
        } else if (!other.empty()) {
          warn(*e, "there is no group '" + other + "'.");
        }
      }
    }
  }

  /// Groups come once all groups in them are complete.
  void addSubgroups() {
    std::vector<std::string> complete;
    for (const auto& [name, elements] : elements_) {
      if (waits_for_[name] == 0) complete.push_back(name);
    }
    while (!complete.empty()) {
      const std::string name = complete.back();
      complete.pop_back();
      const UrdfGroup& part = robot_.groups[name];
      for (const std::string& user : users_[name]) {
        UrdfGroup& whole = robot_.groups[user];
        whole.joints.insert(part.joints.begin(), part.joints.end());
        whole.links.insert(part.links.begin(), part.links.end());
        if (--waits_for_[user] == 0) complete.push_back(user);
      }
    }
    for (const auto& [name, count] : waits_for_) {
      if (count == 0) continue;
      warn(*elements_[name][0], "groups that contain themselves are left out of it.");
    }
  }

  void addNamed(const XmlElement& e, bool joint, UrdfGroup& group) const {
    const std::string name = nameIn(e, "name");
    if (name.empty()) return;
    for (std::size_t i = 0; i < robot_.joints.size(); ++i) {
      const UrdfJoint& known = robot_.joints[i];
      if ((joint ? known.name : robot_.links[known.child].name) == name) {
        return addJoint(static_cast<int>(i), group);
      }
    }
    if (!joint && robot_.linkOf(name) >= 0) {
      group.links.insert(robot_.linkOf(name));
    } else if (virtual_joints_.count(name) == 0) {
      warn(e, "there is no " + std::string(joint ? "joint" : "link") + " '" + name + "' of " +
                  robot_.name + ".");
    }
  }

  /// The joints on the way between two links, of which neither need carry the other.
  void addChain(const XmlElement& e, UrdfGroup& group) const {
    std::vector<int> ways[2];
    for (const int end : {0, 1}) {
      const std::string name = nameIn(e, end == 0 ? "base_link" : "tip_link");
      if (name.empty()) return;
      const int link = robot_.linkOf(name);
      if (link < 0) return warn(e, "there is no link '" + name + "' of " + robot_.name + ".");
      ways[end] = wayTo(link);
    }
    while (!ways[0].empty() && !ways[1].empty() && ways[0].back() == ways[1].back()) {
      ways[0].pop_back();
      ways[1].pop_back();
    }
    for (const std::vector<int>& way : ways) {
      for (const int joint : way) addJoint(joint, group);
    }
  }

  /// The joints that carry a link, the root's last.
  std::vector<int> wayTo(int link) const {
    std::vector<int> way;
    for (;;) {
      const auto joint = std::find_if(robot_.joints.begin(), robot_.joints.end(),
                                      [&](const UrdfJoint& known) { return known.child == link; });
      if (joint == robot_.joints.end()) return way;
      way.push_back(static_cast<int>(joint - robot_.joints.begin()));
      link = joint->parent;
    }
  }

  void addJoint(int joint, UrdfGroup& group) const {
    group.joints.insert(joint);
    group.links.insert(robot_.joints[joint].child);
  }

  const XmlFile& xml_;
  Description& robot_;
  const std::set<std::string>& virtual_joints_;
  std::map<std::string, std::vector<const XmlElement*>> elements_;
  std::map<std::string, std::vector<std::string>> users_;  // groups, by one that they contain
  std::map<std::string, int> waits_for_;                   // how many groups
};

}  // namespace

void readSrdf(const std::string& file, Description& robot) {
  const XmlFile xml(file, "robot");
  const XmlElement& root = xml.root();
  if (root.FirstChildElement("link") != nullptr) {
    xml.refuse(root, "it has links: it is a URDF, but an SRDF is asked for.");
  }
  const auto pairOf = [&](const XmlElement& e) {
    const std::string first = xml.attribute(e, "link1");
    return namePair(first, xml.attribute(e, "link2"));
  };
  const auto allow = [&](const NamePair& pair, const char* reason) {
    robot.allowed.insert(pair);
    robot.reasons[pair] = reason;
  };
  // MoveIt 2: links that may touch every other link, but for the pairs that are enabled again.
  for (const XmlElement* e = root.FirstChildElement("disable_default_collisions"); e;
       e = e->NextSiblingElement("disable_default_collisions")) {
    const std::string link = xml.attribute(*e, "link");
    for (const UrdfLink& other : robot.links) {
      if (other.name != link) allow(namePair(link, other.name), "User");
    }
  }
  for (const XmlElement* e = root.FirstChildElement("enable_collisions"); e;
       e = e->NextSiblingElement("enable_collisions")) {
    robot.allowed.erase(pairOf(*e));
    robot.reasons.erase(pairOf(*e));
  }
  for (const XmlElement* e = root.FirstChildElement("disable_collisions"); e;
       e = e->NextSiblingElement("disable_collisions")) {
    const char* const reason = e->Attribute("reason");
    allow(pairOf(*e), reason ? reason : "User");
  }
  for (const XmlElement* e = root.FirstChildElement(); e; e = e->NextSiblingElement()) {
    const std::string kind = e->Name();
    if (kind.find("_collisions") != std::string::npos) continue;
    tinyxml2::XMLPrinter printer(nullptr, false, 1);
    e->Accept(&printer);
    robot.srdf.emplace_back(printer.CStr());
  }
  const char* const name = root.Attribute("name");
  if (name && name != robot.name) {
    robot.warnings.push_back(xml.at(root, "it is of another robot than '" + robot.name + "'."));
  }
  for (const char* const element :
       {"disable_default_collisions", "enable_collisions", "disable_collisions"}) {
    for (const XmlElement* e = root.FirstChildElement(element); e;
         e = e->NextSiblingElement(element)) {
      for (const char* const attribute : {"link", "link1", "link2"}) {
        const char* const link = e->Attribute(attribute);
        if (!link || robot.linkOf(link) >= 0) continue;
        robot.warnings.push_back(
            xml.at(*e, "there is no link '" + std::string(link) + "' of " + robot.name + "."));
      }
    }
  }
  std::set<std::string> virtual_joints;  // of the robot's base and the world
  for (const XmlElement* e = root.FirstChildElement("virtual_joint"); e;
       e = e->NextSiblingElement("virtual_joint")) {
    virtual_joints.insert(xml.attribute(*e, "name"));
  }
  GroupReader(xml, robot, virtual_joints).read();
  for (const XmlElement* e = root.FirstChildElement("group_state"); e;
       e = e->NextSiblingElement("group_state")) {
    auto& values = robot.states[xml.attribute(*e, "name")];
    for (const XmlElement* j = e->FirstChildElement("joint"); j;
         j = j->NextSiblingElement("joint")) {
      if (virtual_joints.count(xml.attribute(*j, "name")) != 0) continue;
      const std::string text = xml.attribute(*j, "value");
      std::vector<double>& numbers = values[xml.attribute(*j, "name")];
      numbers.clear();
      constexpr int kMost = 7;
      for (int count = 1; count <= kMost && numbers.empty(); ++count) {
        double read[kMost];
        if (parseNumbers(text, count, read)) numbers.assign(read, read + count);
      }
      if (numbers.empty())
        xml.refuse(*j, "its value must be finite numbers, but is '" + text + "'.");
    }
  }
}

}  // namespace kios::robot
