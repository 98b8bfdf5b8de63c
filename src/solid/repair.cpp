// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "fcl_kios/repair.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <locale>
#include <sstream>
#include <type_traits>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include <Eigen/Geometry>
#include "solid/components.h"
#include "solid/face_set.h"
#include "volume/errors.h"
#include "volume/instantiate.h"
#include "volume/rounding.h"

namespace kios {
namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

void requireValid(const RepairRequest& options) {
  require(options.relative_weld >= 0 && options.relative_weld < 1, "RepairRequest::relative_weld",
          options.relative_weld, ">= 0 and < 1");
  require(options.absolute_weld >= 0, "RepairRequest::absolute_weld", options.absolute_weld,
          ">= 0");
  require(options.max_hole_edges >= 0 && options.max_hole_edges <= RepairRequest::kMostHoleEdges,
          "RepairRequest::max_hole_edges", options.max_hole_edges, "from 0 to 256");
  require(options.max_hole_perimeter >= 0, "RepairRequest::max_hole_perimeter",
          options.max_hole_perimeter, ">= 0");
}

/// The vertices that triangles use.
std::vector<bool> usedVertices(const std::vector<fcl::Vector3d>& vertices,
                               const std::vector<fcl::Triangle>& triangles) {
  std::vector<bool> used(vertices.size(), false);
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (int k = 0; k < 3; ++k) {
      const std::size_t v = triangles[t][k];
      if (v >= vertices.size()) {
        refuse("triangle ", t, " refers to vertex ", v, ", but there are ", vertices.size(), ".");
      }
      if (!vertices[v].allFinite()) {
        refuse("triangle ", t, " refers to vertex ", v, " (", vertices[v].transpose(),
               "), which is not finite.");
      }
      used[v] = true;
    }
  }
  return used;
}

/// The vertices that stay, in cubes as wide as the tolerance: near ones lie in the same or in
/// neighbouring cubes. Lengths are in parts of the box's longest side, so that squares neither
/// overflow nor vanish.
class StayingVertices {
 public:
  StayingVertices(const std::vector<fcl::Vector3d>& vertices, const Eigen::AlignedBox3d& box,
                  double side, double tolerance)
      : vertices_(vertices),
        low_(box.min()),
        side_(side),
        square_(tolerance * tolerance),
        // Wider by more than rounding, and not so small that indices overflow.
        cube_(std::max(tolerance * (1 + 0x1p-20), 0x1p-30)) {}

  /// Returns the nearest one within the tolerance, of equally near ones the first; -1 if there is
  /// none. Within 0 lie equal ones alone.
  int nearest(int vertex) const {
    const Cube at = cubeOf(scaled(vertex));
    int best = -1;
    double least = square_;
    for (int i = 0; i < 27; ++i) {
      const auto found = cubes_.find({at[0] + i % 3 - 1, at[1] + i / 3 % 3 - 1, at[2] + i / 9 - 1});
      if (found == cubes_.end()) continue;
      for (const int other : found->second) {
        const double square = ((point(other) - point(vertex)) / side_).squaredNorm();
        if (square > least || (square == least && best >= 0 && best < other)) continue;
        if (square_ == 0 && point(other) != point(vertex)) continue;
        least = square;
        best = other;
      }
    }
    return best;
  }
  void add(int vertex) { cubes_[cubeOf(scaled(vertex))].push_back(vertex); }

 private:
  using Cube = std::array<std::int64_t, 3>;
  struct Hash {
    std::size_t operator()(const Cube& c) const {
      std::uint64_t h = 0;
      for (const std::int64_t i : c) {
        h = (h ^ static_cast<std::uint64_t>(i)) * 0x9E3779B97F4A7C15U;
        h ^= h >> 32;
      }
      return h;
    }
  };

  const fcl::Vector3d& point(int vertex) const {
    return vertices_[static_cast<std::size_t>(vertex)];
  }
  fcl::Vector3d scaled(int vertex) const { return (point(vertex) - low_) / side_; }
  Cube cubeOf(const fcl::Vector3d& p) const {
    const auto place = [&](int i) { return static_cast<std::int64_t>(std::floor(p[i] / cube_)); };
    return {place(0), place(1), place(2)};
  }

  const std::vector<fcl::Vector3d>& vertices_;
  const fcl::Vector3d low_;
  const double side_, square_, cube_;
  std::unordered_map<Cube, std::vector<int>, Hash> cubes_;
};

