// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "fcl_kios/detail/counts.h"
#include "search/mesh_pair.h"
#include "search/pair_query.h"
#include "solid/solid_mark.h"

namespace kios {

/// A triangle's unit normal; zero if it has none.
fcl::Vector3d normalOf(const TriangleVerticesd& t);

/// How far apart two solids are after a translation of b.
struct Separation {
  bool apart = false;    ///< proven: the surfaces are disjoint, and neither solid is in the other
  double gap = 0;        ///< proven distance of the surfaces
  double moved = 0;      ///< how far b was moved in a's frame: sums of poses are rounded
  bool nearest = false;  ///< the following are set
  fcl::Vector3d on_a = fcl::Vector3d::Zero();  ///< nearest points, in the world, a as it is
  fcl::Vector3d on_b = fcl::Vector3d::Zero();
  fcl::Vector3d normal = fcl::Vector3d::Zero();  ///< unit, from a to b there
};

/// Two solids of which b is moved by translations in the world, or a by their opposites.
class SolidPair {
 public:
  /// `squared_errors` is squaredRotationErrors() of the poses. Throws std::invalid_argument if a
  /// mesh is no solid.
  SolidPair(const Mesh& a, const fcl::Transform3d& X_WA, const Mesh& b,
            const fcl::Transform3d& X_WB, double squared_errors, SearchCounts& counts, bool swapped,
            bool moves_a);

  /// Tests a translation. Nearest points are looked for up to `reach`.
  Separation test(const fcl::Vector3d& translation, double reach);
  /// Two triangles that meet, in a's frame.
  struct Contact {
    TriangleVerticesd a, b;
  };
  /// What meets after a translation of b.
  struct Overlap {
    std::vector<Contact> contacts;
    /// Where no surfaces meet, but one solid is in the other, or a component is: takes a vertex
    /// of it to the nearest wall, in a's frame.
    std::optional<fcl::Vector3d> to_wall;
    bool any() const { return to_wall || !contacts.empty(); }
  };
  Overlap overlapAfter(const fcl::Vector3d& translation, std::size_t limit);
  /// What meets as the poses are; found once.
  const Overlap& overlap();
  int tests() const { return tests_; }
  const MeshPair& frame() const { return frame_; }
  const Mesh& a() const { return frame_.a; }
  const Mesh& b() const { return frame_.b; }
  const Convexity& convexityA() const { return requireSolid(a()).convexity(a()); }
  const Convexity& convexityB() const { return requireSolid(b()).convexity(b()); }
  const InnerBalls& ballsA() const { return requireSolid(a()).balls(a()); }
  const InnerBalls& ballsB() const { return requireSolid(b()).balls(b()); }
  fcl::Vector3d inWorld(const fcl::Vector3d& v_A) const { return X_WA_.linear() * v_A; }
  fcl::Vector3d pointInWorld(const fcl::Vector3d& p_A) const { return X_WA_ * p_A; }
  fcl::Vector3d vectorInA(const fcl::Vector3d& v_W) const {
    return X_WA_.linear().transpose() * v_W;
  }
  fcl::Vector3d inA(const fcl::Vector3d& p_W) const { return vectorInA(p_W - X_WA_.translation()); }
  /// The sum of the radii of the root volumes.
  double size() const { return size_; }
  /// Bounds what rounding may do to a distance about this pose.
  double rounding() const { return rounding_; }
  SearchCounts& counts() { return counts_; }
  bool swapped() const { return swapped_; }

 private:
  MeshPair moved(const fcl::Vector3d& translation) const;

  const fcl::Transform3d X_WA_, X_WB_;
  const double squared_errors_;
  SearchCounts& counts_;
  const bool swapped_, moves_a_;
  const MeshPair frame_;
  const double size_, rounding_;
  std::optional<Overlap> overlap_;
  int tests_ = 0;
};

/// The pair in an order that doesn't depend on which is named first: by size, by root volumes, by
/// poses, by coordinates. Translations move b; or, if wanted, the second one in any order.
SolidPair inOrder(const Mesh& mesh1, const fcl::Transform3d& X_W1, const Mesh& mesh2,
                  const fcl::Transform3d& X_W2, double squared_errors, SearchCounts& counts,
                  bool moves_second);

}  // namespace kios
