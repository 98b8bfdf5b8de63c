// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "fcl_kios/detail/counts.h"
#include "tree/tree.h"
#include "volume/rounding.h"

// The types that the SIMD search for the triangles nearest to a solid shares with the exact stage.

namespace kios::engine {

/// {n x <= offset} contains the solid: n has length 1 in the solid's frame.
struct FloatSlab {
  float n[3] = {};
  float offset = kInfinityFloat;
};

/// A solid in a tree's frame, by which points and boxes are told apart from it. Its box contains
/// all of the core that is nearest to anything in the tree; a ball's is a point, a capsule's a
/// segment.
///
/// u = 2^-24, S = reach + |box centre|_1 + the lengths of the solid, or of a half-space or plane:
/// reach + |offset|. R maps the tree's frame to the solid's, and stretches by at most 1 + stretch.
/// Against exact arithmetic on the model's own vertices in the solid's frame:
/// - vertices stored in float: u reach a coordinate; spheres contain what is stored;
/// - the difference from the centre, rounded itself: 2 u S a coordinate; its coordinates along the
///   rows of R, rounded: 5 u |p - c| each, 9 u S as a vector;
/// - middle +- half of spheres: u S. Closed forms of distances along those coordinates: a box's
///   squares, sum and root 3 u S. A cylinder's and a cone's take the root of two squares first, a
///   radius, u r, and products with the direction of the slanted side, 4 u S; where on that side
///   the nearest point lies is off by 6 u S, which only turns the difference: 16 u S in all;
/// - an ellipsoid's slab n: n x by 4 u S, the support by 6 u S, the quotient by 2 u S; any other
///   slab: n rounded 2 u reach, n x 4 u reach, the offset 2 u S. That of one across a triangle of
///   the tree lies between heights of the triangle and of a point of the box, if it proves
///   anything; where other slabs are added, S has the solid's reach;
/// - margin and radius are subtracted: 3 u S.
/// All in all below 40 u S. `pad` has 64 u S, which also covers the rounding of thresholds.
/// - the double rounding of the posed points, in both ways of posing them: below, as float_frame.h;
/// - R is a rotation only to `stretch`: 2 stretch S.
/// Boxes: the solid's box as the box that is moved in float_frame.h, by one rounding of R, and the
/// nodes' as those that stand still: `box_pad` has its 128 u S in the place of 64.
struct FloatSolid {
  enum class Form : std::uint8_t {
    kBox,        ///< and balls and capsules: all within `margin` of a box
    kCylinder,   ///< of `radius` about the box's third axis, as long as the box
    kCone,       ///< its apex at the end of that axis
    kEllipsoid,  ///< of radii that are the box's halves
    kContained,  ///< by the box
    kHalfspace,  ///< {normal x <= offset}: there is no box
    kPlane       ///< {normal x = offset}
  };
  Form form;
  bool tells_inside;  ///< points within the solid by more than the pad are told
  Box box;            ///< the axes: rows of R
  float margin;
  float radius;
  float slant_radial, slant_axial, slant_length;  ///< cone: unit normal of its side, the side
  float normal[3], offset;
  float pad;      ///< of bounds of points and spheres
  float box_pad;  ///< of bounds of boxes
};

/// The exact side of a search.
class SolidEvaluator {
 public:
  /// Evaluates a triangle, which may lower `cull_distance` and set the slab. `meets`: it is proven
  /// to have a point in common with the solid. Returns true to end the search.
  virtual bool evaluate(std::uint32_t triangle, bool meets) = 0;

  float cull_distance;  ///< triangles at least so far away don't matter; 0: those that don't touch
  FloatSlab slab;       ///< of the solid: best across what is nearest so far

  /// Adds a slab of a solid that its box says little of, across some triangle: the last few are
  /// kept.
  void addSlab(const FloatSlab& added) {
    if (slabs_.size() < kMostSlabs) {
      slabs_.push_back(added);
    } else {
      slabs_[num_added_ % kMostSlabs] = added;
    }
    ++num_added_;
  }
  /// Takes all slabs that matter in the place of such.
  void setSlabs(std::vector<FloatSlab> slabs) { slabs_ = std::move(slabs); }
  const std::vector<FloatSlab>& slabs() const { return slabs_; }
  std::uint32_t numAdded() const { return num_added_; }

 protected:
  ~SolidEvaluator() = default;

 private:
  static constexpr std::uint32_t kMostSlabs = 16;  ///< any from 8 on do as well

  std::vector<FloatSlab> slabs_;
  std::uint32_t num_added_ = 0;
};

/// Hears of every bound of a search for triangles near a solid, for tests.
class SolidAudit {
 public:
  /// What a node contains, or a triangle (by its index), is at least `bound` away, or meets the
  /// solid.
  virtual void boundNode(std::uint32_t node, float bound) = 0;
  virtual void boundTriangle(std::uint32_t triangle, float bound, bool meets) = 0;

 protected:
  ~SolidAudit() = default;
};

struct SolidSearch {
  const Tree& tree;
  const FloatSolid& solid;
  SolidEvaluator& evaluator;
  SearchCounts& counts;
  SolidAudit* audit = nullptr;
};

}  // namespace kios::engine
