// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <string>
#include <type_traits>
#include <vector>

#include "fcl_kios/detail/counts.h"
#include "fcl_kios/model.h"

namespace kios {

/// Names an edge of a mesh that keeps it from being a solid.
struct FaultyEdge {
  int triangle = -1;  ///< the first one at the edge; -1: there is no such edge
  /// The edge's ends in the model's frame, in that triangle's order.
  fcl::Vector3d from = fcl::Vector3d::Zero(), to = fcl::Vector3d::Zero();
};

/// Says what a mesh must be to have an inside, vertices of equal coordinates taken as one. A
/// triangle with two corners alike passes the edge between them once each way.
struct Closedness {
  /// There is an edge, and every edge belongs to an even number of triangles.
  bool closed = false;
  /// As many triangles run through every edge one way as the other, and no component is inside out:
  /// one whose normals point inwards is the wall of a cavity, and must lie within the others.
  bool oriented = false;
  int components = 0;         ///< of triangles that are connected by edges
  int open_edges = 0;         ///< of an odd number of triangles: of one, nearly always
  int misoriented_edges = 0;  ///< of an even number, not as many one way as the other
  int inside_out = 0;         ///< components; looked for where all edges are in order
  int edges = 0;              ///< between distinct vertices
  int branching_edges = 0;    ///< of more than two triangles
  int first_inside_out = -1;  ///< a triangle of the first such component
  /// Lists the first edges that are open or misoriented, by triangle.
  std::array<FaultyEdge, 3> first;

