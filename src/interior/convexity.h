// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fcl_kios/model/model.h"
#include "interior/vertex_graph.h"

namespace kios {

/// How nearly a solid is the hull of its vertices.
///
/// A point strictly below the planes of all faces lies in the solid: it sees every face from
/// within, so that all solid angles are positive, and so is their sum, 4 pi times the winding
/// number. Let all vertices be at most e above each plane and c at least r below. Then the hull,
/// drawn towards c by the factor 1 - s, s = e / (r + e), is below all planes: n (c + (1 - s)(v -
/// c)) is at most s (o - r) + (1 - s)(o + e) = o.
struct Convexity {
  bool convex = false;  ///< s is at most 2^-20
  double moved = 0;     ///< >= the way of any vertex of the hull to its place in the solid
  VertexGraph graph;    ///< empty unless convex
};

/// The model must be a solid of one component.
template <typename S>
Convexity measureConvexity(const Model<S>& model);

}  // namespace kios
