// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "xml_file.h"

#include <Eigen/Geometry>
#include <cstdlib>
#include <cstring>
#include <string_view>

#include "files/input.h"
#include "text_file.h"

namespace kios::robot {

using Eigen::Vector3d;

namespace {

/// Refuses what isn't UTF-8, as names are strings of Python and JSON.
class RequireUtf8 : public tinyxml2::XMLVisitor {
 public:
  explicit RequireUtf8(const std::string& file) : file_(file) {}
  bool VisitEnter(const XmlFile::Element& /*element*/,
                  const tinyxml2::XMLAttribute* attribute) override {
    for (; attribute; attribute = attribute->Next()) {
      for (std::string_view rest = attribute->Value(); !rest.empty();) {
        const int length = files::lengthOfCharacter(rest);
        if (length == 0) {
          refuseAt(file_, attribute->GetLineNum(),
                   std::string("the attribute ") + attribute->Name() +
                       " isn't in UTF-8; convert the file to it.");
        }
        rest.remove_prefix(static_cast<std::size_t>(std::abs(length)));
      }
    }
    return true;
  }

 private:
  const std::string& file_;
};

}  // namespace

XmlFile::XmlFile(const std::string& file, const char* root) : name_(file) {
  const std::string content = contentOf(file);
  if (content.find('\0') != std::string::npos) {
    robot::refuse(file + ": it holds a zero byte, so it is no XML.");
  }
  if (document_.Parse(content.data(), content.size()) != tinyxml2::XML_SUCCESS) {
    refuseAt(file, document_.ErrorLineNum(),
             std::string("it is no well-formed XML (") + document_.ErrorName() +
                 "); a .xacro file must be expanded first.");
  }
  RequireUtf8 required(file);
  document_.Accept(&required);
  const Element* const top = document_.RootElement();
  if (!top || std::strcmp(top->Name(), root) != 0) {
    robot::refuse(file + ": its root element must be <" + root + ">" +
                  (top ? std::string(", but is <") + top->Name() + ">." : "."));
  }
  for (const Element* next = top->NextSiblingElement(); next; next = next->NextSiblingElement()) {
    refuse(*next, "a second root element; XML has one.");
  }
}

std::string XmlFile::at(const Element& element, const std::string& what) const {
  std::string place = name_ + ":" + std::to_string(element.GetLineNum()) + ": <" + element.Name();
  if (const char* const name = element.Attribute("name"))
    place += std::string(" name='") + name + "'";
  return place + ">: " + what;
}

void XmlFile::refuse(const Element& element, const std::string& what) const {
  robot::refuse(at(element, what));
}

const XmlFile::Element& XmlFile::child(const Element& element, const char* name,
                                       bool single) const {
  const Element* const found = element.FirstChildElement(name);
  if (!found) refuse(element, std::string("it needs a <") + name + ">.");
  if (single) optionalChild(element, name);
  return *found;
}

const XmlFile::Element* XmlFile::optionalChild(const Element& element, const char* name) const {
  const Element* const found = element.FirstChildElement(name);
  if (found && found->NextSiblingElement(name)) {
    refuse(*found->NextSiblingElement(name), "the second of its kind here; one is allowed.");
  }
  return found;
}

std::string XmlFile::attribute(const Element& element, const char* name) const {
  const char* const text = element.Attribute(name);
  if (!text || *text == '\0') {
    refuse(element, std::string("it needs the attribute ") + name + ".");
  }
  return text;
}

void XmlFile::read(const Element& element, const char* name, int count, double* numbers) const {
  const std::string text = attribute(element, name);
  if (parseNumbers(text, count, numbers)) return;
  refuse(element, std::string("its attribute ") + name + " must be " +
                      (count == 1 ? "one finite number" : "three finite numbers") + ", but is '" +
                      text.substr(0, 80) + "'.");
}

double XmlFile::number(const Element& element, const char* name) const {
  double x = 0;
  read(element, name, 1, &x);
  return x;
}

double XmlFile::number(const Element& element, const char* name, double otherwise) const {
  return element.Attribute(name) ? number(element, name) : otherwise;
}

Vector3d XmlFile::vector(const Element& element, const char* name) const {
  Vector3d v;
  read(element, name, 3, v.data());
  return v;
}

Vector3d XmlFile::vector(const Element& element, const char* name,
                         const Vector3d& otherwise) const {
  return element.Attribute(name) ? vector(element, name) : otherwise;
}

fcl::Transform3d XmlFile::origin(const Element& element) const {
  fcl::Transform3d X = fcl::Transform3d::Identity();
  const Element* const place = optionalChild(element, "origin");
  if (!place) return X;
  const Vector3d rpy = vector(*place, "rpy", Vector3d::Zero());
  X.linear() = (Eigen::AngleAxisd(rpy.z(), Vector3d::UnitZ()) *
                Eigen::AngleAxisd(rpy.y(), Vector3d::UnitY()) *
                Eigen::AngleAxisd(rpy.x(), Vector3d::UnitX()))
                   .toRotationMatrix();
  X.translation() = vector(*place, "xyz", Vector3d::Zero());
  return rigid(
      X, std::string("the origin in line ") + std::to_string(place->GetLineNum()) + " of " + name_);
}

}  // namespace kios::robot
