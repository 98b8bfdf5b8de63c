// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <tinyxml2.h>

#include <string>

#include <fcl/common/types.h>

namespace kios::robot {

/// A file in XML, and what its elements hold. Whatever is missing or wrong is refused with the
/// file, the line and the element.
class XmlFile {
 public:
  /// Throws std::invalid_argument if the file isn't well-formed XML whose root is <root>.
  XmlFile(const std::string& file, const char* root);

  using Element = tinyxml2::XMLElement;
  const Element& root() const { return *document_.RootElement(); }
  const std::string& name() const { return name_; }

  /// A sentence about an element: "file:line: <element>: what".
  std::string at(const Element& element, const std::string& what) const;
  /// Throws std::invalid_argument with such a sentence.
  [[noreturn]] void refuse(const Element& element, const std::string& what) const;

  /// The first child of a name; refused if there is none, or, if `single`, more than one.
  const Element& child(const Element& element, const char* name, bool single = true) const;
  /// Null if there is none; refused if there is more than one.
  const Element* optionalChild(const Element& element, const char* name) const;
  /// An attribute that must be there and not be empty.
  std::string attribute(const Element& element, const char* name) const;
  /// Finite numbers of an attribute.
  double number(const Element& element, const char* name) const;
  double number(const Element& element, const char* name, double otherwise) const;
  fcl::Vector3d vector(const Element& element, const char* name) const;
  fcl::Vector3d vector(const Element& element, const char* name,
                       const fcl::Vector3d& otherwise) const;
  /// That of a child <origin xyz="" rpy=""/>: turned about the fixed axes x, y, z; else identity.
  fcl::Transform3d origin(const Element& element) const;

 private:
  void read(const Element& element, const char* name, int count, double* numbers) const;

  std::string name_;
  tinyxml2::XMLDocument document_;
};

}  // namespace kios::robot
