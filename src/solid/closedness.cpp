// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "fcl_kios/solids.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <locale>
#include <memory>
#include <sstream>

#include <Eigen/Geometry>

#include "fcl_kios/model.h"
#include "model/kios_model.h"
#include "model/prepared.h"
#include "solid/components.h"
#include "solid/containment.h"
#include "triangle/integer.h"
#include "volume/instantiate.h"
#include "volume/rounding.h"

namespace kios {

// The sign of the volume, summed relative to a corner. Each term takes 8 roundings of its
// permanent, the sum one of what it adds up to for each term.
bool windInwards(std::size_t count, const CornersOf& corners_of) {
  const fcl::Vector3d origin = corners_of(0)[0];
  double volume = 0, permanents = 0;
  for (std::size_t t = 0; t < count; ++t) {
    const TriangleVerticesd corners = corners_of(t);
    const fcl::Vector3d p = corners[0] - origin, q = corners[1] - origin, r = corners[2] - origin;
    volume += p.dot(q.cross(r));
    permanents += std::abs(p[0]) * (std::abs(q[1] * r[2]) + std::abs(q[2] * r[1])) +
                  std::abs(p[1]) * (std::abs(q[2] * r[0]) + std::abs(q[0] * r[2])) +
                  std::abs(p[2]) * (std::abs(q[0] * r[1]) + std::abs(q[1] * r[0]));
  }
  const double error = (16 + static_cast<double>(count)) * 0x1p-52 * permanents;
  if (std::isfinite(volume) && permanents > 0x1p-900 && std::abs(volume) > error) return volume < 0;
  Integer exact = 0;
  const IntegerVector from = integers(origin);
  for (std::size_t t = 0; t < count; ++t) {
    const TriangleVerticesd p = corners_of(t);
    exact += dot(integers(p[0]) - from, cross(integers(p[1]) - from, integers(p[2]) - from));
  }
  return exact < 0;
}

// Triangles that are points have no side, and are of no component.
Components::Components(const Mesh& mesh) : mesh_(mesh) {
  const std::vector<std::uint32_t> welded = mesh.weld();
  const std::vector<Side> sides = sidesOf(mesh.numTriangles(), [&](std::size_t t) {
    return std::array{welded[mesh.index(t, 0)], welded[mesh.index(t, 1)], welded[mesh.index(t, 2)]};
  });
  triangles_ = partsOf(sides, mesh.numTriangles(), true).triangles;
  closedness_.components = static_cast<int>(triangles_.size());
  judgeEdges(sides);
  if (closedness_.closed && closedness_.oriented) findInsideOut();
}

void Components::judgeEdges(const std::vector<Side>& sides) {
  std::vector<const Side*> faulty;
  forEdges(sides, [&](std::size_t begin, std::size_t end) {
    int forward = 0;
    for (std::size_t i = begin; i < end; ++i) forward += sides[i].forward ? 1 : 0;
    const int count = static_cast<int>(end - begin);
    ++closedness_.edges;
    if (count > 2) ++closedness_.branching_edges;
    if (count % 2 == 1) {
      ++closedness_.open_edges;
    } else if (2 * forward != count) {
      ++closedness_.misoriented_edges;
    } else {
      return;
    }
    faulty.push_back(&sides[begin]);
  });
  const std::size_t shown = std::min(faulty.size(), closedness_.first.size());
  std::partial_sort(faulty.begin(), faulty.begin() + static_cast<std::ptrdiff_t>(shown),
                    faulty.end(), [](const Side* a, const Side* b) {
                      return a->triangle != b->triangle ? a->triangle < b->triangle
                                                        : a->corner < b->corner;
                    });
  for (std::size_t i = 0; i < shown; ++i) {
    const auto triangle = static_cast<std::size_t>(faulty[i]->triangle);
    const std::size_t corner = faulty[i]->corner;
    closedness_.first[i] = {faulty[i]->triangle, mesh_.corner(triangle, corner),
                            mesh_.corner(triangle, (corner + 1) % 3)};
  }
  closedness_.closed = closedness_.edges > 0 && closedness_.open_edges == 0;
  closedness_.oriented = closedness_.edges > 0 && closedness_.misoriented_edges == 0;
}

/// The corners of a component's triangles, scaled by a power of 2 so that no length overflows.
struct Components::Part {
  std::vector<fcl::Vector3d> corners;
  Eigen::AlignedBox3d box;
  std::shared_ptr<const Modeld> model;  ///< made where a point lies in the box

