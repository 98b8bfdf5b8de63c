// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "fcl_kios/solid/repair.h"

#include <algorithm>
#include <locale>
#include <sstream>
#include <unordered_set>
#include <utility>

#include "solid/components.h"
#include "solid/face_set.h"
#include "solid/hole_filling.h"
#include "solid/near_weld.h"
#include "volume/errors.h"
#include "volume/instantiate.h"

namespace kios {
namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

void requireValid(const RepairOptions& options) {
  require(options.relative_weld >= 0 && options.relative_weld < 1, "RepairOptions::relative_weld",
          options.relative_weld, ">= 0 and < 1");
  require(options.absolute_weld >= 0, "RepairOptions::absolute_weld", options.absolute_weld,
          ">= 0");
  require(options.max_hole_edges >= 0 && options.max_hole_edges <= RepairOptions::kMostHoleEdges,
          "RepairOptions::max_hole_edges", options.max_hole_edges, "from 0 to 256");
  require(options.max_hole_perimeter >= 0, "RepairOptions::max_hole_perimeter",
          options.max_hole_perimeter, ">= 0");
}

/// Returns the vertices that triangles use.
template <typename S>
std::vector<bool> usedVertices(const std::vector<fcl::Vector3<S>>& vertices,
                               const std::vector<fcl::Triangle>& triangles) {
  std::vector<bool> used(vertices.size(), false);
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (int k = 0; k < 3; ++k) {
      const std::size_t v = triangles[t][k];
      if (v < vertices.size() && vertices[v].allFinite()) {
        used[v] = true;
        continue;
      }
      if (v >= vertices.size()) {
        refuse("triangle ", t, " refers to vertex ", v, ", but there are ", vertices.size(), ".");
      }
      refuse("triangle ", t, " refers to vertex ", v, " (", vertices[v].transpose(),
             "), which is not finite.");
    }
  }
  return used;
}

template <typename S>
class Repair {
 public:
  Repair(const std::vector<fcl::Vector3<S>>& vertices, const std::vector<fcl::Triangle>& triangles,
         const RepairOptions& options)
      : vertices_(vertices),
        options_(options),
        used_(usedVertices(vertices, triangles)),
        weld_(weldNear(vertices, used_, options.relative_weld, options.absolute_weld,
                       inspectClosedness(vertices, triangles).isSolid())),
        faces_(triangles, weld_.by) {}

  Repaired<S> run() {
    result_.weld = weld_.tolerance;
    result_.welded_vertices = weld_.welded;
    result_.moved_vertices = weld_.moved;
    result_.farthest_weld = weld_.farthest;
    result_.farthest_vertex = weld_.farthest_vertex;
    result_.degenerate_triangles = faces_.degenerate();
    result_.double_triangles = faces_.dropDoubles();
    faces_.turnNeighbours();
    const std::vector<std::vector<int>> open = fillHoles();
    turnOutwards();
    write(open);
    return std::move(result_);
  }

 private:
  fcl::Vector3d point(int vertex) const { return vertices_[at(vertex)].template cast<double>(); }

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
    return windInwards(part.faces.size(), [&](std::size_t i) -> TriangleVertices<double> {
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
    const Components<S> components(
        {vertices_.data(), vertices_.size(), triangles.data(), triangles.size()});
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
    for (const int by : weld_.by) result_.vertex_of.push_back(by < 0 ? -1 : number[at(by)]);
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

  const std::vector<fcl::Vector3<S>>& vertices_;
  const RepairOptions& options_;
  const std::vector<bool> used_;
  const NearWeld weld_;  ///< a solid stays as it is
  FaceSet faces_;
  Repaired<S> result_;
};

template <typename Number>
std::string counted(Number n, const char* one, const char* many) {
  return std::to_string(n) + " " + (n == 1 ? one : many);
}

}  // namespace

template <typename S>
Repaired<S> repair(const std::vector<fcl::Vector3<S>>& vertices,
                   const std::vector<fcl::Triangle>& triangles, const RepairOptions& options) {
  requireValid(options);
  return Repair<S>(vertices, triangles, options).run();
}

template <typename S>
std::string summaryOf(const Repaired<S>& r) {
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
KIOS_INSTANTIATE_FUNCTION(summaryOf);

}  // namespace kios
