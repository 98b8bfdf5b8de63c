// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "query/nearest_on_mesh.h"
#include "query/pair_search.h"
#include "solid/components.h"
#include "solid/containment.h"
#include "solid/sides.h"
#include "solid/solid_pair.h"
#include "solid/tuning.h"
#include "triangle/predicates.h"
#include "volume/rounding.h"

namespace kios {
namespace {

/// Returns true if an edge of b lies in a's plane and runs through a's interior. Exact.
bool edgeRunsThrough(const TriangleVerticesd& a, const TriangleVerticesd& b) {
  const PairPredicates::Coordinates points = coordinatesOf(a, b);
  const PairPredicates exact(points);
  const int axis = exact.projectionAxis(0, 1, 2);
  const int turn = exact.orient2d(0, 1, 2, axis);
  for (int e = 0; e < 3; ++e) {
    const int i = 3 + e, j = 3 + kNext[e];
    if (exact.orient3d(0, 1, 2, i) != 0 || exact.orient3d(0, 1, 2, j) != 0) continue;
    // Open convex sets of a plane are disjoint if and only if the line of a side parts them.
    bool left = true, right = true, parted = false;
    for (int k = 0; k < 3; ++k) {
      const int side = exact.orient2d(i, j, k, axis);
      left &= side >= 0;
      right &= side <= 0;
      parted |= turn * exact.orient2d(k, kNext[k], i, axis) <= 0 &&
                turn * exact.orient2d(k, kNext[k], j, axis) <= 0;
    }
    if (!left && !right && !parted) return true;
  }
  return false;
}

/// The worst way in which triangles meet, which share no corners there: kTouch if they have only
/// points, or parts of edges of both, in common; kCross if one's interior has more, or if there are
/// too many pairs to tell.
Meeting worstMeeting(const Mesh& mesh) {
  const std::size_t most = tuning::kMeetings * mesh.numTriangles();
  std::size_t count = 0;
  const fcl::Transform3d X = fcl::Transform3d::Identity();
  const MeshPair itself(mesh, X, mesh, X);
  SearchCounts unused;
  Meeting worst = Meeting::kNone;
  visitTouching(
      itself,
      [&](const engine::TrianglePairIds& ids) {  // each pair in both orders
        if (ids.a >= ids.b) return false;
        const TriangleVerticesd a = itself.triangleA(ids.a), b = itself.triangleA(ids.b);
        const Meeting meeting = meetingOf(a, b);
        if (meeting == Meeting::kTouch) worst = meeting;
        if (meeting == Meeting::kCross || meeting == Meeting::kOverlap || ++count > most ||
            (meeting == Meeting::kTouch && (edgeRunsThrough(a, b) || edgeRunsThrough(b, a)))) {
          worst = Meeting::kCross;
        }
        return worst == Meeting::kCross;
      },
      unused);
  return worst;
}

/// Exact.
bool hasArea(const TriangleVerticesd& t) {
  const PairPredicates::Coordinates points = coordinatesOf(t, t);
  return PairPredicates(points).projectionAxis(0, 1, 2) >= 0;
}

/// Returns true if nothing lies before the triangle, and the solid behind it, at points so near to
/// its middle that no other triangle is as near; none if there are no such points.
std::optional<bool> partsInsideFromOutside(const Mesh& mesh, std::size_t triangle) {
  const TriangleVerticesd t = mesh.triangle(triangle);
  const fcl::Vector3d middle = (t[0] + t[1] + t[2]) / 3, n = normalOf(t);
  const double size = std::max((t[1] - t[0]).norm(), (t[2] - t[0]).norm());
  for (const int winding : {0, 1}) {
    bool told = false;
    for (double step = 1e-2 * size; step > 1e-9 * size && !told; step *= 0.05) {
      const fcl::Vector3d p = middle + (winding == 0 ? step : -step) * n;
      const NearestOnMesh near = nearestOnMesh(mesh, p, kInfinity);
      SearchCounts unused;
      told = near.triangle == static_cast<int>(triangle) && near.lower > 0.5 * step;
      if (told && placeOf(p, mesh, unused).winding != winding) return false;
    }
    if (!told) return std::nullopt;
  }
  return true;
}

}  // namespace

// Where the surface meets no triangle's interior but in points, the mesh winds equally often before
// all of that, and any place of it tells. Where triangles don't touch either, it winds equally
// often before all that are connected by edges of two. Those without area meet nothing, and so any
// may be a wall.
bool mayHaveInnerWalls(const Mesh& mesh, const Closedness& closedness) {
  for (std::size_t t = 0; t < mesh.numTriangles(); ++t) {
    if (!hasArea(mesh.triangle(t))) return true;
  }
  const Meeting worst = worstMeeting(mesh);
  if (worst == Meeting::kCross) return true;
  if (worst == Meeting::kTouch) {
    for (std::size_t t = 0; t < mesh.numTriangles(); ++t) {
      if (!partsInsideFromOutside(mesh, t).value_or(false)) return true;
    }
    return false;
  }
  if (closedness.components == 1 && closedness.branching_edges == 0) return false;
  const std::vector<std::uint32_t> welded = mesh.weld();
  const std::vector<Side> sides = sidesOf(mesh.numTriangles(), [&](std::size_t t) {
    return std::array{welded[mesh.index(t, 0)], welded[mesh.index(t, 1)], welded[mesh.index(t, 2)]};
  });
  const Parts parts = partsOf(sides, mesh.numTriangles(), false);
  return !std::all_of(parts.triangles.begin(), parts.triangles.end(), [&](const auto& part) {
    for (const int t : part) {
      const auto parts_them = partsInsideFromOutside(mesh, static_cast<std::size_t>(t));
      if (parts_them) return *parts_them;
    }
    return false;
  });
}

}  // namespace kios