  // Returns true if the others wind round a vertex of the component that lies on none of them, or
  // each lies on others, so that nothing is proven wrong. None winds round points out of its box.
  static bool liesWithinOthers(std::vector<Part>& parts, const Part& own) {
    SearchCounts unused;
    for (const fcl::Vector3d& p : own.corners) {
      PointPlace place;
      for (Part& other : parts) {
        if (&other == &own || !other.box.contains(p)) continue;
        if (!other.model) {
          std::vector<fcl::Triangle> soup;
          for (std::size_t i = 0; i < other.corners.size(); i += 3)
            soup.emplace_back(i, i + 1, i + 2);
          other.model = makeModel(other.corners, soup);
        }
        const PointPlace here = placeOf(p, meshOf(*other.model), unused);
        place.winding += here.winding;
        place.on_surface |= here.on_surface;
      }
      if (!place.on_surface) return place.inside();
    }
    return true;
  }
};

void Components::findInsideOut() {
  std::vector<Part> parts;
  for (std::size_t c = 0; c < triangles_.size(); ++c) {
    const std::vector<int>& of_c = triangles_[c];
    inwards_.push_back(windInwards(of_c.size(), [&](std::size_t i) { return cornersOf(of_c[i]); }));
    if (!inwards_.back()) continue;
    if (parts.empty()) parts = makeParts();
    if (!Part::liesWithinOthers(parts, parts[c])) inside_out_.push_back(of_c.front());
  }
  closedness_.inside_out = static_cast<int>(inside_out_.size());
  if (!inside_out_.empty()) closedness_.first_inside_out = inside_out_.front();
  closedness_.oriented = inside_out_.empty();
}

std::vector<Components::Part> Components::makeParts() const {
  std::vector<Part> parts(triangles_.size());
  double largest = 0;
  for (std::size_t c = 0; c < parts.size(); ++c) {
    for (const int t : triangles_[c]) {
      for (const fcl::Vector3d& p : cornersOf(t)) {
        parts[c].corners.push_back(p);
        largest = std::max(largest, p.cwiseAbs().maxCoeff());
      }
    }
  }
  const int exponent = largest > 0 ? -std::ilogb(largest) : 0;
  for (Part& part : parts) {
    for (fcl::Vector3d& p : part.corners) {
      p = p.unaryExpr([exponent](double x) { return std::scalbn(x, exponent); }).eval();
      part.box.extend(p);
    }
  }
  return parts;
}

template <typename S>
Closedness inspectClosedness(const Model<S>& model) {
  return Components(meshOf(model)).closedness();
}

template <typename S>
Closedness inspectClosedness(const std::vector<fcl::Vector3<S>>& vertices,
                             const std::vector<fcl::Triangle>& triangles) {
  const engine::MeshView<S> mesh = {vertices.data(), vertices.size(), triangles.data(),
                                    triangles.size()};
  return Components(Mesh(mesh)).closedness();
}

std::string faultsOf(const Closedness& c) {
  if (c.isSolid()) return {};
  if (c.edges == 0) return "it has no edges";
  std::ostringstream text;
  text.imbue(std::locale::classic());
  const char* separator = "";
  const auto add = [&](int n, const char* one, const char* many) {
    if (n == 0) return;
    text << separator << n << " " << (n == 1 ? one : many);
    separator = ", ";
  };
  add(c.open_edges, "open edge", "open edges");
  add(c.misoriented_edges, "misoriented edge", "misoriented edges");
  add(c.inside_out, "component inside out", "components inside out");
  if (c.inside_out > 0) text << " (with triangle " << c.first_inside_out << ")";
  separator = "; the first: ";
  for (const FaultyEdge& edge : c.first) {
    if (edge.triangle < 0) break;
    text << separator << "triangle " << edge.triangle << ", (" << edge.from.transpose() << ") to ("
         << edge.to.transpose() << ")";
    separator = "; ";
  }
  return text.str();
}

template Closedness inspectClosedness(const Modeld&);
template Closedness inspectClosedness(const Modelf&);
template Closedness inspectClosedness(const std::vector<fcl::Vector3d>&,
                                      const std::vector<fcl::Triangle>&);
template Closedness inspectClosedness(const std::vector<fcl::Vector3f>&,
                                      const std::vector<fcl::Triangle>&);

}  // namespace kios