  bool isSolid() const { return closed && oriented; }
};

/// Examines whether a mesh may be a solid: O(n log n), and for each component whose normals point
/// inwards a look at the box of each other one, and O(log n) where it begins in that. Exact for all
/// finite coordinates, but where components wind inwards for those below 2^-960 of the largest.
/// Throws std::invalid_argument if the model is not a finished mesh.
template <typename S>
Closedness inspectClosedness(const Model<S>& model);
/// Examines a mesh without a model, its indices in range and its vertices finite.
template <typename S>
Closedness inspectClosedness(const std::vector<fcl::Vector3<S>>& vertices,
                             const std::vector<fcl::Triangle>& triangles);

/// Says what keeps a mesh from being a solid, as messages say it: the counts, and where the first
/// three edges are. Empty if nothing does.
std::string faultsOf(const Closedness& closedness);

// Meshes that have an inside. A mesh is a soup of triangles until it is marked: then a body within
// it is in contact with it, and overlap has a depth (penetration.h). Docs: docs/solids.md.

/// Declares that the mesh bounds a solid: the points round which it winds at least once, and its
/// surface. Throws std::invalid_argument, with the counts and the first three edges, unless
/// inspectClosedness() finds it closed and oriented; also if the model is not a finished mesh.
///
/// The mark stays with the model through replaces, updates and builds, and copies of the model get
/// it. Their ends examine the mesh again, in O(n log n): if the mesh has been opened, each query
/// throws until the mesh is closed again or unmarked. The calls that mark and unmark write to the
/// model: no query may use it meanwhile.
template <typename S>
void markSolid(Model<S>& model);

/// Makes a soup of it again. Copies keep their marks. Throws as markSolid() does.
template <typename S>
void unmarkSolid(Model<S>& model);

/// Returns true if the model is marked, and closed and oriented as it stands. Throws nothing.
template <typename S>
bool isSolid(const Model<S>& model);

/// Returns true if the point, given in the world, lies in the solid or on its surface. X_WM is the
/// model's pose. Exact for the point as mapped into the model's frame, R^-1 (p - T): the identity
/// maps exactly, other poses move a coordinate by at most 2^-48 |p - T|_1. A point is inside where
/// the mesh winds round it at least once, so that components may overlap, and cavities have walls
/// whose normals point into them.
///
/// One ray through the model's tree. Safe from many threads. Throws std::invalid_argument if the
/// model is not marked, has been opened or is unfinished, the pose is not rigid, or the point is
/// not finite.
template <typename S>
bool contains(const Model<S>& solid, const fcl::Transform3<S>& X_WM,
              const fcl::Vector3<std::common_type_t<S>>& point);

/// Options of penetration().
struct PenetrationRequest {
  /// Ends the search, for a shorter way out and a higher lower bound, once upper <= (1 + rel_gap)
  /// lower. >= 0.
  double rel_gap = 0.04;
  /// Ends the search after so many tests of a translation. It finds one in any case. >= 0.
  int max_tests = 48;
  /// If given, the work is added to it.
  SearchCounts* counts = nullptr;
};
using PenetrationOptions [[deprecated("now PenetrationRequest")]] = PenetrationRequest;

/// Brackets the length of the shortest translation that parts two solids.
struct PenetrationResult {
  double lower = 0;  ///< no shorter translation than this parts the interiors: proven
  double upper = 0;  ///< |translation|
  /// Moves solid 2, in the world: after it the surfaces are apart, neither solid is in the other,
  /// and so the interiors are disjoint. Proven, and zero only if they are disjoint already.
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();
  /// A point of solid 1's surface in the world that solid 2's surface all but touches after the
  /// translation. Zero if the interiors are disjoint already.
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
};
using Penetration [[deprecated("now PenetrationResult")]] = PenetrationResult;

/// Finds how deep two solids at poses in the world overlap: {0, 0, 0} where their interiors are
/// disjoint. Interiors that touch count as disjoint where a plane of a face at the contact parts
/// the solids, in exact arithmetic; else the bracket of touching ones is that of rounding.
///
/// Both bounds hold for the models' vertices in the common frame of docs/guarantees.md. For two
/// convex solids the bracket closes to rel_gap. For others `upper` is the least translation found
/// among those that take meeting triangles past planes of their faces and edges, or inner balls
/// past each other; which of the solids gives the frame is told by their content, so that the order
/// of the pair changes last bits alone. `lower` stems from a pair of balls of one centre, one in
/// each solid: the bracket may stay open. docs/solids.md has the proofs. Safe from many threads.
/// Throws std::invalid_argument if a model is not marked as a solid or has been opened since, a
/// pose is not rigid, or an option is out of range.
template <typename S>
PenetrationResult penetration(const Model<S>& solid1, const fcl::Transform3<S>& X_W1,
                              const Model<S>& solid2, const fcl::Transform3<S>& X_W2,
                              const PenetrationRequest& options = {});

/// Options of localDepth().
struct LocalDepthRequest {
  /// The search ends once upper - lower is at most the tolerance, rel_err * upper, or rounding: see
  /// localDepth() for that.
  double tolerance = 0;   ///< >= 0
  double rel_err = 0.01;  ///< in [0, 1)
  /// Ends the search, with what is proven then; >= 0. 64 visits of nodes and triangles count as a
  /// piece, too. One that waits takes 1 to 3 kB.
  long long max_pieces = 100000;
  /// If >= 0, the search ends, too, once lower > threshold or upper <= threshold: to tell a clash
  /// from a touch costs less than the depth.
  double threshold = -1;
};

/// Brackets how deep two solids lie in each other where that is deepest.
struct LocalDepthResult {
  double lower = 0;        ///< attained at `point`
  double upper = 0;        ///< no point is deeper: proven
  double point[3] = {};    ///< in the world; all three are set if lower > 0
  double nearest[3] = {};  ///< of the other's surface, or of both for a ball, in the world
  int surface_of = 0;      ///< 1 or 2: the solid on whose surface `point` is; 0: a ball's centre
  /// The bracket is as narrow as was asked, or the threshold was decided.
  bool complete = true;
};

/// Brackets the local depth of two solids at poses in the world: the largest of the distances to
/// solid 2's surface of points of solid 1's surface that lie in solid 2, the same with the solids
/// exchanged, and the radii of balls that lie in both. 0 if the solids don't meet. Unlike
/// penetration() it tells how far one has come into the other where the way out is long: faces that
/// are flush but for rounding are a rounding deep, a sheet through a block is as deep as the
/// block's middle, and two equal solids at one place are as deep as their largest ball.
///
/// Both bounds hold for the models' vertices, and include the rounding of the common frame of
/// docs/guarantees.md. Swapped arguments give the same bracket. Rounding ends the search at widths
/// of some 1e-12 of the coordinates and 200, at most 2000, |R^T R - I| of the poses' rotations
/// (Frobenius): for rotations that were rounded to float, some 2e-5 of the coordinates.
///
/// Where triangles of a solid may lie within it, as its components overlap, touch along faces or
/// run through each other along edges, or have no area, `lower` counts depths to these, too, and
/// the bracket often stays open; each model is examined for that at its first use. docs/solids.md
/// has the proofs. Safe from many threads. Throws std::invalid_argument if a model is not marked as
/// a solid or has been opened since, a pose is not rigid, an option is out of range, or the solids
/// are larger than 2^300 or smaller than 2^-300.
template <typename S>
LocalDepthResult localDepth(const Model<S>& solid1, const fcl::Transform3<S>& X_W1,
                            const Model<S>& solid2, const fcl::Transform3<S>& X_W2,
                            const LocalDepthRequest& request = {});

/// Returns true if the local depth of the solids exceeds t >= 0, false if it doesn't: both are
/// proven. Throws as localDepth() does, and std::runtime_error, with the bracket, if that can't be
/// decided within so many pieces: t is as near to the depth as rounding, or a solid has walls
/// within it. localDepth() with a threshold returns the bracket then.
template <typename S>
bool deeperThan(const Model<S>& solid1, const fcl::Transform3<S>& X_W1, const Model<S>& solid2,
                const fcl::Transform3<S>& X_W2, double t, long long max_pieces = 100000);

}  // namespace kios