/// Welds the vertices that are used: returns by vertex the one that stands for it, -1 for those
/// that aren't used, and tells `report` what it did. In the order of their indices, one that has
/// none within the tolerance that stays, stays; the others move to the nearest that stays. The
/// tolerance is the larger of `absolute` and `relative` times the diagonal of their box; if it is
/// 0, or `only_equal`, equal vertices alone are welded. Coordinates must be finite. Throws
/// std::invalid_argument if the box is too large for its size to be a number.
std::vector<int> weldNear(const std::vector<fcl::Vector3d>& vertices, const std::vector<bool>& used,
                          double relative, double absolute, bool only_equal,
                          RepairResultd& report) {
  std::vector<int> by(vertices.size(), -1);
  Eigen::AlignedBox3d box;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    if (used[i]) box.extend(vertices[i]);
  }
  if (box.isEmpty()) return by;
  double side = box.sizes().maxCoeff();
  if (!std::isfinite(side)) refuse("a mesh is too large to be repaired.");
  report.weld = std::max(absolute, relative * side * (box.sizes() / (side > 0 ? side : 1)).norm());
  if (!(side > 0)) side = 1;
  StayingVertices staying(vertices, box, side, only_equal ? 0 : std::min(report.weld / side, 2.0));
  const int count = static_cast<int>(vertices.size());
  for (int i = 0; i < count; ++i) {
    const auto at = static_cast<std::size_t>(i);
    if (!used[at] || staying.nearest(i) >= 0) continue;
    staying.add(i);
    by[at] = i;
  }
  for (int i = 0; i < count; ++i) {
    const auto at = static_cast<std::size_t>(i);
    if (!used[at] || by[at] == i) continue;
    by[at] = staying.nearest(i);
    ++report.welded_vertices;
    const auto &from = vertices[at], &to = vertices[static_cast<std::size_t>(by[at])];
    if (from == to) continue;
    ++report.moved_vertices;
    const double way = side * ((to - from) / side).norm();
    if (report.farthest_vertex >= 0 && !(way > report.farthest_weld)) continue;
    report.farthest_weld = way;
    report.farthest_vertex = i;
  }
  return by;
}

class Repair {
 public:
  Repair(const std::vector<fcl::Vector3d>& vertices, const std::vector<fcl::Triangle>& triangles,
         const RepairRequest& options)
      : vertices_(vertices),
        options_(options),
        used_(usedVertices(vertices, triangles)),
        vertex_by_(weldNear(vertices, used_, options.relative_weld, options.absolute_weld,
                            inspectClosedness(vertices, triangles).isSolid(), result_)),
        faces_(triangles, vertex_by_) {}

  RepairResultd run() {
    result_.degenerate_triangles = faces_.degenerate();
    result_.double_triangles = faces_.dropDoubles();
    faces_.turnNeighbours();
    const std::vector<std::vector<int>> open = fillHoles();
    turnOutwards();
    write(open);
    return std::move(result_);
  }

 private:
  const fcl::Vector3d& point(int vertex) const { return vertices_[at(vertex)]; }

  std::vector<fcl::Vector3d> pointsOf(const std::vector<int>& way) const {
    std::vector<fcl::Vector3d> points(way.size());
    std::transform(way.begin(), way.end(), points.begin(), [this](int v) { return point(v); });
    return points;
  }

  Hole holeOf(std::vector<int> way) const {
    const std::vector<fcl::Vector3d> corners = pointsOf(way);
    return {std::move(way), perimeterOf(corners)};
  }

  /// Fills those within the limits; returns the others.
  std::vector<std::vector<int>> fillHoles() {
    std::vector<std::vector<int>> open;
    std::unordered_set<std::uint64_t> edges;
    const auto edge = [](int a, int b) {
      return std::uint64_t{static_cast<std::uint32_t>(std::min(a, b))} << 32 |
             static_cast<std::uint32_t>(std::max(a, b));
    };
    const auto note = [&](const std::array<int, 3>& c) {
      for (std::size_t k = 0; k < 3; ++k) edges.insert(edge(c[k], c[(k + 1) % 3]));
    };
    for (std::vector<int>& way : faces_.holes()) {
      Hole hole = holeOf(std::move(way));
      if (hole.vertices.size() > at(options_.max_hole_edges) ||
          !(hole.perimeter <= options_.max_hole_perimeter)) {
        open.push_back(std::move(hole.vertices));
        continue;
      }
      if (edges.empty()) {
        for (const FaceSet::Face& face : faces_.faces()) note(face.corners);
      }
      const auto avoid = [&](int i, int j) {
        return edges.count(edge(hole.vertices[at(i)], hole.vertices[at(j)])) != 0;
      };
      for (const auto& t : fillHole(pointsOf(hole.vertices), avoid)) {
        const std::array<int, 3> face = {hole.vertices[at(t[0])], hole.vertices[at(t[1])],
                                         hole.vertices[at(t[2])]};
        faces_.fill(face);
        note(face);
        ++result_.filled_triangles;
      }
      result_.filled.push_back(std::move(hole));
    }
    return open;
  }

  void flip(const FaceSet::Part& part) {
    for (const int f : part.faces) faces_.flip(at(f));
  }

  bool windsInwards(const FaceSet::Part& part) const {
    return windInwards(part.faces.size(), [&](std::size_t i) -> TriangleVerticesd {
      const auto& c = faces_.faces()[at(part.faces[i])].corners;
      return {point(c[0]), point(c[1]), point(c[2])};
    });
  }

