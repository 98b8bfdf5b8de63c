// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/math/bv/utility.h>
#include "fcl_kios/detail/motion_bounds.h"
#include "fcl_kios/volume.h"

// The specialisations through which FCL's generic code handles kios::kIOS as a volume. They stand
// in the header that defines BVHModel<kIOS>, as a later one would violate the ODR.

namespace kios {

template <typename S>
struct Members;

/// Converts the volume, in the frame that X maps to, to an oriented box along the caps' axes.
template <typename S>
fcl::OBB<S> toOBB(const kIOS<S>& bv, const fcl::Transform3<S>& X);
/// Returns the box along the axes of the frame that X maps to: the intersection of the spheres'
/// boxes.
template <typename S>
fcl::AABB<S> toAABB(const kIOS<S>& bv, const fcl::Transform3<S>& X);

}  // namespace kios

namespace fcl {

/// Spheres have no orientation that a traversal could use.
template <typename S>
struct GetOrientationImpl<S, kios::kIOS<S>> {
  static Matrix3<S> run(const kios::kIOS<S>& /*bv*/) { return Matrix3<S>::Identity(); }
};

/// makeParentRelative() keeps every volume in the model's frame: spheres need no rotation to be
/// tested, so there is nothing to save, and queries and refits afterwards stay right.
template <typename S>
struct MakeParentRelativeRecurseImpl<S, kios::kIOS<S>> {
  static void run(BVHModel<kios::kIOS<S>>& /*model*/, int /*bv_id*/,
                  const Matrix3<S>& /*parent_axis*/, const Vector3<S>& /*parent_c*/) {}
  /// Serves the library alone: FCL befriends this class, and no other that could be ours.
  static kios::Members<S> membersOf(BVHModel<kios::kIOS<S>>& model);
  static void refit(BVHModel<kios::kIOS<S>>& model) { model.refitTree(/*bottomup=*/true); }
};

namespace detail {

/// Serves fcl::fit() with a kIOS.
template <typename S>
struct Fitter<S, kios::kIOS<S>> {
  static void fit(const Vector3<S>* const points, int n, kios::kIOS<S>& bv) {
    kios::fit(points, n, bv);
  }
};

/// Serves fcl::convertBV() from a kIOS, tight along its caps.
template <typename S>
class ConvertBVImpl<S, kios::kIOS<S>, AABB<S>> {
 public:
  static void run(const kios::kIOS<S>& bv1, const Transform3<S>& tf1, AABB<S>& bv2) {
    bv2 = kios::toAABB(bv1, tf1);
  }
};
template <typename S>
class ConvertBVImpl<S, kios::kIOS<S>, OBB<S>> {
 public:
  static void run(const kios::kIOS<S>& bv1, const Transform3<S>& tf1, OBB<S>& bv2) {
    bv2 = kios::toOBB(bv1, tf1);
  }
};

}  // namespace detail
}  // namespace fcl
