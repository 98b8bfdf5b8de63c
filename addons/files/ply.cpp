// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// PLY, text and binary of both byte orders. happly isn't in Debian, and assimp keeps floats.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "input.h"

namespace kios::files {
namespace {

/// The type of a number, by its place among the names; 0 where there is none.
using Type = std::size_t;

struct Property {
  std::string_view name;
  Type type = 0;
  Type count = 0;  ///< of a list
};

struct Element {
  std::string_view name;
  std::size_t count = 0;
  std::vector<Property> properties;
  const char* at = nullptr;
};

Type readType(Text& text) {
  static constexpr std::string_view kNames[][2] = {
      {"char", "int8"}, {"uchar", "uint8"}, {"short", "int16"},   {"ushort", "uint16"},
      {"int", "int32"}, {"uint", "uint32"}, {"float", "float32"}, {"double", "float64"}};
  const std::string_view word = text.word();
  Type type = 0;
  for (const auto& names : kNames) {
    ++type;
    if (word == names[0] || word == names[1]) return type;
  }
  text.refuse(quoted(word) + " is no type of a property.");
}

class Ply {
 public:
  explicit Ply(const Input& input) : input_(input), text_(input, 0), faces_(input) {}

  Mesh read() {
    readHead();
    for (const Element& element : elements_) readElement(element);
    if (kind_ == kAscii && !text_.ended()) text_.refuse("more follows than its head counts.");
    if (kind_ == kAscii) text_.warnOfOpenLine(mesh_);
    if (kind_ != kAscii && at_ != input_.end()) {
      const auto rest = static_cast<std::size_t>(input_.end() - at_);
      mesh_.warnings.push_back(input_.sentence(
          nullptr, counted(rest, "byte", "bytes") + " behind the last element left out."));
    }
    faces_.finish(mesh_);
    return std::move(mesh_);
  }

 private:
  enum Kind { kAscii, kLittle, kBig };

  void readHead() {
    if (text_.word() != "ply") text_.refuse("it doesn't begin with ply.");
    bool format = false;
    for (text_.nextLine();; text_.nextLine()) {
      if (text_.ended()) text_.refuse("the file is cut off: 'end_header' is missing.");
      const char* const line = text_.at();
      const std::string_view key = text_.word();
      if (key == "end_header") break;
      if (key == "comment" || key == "obj_info") continue;
      if (key == "format") {
        const std::string_view kind = text_.word();
        kind_ = kind == "ascii" ? kAscii : kind == "binary_little_endian" ? kLittle : kBig;
        if (kind_ == kBig && kind != "binary_big_endian") {
          text_.refuse(quoted(kind) + " is no format of PLY.");
        }
        text_.word();  // 1.0
        format = true;
      } else if (key == "element") {
        Element& element = elements_.emplace_back();
        element.name = text_.word();
        element.count = text_.count();
        element.at = line;
      } else if (key == "property" && !elements_.empty()) {
        Property& property = elements_.back().properties.emplace_back();
        const char* const type = text_.at();
        if (text_.word() == "list") {
          property.count = readType(text_);
        } else {
          text_.moveTo(type);
        }
        property.type = readType(text_);
        property.name = text_.word();
      } else {
        text_.moveTo(line);
        text_.refuse(quoted(key) + " has no place in the head of a PLY file.");
      }
      if (!text_.lineEnded()) text_.refuse("more than is expected in this line.");
    }
    if (!format) text_.refuse("its head has no format.");
    text_.nextLine();
    at_ = text_.place();
  }

