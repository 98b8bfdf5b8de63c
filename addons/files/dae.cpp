// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// COLLADA. assimp keeps floats, crashes or guesses where a count is missing, and leaves out without
// a word what a name doesn't lead to.
#include <tinyxml2.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cstdint>
#include <cstring>
#include <map>
#include <stdexcept>
#include <type_traits>

#include "input.h"

namespace kios::files {
namespace {

using tinyxml2::XMLElement;

/// The most vertices and corners that copies of nodes may add to those of the file.
constexpr std::size_t kMostPlaced = std::size_t{1} << 23;

struct Geometry {
  std::vector<fcl::Vector3d> vertices;
  std::vector<std::size_t> corners, sizes;  ///< of all polygons
  int parts = 0;
  std::size_t others = 0;  ///< lines
};

class Dae {
 public:
  explicit Dae(const Input& input) : input_(input), faces_(input) {}

  Mesh read() {
    if (document_.Parse(input_.content.data(), input_.content.size()) != tinyxml2::XML_SUCCESS) {
      input_.refuse(nullptr, "line " + std::to_string(document_.ErrorLineNum()) +
                                 ": it is no well-formed XML (" + document_.ErrorName() + ").");
    }
    if (!document_.RootElement()) input_.refuse(nullptr, "it is XML without an element.");
    const XMLElement& root = *document_.RootElement();
    if (!is(root, "COLLADA")) fail(root, "stands where <COLLADA> is missing.");
    nameAll(root);
    double meter = 1;
    const XMLElement* const asset = root.FirstChildElement("asset");
    const XMLElement* const unit = asset ? asset->FirstChildElement("unit") : nullptr;
    if (unit && unit->Attribute("meter")) {
      meter = parse<double>(*unit, unit->Attribute("meter"), 1)[0];
      if (!(meter > 0)) fail(*unit, "has a meter that isn't positive.");
    }
    const XMLElement& scene = child(child(root, "scene"), "instance_visual_scene");
    placeNode(target(scene, "url", "visual_scene"), Eigen::Affine3d(Eigen::Scaling(meter)), 0);
    for (const auto& [name, n] : left_out_) {
      mesh_.warnings.push_back(input_.sentence(
          nullptr, counted(n, "element", "elements") + " <" + name + "> left out."));
    }
    faces_.finish(mesh_);
    return std::move(mesh_);
  }

 private:
  static bool is(const XMLElement& e, const char* name) { return std::strcmp(e.Name(), name) == 0; }

  [[noreturn]] void fail(const XMLElement& e, const std::string& what) const {
    throw std::invalid_argument(input_.name + ":" + std::to_string(e.GetLineNum()) + ": <" +
                                std::string(e.Name()).substr(0, 40) + "> " + what);
  }

  void nameAll(const XMLElement& e) {
    if (const char* const id = e.Attribute("id")) named_.emplace(id, &e);
    for (const XMLElement* c = e.FirstChildElement(); c; c = c->NextSiblingElement()) nameAll(*c);
  }

  const XMLElement& child(const XMLElement& e, const char* name) const {
    if (const XMLElement* const found = e.FirstChildElement(name)) return *found;
    fail(e, std::string("needs a <") + name + ">.");
  }

  /// The element that an attribute refers to.
  const XMLElement& target(const XMLElement& e, const char* attribute, const char* name) const {
    const char* const id = e.Attribute(attribute);
    const auto found = id && *id == '#' ? named_.find(id + 1) : named_.end();
    if (found != named_.end() && is(*found->second, name)) return *found->second;
    fail(e, std::string("needs the ") + attribute + " of a <" + name + "> of this file, but has " +
                quoted(id ? id : "") + ".");
  }

  /// All numbers of a text, of which `expected` must be there unless that is SIZE_MAX.
  template <typename Number>
  std::vector<Number> parse(const XMLElement& e, const char* text, std::size_t expected) const {
    std::vector<Number> numbers;
    const std::string_view all = text ? text : "";
    const char *at = all.data(), *const end = at + all.size();
    const auto isBlank = [](char c) { return c == ' ' || (c >= '\t' && c <= '\r'); };
    for (;;) {
      while (at != end && isBlank(*at)) ++at;
      if (at == end) break;
      const char* next = at;
      while (next != end && !isBlank(*next)) ++next;
      Number x = 0;
      if (parseNumber(at, next, x) != next || (std::is_integral_v<Number> && !(x >= 0))) {
        fail(e, "holds " + quoted({at, static_cast<std::size_t>(next - at)}) +
                    ", which is no finite number or no index.");
      }
      numbers.push_back(x);
      at = next;
    }
    if (expected != SIZE_MAX && numbers.size() != expected) {
      fail(e, "has " + std::to_string(numbers.size()) + " numbers where " +
                  std::to_string(expected) + " are counted; is the file cut off?");
    }
    return numbers;
  }

