// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <type_traits>

#include "fcl_kios/model/model.h"

// Meshes that have an inside. A mesh is a soup of triangles until it is marked: then a body within
// it is in contact with it, and overlap has a depth (penetration.h). Docs: docs/solids.md.

namespace kios {

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

}  // namespace kios