  void turnOutwards() {
    // Parts that were turned have no direction of their own.
    for (const FaceSet::Part& part : faces_.closedParts(false)) {
      if (!part.as_given && windsInwards(part)) flip(part);
    }
    const std::vector<FaceSet::Part> parts = faces_.closedParts(true);
    std::vector<fcl::Triangle> triangles;
    std::vector<int> part_of;
    for (std::size_t p = 0; p < parts.size(); ++p) {
      for (const int f : parts[p].faces) {
        const auto& c = faces_.faces()[at(f)].corners;
        triangles.emplace_back(at(c[0]), at(c[1]), at(c[2]));
        part_of.push_back(static_cast<int>(p));
      }
    }
    const Mesh closed(engine::MeshView<double>{vertices_.data(), vertices_.size(), triangles.data(),
                                               triangles.size()});
    const Components components(closed);
    for (const int t : components.insideOut()) flip(parts[at(part_of[at(t)])]);
  }

  void write(const std::vector<std::vector<int>>& open) {
    // Vertices stay in their order.
    std::vector<int> number(vertices_.size(), -1);
    for (const FaceSet::Face& face : faces_.faces()) {
      for (const int v : face.corners) number[at(v)] = 0;
    }
    for (std::size_t v = 0; v < vertices_.size(); ++v) {
      if (number[v] < 0) continue;
      number[v] = static_cast<int>(result_.vertices.size());
      result_.vertices.push_back(vertices_[v]);
    }
    for (const int by : vertex_by_) result_.vertex_of.push_back(by < 0 ? -1 : number[at(by)]);
    for (const FaceSet::Face& face : faces_.faces()) {
      const auto& c = face.corners;
      result_.triangles.emplace_back(at(number[at(c[0])]), at(number[at(c[1])]),
                                     at(number[at(c[2])]));
      result_.triangle_of.push_back(face.given);
      if (face.given >= 0 && face.flipped) ++result_.flipped_triangles;
    }
    const auto renumber = [&](Hole& hole) {
      for (int& v : hole.vertices) v = number[at(v)];
    };
    for (Hole& hole : result_.filled) renumber(hole);
    for (const std::vector<int>& way : open) {
      result_.open.push_back(holeOf(way));
      renumber(result_.open.back());
    }
    result_.closedness = inspectClosedness(result_.vertices, result_.triangles);
  }

  const std::vector<fcl::Vector3d>& vertices_;
  const RepairRequest& options_;
  RepairResultd result_;
  const std::vector<bool> used_;
  const std::vector<int> vertex_by_;  ///< which stands for it; a solid stays as it is
  FaceSet faces_;
};

template <typename Number>
std::string counted(Number n, const char* one, const char* many) {
  return std::to_string(n) + " " + (n == 1 ? one : many);
}

}  // namespace

template <typename S>
RepairResult<S> repair(const std::vector<fcl::Vector3<S>>& vertices,
                       const std::vector<fcl::Triangle>& triangles, const RepairRequest& options) {
  requireValid(options);
  if constexpr (std::is_same<S, double>::value) {
    return Repair(vertices, triangles, options).run();
  } else {
    std::vector<fcl::Vector3d> in_double;
    in_double.reserve(vertices.size());
    for (const auto& p : vertices) in_double.push_back(p.template cast<double>());
    RepairResultd r = Repair(in_double, triangles, options).run();
    RepairResult<S> result;
    result.vertices.reserve(r.vertices.size());  // bit for bit those that were given
    for (const auto& p : r.vertices) result.vertices.push_back(roundedTo<S>(p));
    static_cast<RepairReport&>(result) = std::move(r);
    return result;
  }
}

std::string summaryOf(const RepairReport& r) {
  std::ostringstream text;
  text.imbue(std::locale::classic());
  const char* separator = "";
  const auto add = [&](auto n, const char* one, const char* many, const std::string& change) {
    if (n == 0) return;
    text << separator << counted(n, one, many) << change;
    separator = ", ";
  };
  add(r.welded_vertices, "vertex", "vertices", " welded");
  if (r.moved_vertices > 0) {
    text << " (" << r.moved_vertices << " moved, by at most " << r.farthest_weld << ")";
  }
  add(r.degenerate_triangles, "degenerate triangle", "degenerate triangles", " left out");
  add(r.double_triangles, "double triangle", "double triangles", " left out");
  add(r.flipped_triangles, "triangle", "triangles", " turned");
  add(r.filled.size(), "hole", "holes",
      " filled by " + counted(r.filled_triangles, "triangle", "triangles"));
  if (separator[0] == '\0') text << "nothing was changed";
  if (r.closedness.isSolid()) {
    text << "; it bounds a solid";
  } else {
    text << "; it bounds no solid: " << faultsOf(r.closedness);
    if (!r.open.empty()) {
      std::size_t most = 0;
      for (const Hole& hole : r.open) most = std::max(most, hole.vertices.size());
      text << "; " << counted(r.open.size(), "hole", "holes") << " left, of up to " << most
           << " edges";
    }
  }
  return text.str();
}

KIOS_INSTANTIATE_FUNCTION(repair);

}  // namespace kios
