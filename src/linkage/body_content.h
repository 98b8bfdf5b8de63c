// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "continuous/occupied_box.h"
#include "fcl_kios/model.h"
#include "linkage/support.h"
#include "model/prepared.h"
#include "shape/solid.h"

namespace kios::articulated {

/// Two simple sets, each of which contains a body's whole content, in one frame: a ball, and a
/// capsule, which is much nearer to a long link. Radii are rounded up.
struct ContentBound {  // NOLINT(bugprone-reserved-identifier): in the copy of an array
  fcl::Vector3d center = fcl::Vector3d::Zero();
  double radius = 0;
  fcl::Vector3d ends[2] = {fcl::Vector3d::Zero(), fcl::Vector3d::Zero()};
  double capsule_radius = 0;

  /// >= |x| of every point x.
  double reach() const;
};

/// The bound of the hull of `points`, of which there is one at least, each grown by `margin`. The
/// ball is around `center`.
ContentBound boundOf(const std::vector<fcl::Vector3d>& points, double margin,
                     const fcl::Vector3d& center);

enum class BodyKind { kMesh, kShape, kOctree };

/// A body's geometry in its own frame, as it was when it was added. Immutable: bodies of any pose
/// and copies of a linkage share it.
struct Content {
  std::shared_ptr<const fcl::CollisionGeometryd> geometry;
  BodyKind kind = BodyKind::kMesh;
  const Modeld* model = nullptr;  ///< of a mesh
  shape::Solid solid;             ///< of a shape
  bool bounded = true;            ///< half-spaces and planes are not
  bool occupied = true;
  bool meets = true;  ///< false: it isn't occupied, or an octree without cells
  ContentBound content;
  double size = 0;                   ///< >= |x|_1 of every point of what bounds the content
  SupportTable supports;             ///< empty if unbounded
  ModelState state;                  ///< of a mesh when it was added
  std::vector<double> shape_values;  ///< likewise of a shape; see model/shape_values.h
#if FCL_HAVE_OCTOMAP
  Eigen::AlignedBox3d cells;  ///< of an octree, when its content was measured
#endif

  /// Throws std::invalid_argument if the geometry is null, not served or too large.
  explicit Content(std::shared_ptr<const fcl::CollisionGeometryd> of);
  /// Throws std::invalid_argument, naming the body, if what was measured is not so any more.
  /// Octrees may change.
  void requireUnchanged(std::size_t id) const;
  /// True unless the body is an octree with cells outside of those that were measured.
  bool holdsCells() const;
};

/// The bound of a content that is moved to X, of which the rotation is orthonormal to 16 u.
ContentBound placed(const Content& body, const fcl::Transform3d& X);

}  // namespace kios::articulated