  std::size_t count(const XMLElement& e, const char* attribute, const char* otherwise = "") const {
    const char* const text = e.Attribute(attribute) ? e.Attribute(attribute) : otherwise;
    if (!*text) fail(e, std::string("needs the attribute ") + attribute + ".");
    const long long n = parse<long long>(e, text, 1)[0];
    if (n > INT32_MAX) fail(e, std::string("has a ") + attribute + " that is too large.");
    return static_cast<std::size_t>(n);
  }

  /// Appends the points of a <source>; the first one's number.
  std::size_t addPoints(const XMLElement& source, Geometry& geometry) const {
    const XMLElement& accessor = child(child(source, "technique_common"), "accessor");
    const XMLElement& array = target(accessor, "source", "float_array");
    const std::size_t n = count(accessor, "count"), stride = count(accessor, "stride", "1"),
                      offset = count(accessor, "offset", "0");
    const std::vector<double> x = parse<double>(array, array.GetText(), count(array, "count"));
    if (stride < 3 || (n > 0 && offset + (n - 1) * stride + 3 > x.size())) {
      fail(accessor, "reaches beyond its array, or gives no three coordinates.");
    }
    const std::size_t first = geometry.vertices.size();
    for (const double* p = x.data() + offset; geometry.vertices.size() < first + n; p += stride) {
      geometry.vertices.emplace_back(p[0], p[1], p[2]);
    }
    return first;
  }

  /// Appends the polygons of an element; nothing if it holds none.
  void addPolygons(const XMLElement& e, Geometry& geometry) {
    const bool triangles = is(e, "triangles"), list = is(e, "polylist"),
               strips = is(e, "tristrips"), fans = is(e, "trifans"),
               lines = is(e, "lines") || is(e, "linestrips");
    if (!triangles && !list && !strips && !fans && !lines && !is(e, "polygons")) return;
    const std::size_t n = count(e, "count");
    if (lines) geometry.others += n;
    if (lines || n == 0) return;
    ++geometry.parts;
    std::size_t stride = 0, at = SIZE_MAX, first = 0;
    for (const XMLElement* i = e.FirstChildElement("input"); i;
         i = i->NextSiblingElement("input")) {
      const std::size_t offset = count(*i, "offset");
      stride = std::max(stride, offset + 1);
      if (!i->Attribute("semantic", "VERTEX")) continue;
      at = offset;
      const XMLElement* position = &child(target(*i, "source", "vertices"), "input");
      while (position && !position->Attribute("semantic", "POSITION")) {
        position = position->NextSiblingElement("input");
      }
      if (!position) fail(*i, "leads to no POSITION.");
      first = addPoints(target(*position, "source", "source"), geometry);
    }
    if (at == SIZE_MAX) fail(e, "needs an <input semantic=\"VERTEX\">.");
    std::vector<std::size_t> corners;
    std::size_t ps = 0;
    for (const XMLElement* p = e.FirstChildElement("p"); p; p = p->NextSiblingElement("p"), ++ps) {
      const auto indices = parse<long long>(*p, p->GetText(), SIZE_MAX);
      if (indices.size() % stride != 0) fail(*p, "ends within a corner; is the file cut off?");
      corners.clear();
      for (std::size_t k = at; k < indices.size(); k += stride) {
        corners.push_back(first + static_cast<std::size_t>(indices[k]));
        if (first <= corners.back() && corners.back() < geometry.vertices.size()) continue;
        fail(*p, "refers to vertex " + std::to_string(indices[k]) + ", but there are " +
                     std::to_string(geometry.vertices.size() - first) + ".");
      }
      const auto add = [&](std::initializer_list<std::size_t> polygon) {
        for (const std::size_t k : polygon) geometry.corners.push_back(corners[k]);
        geometry.sizes.push_back(3);
      };
      if (strips || fans) {
        for (std::size_t k = 2; k < corners.size(); ++k) {
          add({fans ? 0 : k - 2 + k % 2, k - 1 - (strips ? k % 2 : 0), k});
        }
        continue;
      }
      geometry.corners.insert(geometry.corners.end(), corners.begin(), corners.end());
      if (triangles || list) {
        const std::vector<long long> sizes =
            list ? parse<long long>(child(e, "vcount"), child(e, "vcount").GetText(), n)
                 : std::vector<long long>(std::min(n, corners.size()), 3);
        std::size_t sum = 0;
        for (const long long size : sizes) sum += std::min<std::size_t>(size, corners.size() + 1);
        if (sizes.size() != n || sum != corners.size()) {
          fail(*p,
               "has " + std::to_string(corners.size()) + " corners, which isn't what is counted.");
        }
        geometry.sizes.insert(geometry.sizes.end(), sizes.begin(), sizes.end());
      } else {
        geometry.sizes.push_back(corners.size());
      }
    }
    for (const XMLElement* p = e.FirstChildElement("ph"); p;
         p = p->NextSiblingElement("ph"), ++ps) {
      ++left_out_["ph"];  // a polygon with holes
    }
    if (ps != (triangles || list ? 1 : n)) fail(e, "has another number of <p> than is counted.");
  }

