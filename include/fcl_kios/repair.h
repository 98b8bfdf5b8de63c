// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include "fcl_kios/model.h"
#include "fcl_kios/solids.h"
#include "fcl_kios/triangle.h"

namespace kios {

/// Two triangles of a mesh that meet other than in the vertices and edges that they share.
struct SelfIntersection {
  int triangle_a, triangle_b;  ///< of the model, a < b
  Meeting kind;
};

/// The first `limit` pairs of triangles of a mesh that meet other than in shared vertices and
/// edges, by ids. Vertices of equal coordinates are shared. Triangles without area are left out.
/// Exact for all finite coordinates. O(n log n) where few do. Safe from many threads. Throws
/// std::invalid_argument if the model is not a finished mesh.
template <typename S>
std::vector<SelfIntersection> selfIntersections(
    const Model<S>& model, std::size_t limit = std::numeric_limits<std::size_t>::max());

/// Options of repair().
struct RepairRequest {
  /// Vertices that are at most so far apart become one: the larger of the two counts, a part of the
  /// diagonal of the mesh's box, and a length in its units. 0 and 0: only equal ones. >= 0; a part
  /// is < 1.
  double relative_weld = 1e-5;
  double absolute_weld = 0;
  /// Holes of at most so many edges, at most so long around in the mesh's units, are filled. 0:
  /// none is. >= 0, and at most kMostHoleEdges.
  int max_hole_edges = 0;
  double max_hole_perimeter = std::numeric_limits<double>::infinity();

  enum : int { kMostHoleEdges = 256 };
};
using RepairOptions [[deprecated("now RepairRequest")]] = RepairRequest;

/// A closed way along edges of one triangle each.
struct Hole {
  std::vector<int> vertices;  ///< of the repaired mesh, in the order that a triangle would fill it
  double perimeter = 0;
};

/// All that repair() did to make a mesh of another.
struct RepairReport {
  std::vector<fcl::Triangle> triangles;  ///< those that stay in their order, then those that fill
  std::vector<int> vertex_of;            ///< by given vertex; -1 if no triangle uses it
  std::vector<int> triangle_of;          ///< given one, by triangle; -1 for those that fill

  double weld = 0;           ///< the tolerance that counted, in the mesh's units
  int welded_vertices = 0;   ///< given vertices that another one stands for, equal ones included
  int moved_vertices = 0;    ///< of those, the ones that had other coordinates
  double farthest_weld = 0;  ///< the longest way that a vertex was moved, to rounding
  int farthest_vertex = -1;  ///< the given vertex that moved so far; -1 if none moved

  int degenerate_triangles = 0;  ///< left out: two corners became one
  int double_triangles = 0;      ///< left out: corners of another one
  int flipped_triangles = 0;     ///< of those that stay
  int filled_triangles = 0;      ///< added
  std::vector<Hole> filled;      ///< holes
  std::vector<Hole> open;        ///< holes that are left
  Closedness closedness;         ///< of the repaired mesh: whether markSolid() takes it
};
/// The mesh with it.
template <typename S>
struct RepairResult : RepairReport {
  std::vector<fcl::Vector3<S>> vertices;  ///< each one a vertex as it was given, bit for bit
};
using RepairResultd = RepairResult<double>;
using RepairResultf = RepairResult<float>;
template <typename S>
using Repaired [[deprecated("now RepairResult")]] = RepairResult<S>;
using Repairedd [[deprecated("now RepairResult")]] = RepairResultd;
using Repairedf [[deprecated("now RepairResult")]] = RepairResultf;

/// Makes a mesh fit for a solid, as far as possible without inventing geometry, and tells what it
/// changed. What bounds a solid stays as it is: equal vertices alone become one. Else, in this
/// order:
///
/// - Vertices are welded: each moves to the nearest that stays, within the tolerance, and those
///   that stay are farther apart than that. No vertex moves farther than the tolerance.
/// - Triangles with two equal corners are left out, and copies of a triangle, wound alike or
/// turned:
///   of a patch of copies, as far as nothing else meets at its edges, one of each stays where that
///   closes more edges. Closed is an edge through which as many triangles run one way as the other.
///   If all triangles have backs, the fronts stay. Triangles with three corners on a line stay, as
///   they join edges.
/// - Neighbours are turned to one side, across edges of two triangles.
/// - Holes within the limits are filled by the triangles of least area over their vertices, along
///   no edge that is there already if that can be. Whether they cut other triangles is not looked
///   at.
/// - A surface that is closed now is turned outwards by its signed volume, unless it was wound
///   inwards as given and lies within others: then it is the wall of a cavity.
///
/// The result depends on the input alone. O(n log n), and O(k^3) for a hole of k edges. Throws
/// std::invalid_argument if an index is out of range, a vertex not finite, or an option out of
/// range.
template <typename S>
RepairResult<S> repair(const std::vector<fcl::Vector3<S>>& vertices,
                       const std::vector<fcl::Triangle>& triangles,
                       const RepairRequest& options = {});

/// Says what was changed and what is left, in one sentence or two.
std::string summaryOf(const RepairReport& repaired);

}  // namespace kios