  void readElement(const Element& element) {
    const bool vertex = element.name == "vertex", face = element.name == "face";
    int axes[3] = {-1, -1, -1};
    int corners = -1;
    for (int i = 0; i < static_cast<int>(element.properties.size()); ++i) {
      const Property& p = element.properties[i];
      const bool list = p.count != 0;
      if (p.name.size() == 1 && p.name >= "x" && p.name <= "z" && !list) axes[p.name[0] - 'x'] = i;
      if ((p.name == "vertex_indices" || p.name == "vertex_index") && list) corners = i;
    }
    if (vertex && (std::min({axes[0], axes[1], axes[2]}) < 0 || !mesh_.vertices.empty())) {
      input_.refuse(element.at, "vertices need x, y and z, once in a file.");
    }
    if (face && corners < 0) input_.refuse(element.at, "faces need a list vertex_indices.");
    if (element.properties.empty() && element.count > 0) {
      input_.refuse(element.at, "an element without properties.");
    }
    if (element.name == "edge") {
      mesh_.other_faces += element.count;
    } else if (!vertex && !face && element.count > 0) {
      mesh_.warnings.push_back(
          input_.sentence(element.at, "elements " + quoted(element.name) + " are left out."));
    }
    mesh_.parts += face && element.count > 0;
    for (element_ = &element, item_ = 0; item_ < element.count; ++item_) {
      if (kind_ == kAscii && text_.ended()) refuseCut();
      if (face) faces_.begin(kind_ == kAscii ? text_.at() : nullptr);
      fcl::Vector3d p = fcl::Vector3d::Zero();
      for (int i = 0; i < static_cast<int>(element.properties.size()); ++i) {
        const Property& property = element.properties[i];
        const bool list = property.count != 0;
        const long long n = list ? index(property.count) : 1;
        if (n < 0) refuseItem("a list of fewer than no values.");
        for (long long k = 0; k < n; ++k) {
          if (face && i == corners) {
            faces_.add(index(property.type));
          } else {
            const double x = value(property.type);
            for (int axis = 0; axis < 3; ++axis) {
              if (vertex && axes[axis] == i) p[axis] = x;
            }
          }
        }
      }
      if (kind_ == kAscii && !text_.lineEnded()) text_.refuse("more numbers than are expected.");
      if (vertex && !p.allFinite()) refuseItem("it is not finite; repair the mesh.");
      if (vertex) mesh_.vertices.push_back(p);
    }
  }

  long long index(Type type) {
    const double x = value(type);
    if (x != std::floor(x) || std::abs(x) > 0x1p53) refuseItem("an index that is no integer.");
    return static_cast<long long>(x);
  }

  double value(Type type) {
    static constexpr double (Ply::*kReaders[])() = {nullptr,
                                                    &Ply::bytes<std::int8_t>,
                                                    &Ply::bytes<std::uint8_t>,
                                                    &Ply::bytes<std::int16_t>,
                                                    &Ply::bytes<std::uint16_t>,
                                                    &Ply::bytes<std::int32_t>,
                                                    &Ply::bytes<std::uint32_t>,
                                                    &Ply::bytes<float>,
                                                    &Ply::bytes<double>};
    return kind_ == kAscii ? text_.number() : (this->*kReaders[type])();
  }

  template <typename Number>
  double bytes() {
    char b[sizeof(Number)];
    if (static_cast<std::size_t>(input_.end() - at_) < sizeof b) refuseCut();
    std::memcpy(b, at_, sizeof b);
    at_ += sizeof b;
    if (kind_ == kBig) std::reverse(b, b + sizeof b);  // the machine's order is little
    Number x;
    std::memcpy(&x, b, sizeof x);
    return static_cast<double>(x);
  }

  [[noreturn]] void refuseCut() {
    input_.refuse(nullptr, "the file is cut off: it has " + std::to_string(item_) + " of " +
                               std::to_string(element_->count) + " elements " +
                               quoted(element_->name) + ".");
  }

  [[noreturn]] void refuseItem(const std::string& what) {
    input_.refuse(kind_ == kAscii ? text_.at() : nullptr,
                  std::string(element_->name) + " " + std::to_string(item_) + ": " + what);
  }

  const Input& input_;
  Text text_;
  Faces faces_;
  Mesh mesh_;
  Kind kind_ = kAscii;
  std::vector<Element> elements_;
  const char* at_ = nullptr;  ///< in binary content
  const Element* element_ = nullptr;
  std::size_t item_ = 0;
};

}  // namespace

Mesh readPly(const Input& input) { return Ply(input).read(); }

}  // namespace kios::files