  void placeGeometry(const XMLElement& e, const Eigen::Affine3d& X) {
    const auto [known, first_time] = geometries_.try_emplace(&e);
    Geometry& geometry = known->second;
    const XMLElement* const mesh = e.FirstChildElement("mesh");
    if (!mesh) ++left_out_[e.FirstChildElement() ? e.FirstChildElement()->Name() : "geometry"];
    if (mesh && first_time) {
      for (const XMLElement* c = mesh->FirstChildElement(); c; c = c->NextSiblingElement()) {
        addPolygons(*c, geometry);
      }
    }
    grow(e, geometry.vertices.size() + geometry.corners.size());
    const auto first = static_cast<long long>(mesh_.vertices.size());
    for (const fcl::Vector3d& v : geometry.vertices) {
      mesh_.vertices.emplace_back(X * v);
      if (!mesh_.vertices.back().allFinite()) fail(e, "is placed where nothing is finite.");
    }
    const bool mirrored = X.linear().determinant() < 0;  // its outside stays outside
    const std::size_t* corner = geometry.corners.data();
    for (const std::size_t size : geometry.sizes) {
      faces_.begin(nullptr);
      for (std::size_t k = 0; k < size; ++k) {
        faces_.add(first + static_cast<long long>(corner[mirrored ? size - 1 - k : k]));
      }
      corner += size;
    }
    mesh_.parts += geometry.parts;
    mesh_.other_faces += geometry.others;
  }

  void placeNode(const XMLElement& node, Eigen::Affine3d X, int depth) {
    if (depth > 100) fail(node, "is a hundred nodes deep, perhaps in a circle.");
    int object = -1;
    const auto place = [&](const XMLElement& geometry) {
      if (object < 0) {
        const char* const name =
            node.Attribute("name") ? node.Attribute("name") : node.Attribute("id");
        object = faces_.beginObject(name ? name : "");
      }
      faces_.resumeObject(object);
      placeGeometry(geometry, X);
    };
    grow(node, 64);
    for (const XMLElement* c = node.FirstChildElement(); c; c = c->NextSiblingElement()) {
      const auto numbers = [&](std::size_t n) { return parse<double>(*c, c->GetText(), n); };
      if (is(*c, "matrix")) {
        using Rows = Eigen::Matrix<double, 4, 4, Eigen::RowMajor>;
        X = X * Eigen::Affine3d(Eigen::Map<const Rows>(numbers(16).data()));
      } else if (is(*c, "translate")) {
        X.translate(Eigen::Map<const fcl::Vector3d>(numbers(3).data()));
      } else if (is(*c, "scale")) {
        X.scale(Eigen::Map<const fcl::Vector3d>(numbers(3).data()));
      } else if (is(*c, "rotate")) {
        const std::vector<double> r = numbers(4);
        const fcl::Vector3d axis(r[0], r[1], r[2]);
        if (axis.norm() > 0) X.rotate(Eigen::AngleAxisd(r[3] * M_PI / 180, axis.normalized()));
      } else if (is(*c, "lookat") || is(*c, "skew")) {
        fail(*c, "isn't read; give a <matrix>.");
      } else if (is(*c, "node")) {
        placeNode(*c, X, depth + 1);
      } else if (is(*c, "instance_node")) {
        placeNode(target(*c, "url", "node"), X, depth + 1);
      } else if (is(*c, "instance_geometry")) {
        place(target(*c, "url", "geometry"));
      } else if (is(*c, "instance_controller")) {  // the mesh as it was bound
        const XMLElement& controller = target(*c, "url", "controller");
        const XMLElement* const kind =
            controller.FirstChildElement(controller.FirstChildElement("skin") ? "skin" : "morph");
        if (!kind) fail(controller, "needs a <skin> or a <morph>.");
        place(target(*kind, "source", "geometry"));
        ++left_out_[kind->Name()];
      }
    }
  }

  void grow(const XMLElement& e, std::size_t by) {
    placed_ += by;
    if (placed_ > kMostPlaced + input_.content.size()) fail(e, "is placed too often.");
  }

  const Input& input_;
  Faces faces_;
  Mesh mesh_;
  tinyxml2::XMLDocument document_;
  std::map<std::string, const XMLElement*> named_;
  std::map<const XMLElement*, Geometry> geometries_;
  std::map<std::string, std::size_t> left_out_;
  std::size_t placed_ = 0;
};

}  // namespace

Mesh readDae(const Input& input) { return Dae(input).read(); }

}  // namespace kios::files
