// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "linkage/configuration.h"
#include "search/mesh_pair.h"
#include "solid/mesh_and_other.h"
#include "volume/rounding.h"

namespace kios::articulated {

/// A pair of bodies, a < b, and where the search for a slab between them begins.
struct Pair {
  int a, b;
  int shared;  ///< moving joints that carry both
  /// From a to b in the world, of length 1: of the last query or slab; 0 if there was none.
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();
};

/// What is known of a pair of bodies at a configuration.
struct Nearness {
  /// They are proven so far apart, for the bodies at exact kinematics: the path's pad is
  /// subtracted.
  double apart = 0;
  bool contact = false;  ///< confirmed by the static query
  bool slab = false;     ///< `apart` is the width of one across the pair's direction
};

/// What is measured of a pair of bodies: a bracket of their distance at exact kinematics.
struct Measured {
  double lower = 0, upper = kInfinity;  ///< the latter infinite if they are farther than was asked
  bool contact = false;                 ///< of their surfaces, confirmed by the static query
  Eigen::Vector3d point_a, point_b;     ///< nearest points in the world, if there is an upper bound
};

/// Returns true if a query serves the pair.
bool isServed(const BodyData& a, const BodyData& b);

/// The static queries about two bodies of a linkage at a configuration of a path, a < b. Asks by
/// thresholds: nothing is computed more exactly than the motion needs.
class BodyQueries {
 public:
  BodyQueries(const Path& path, double min_separation, MotionCounts& counts)
      : path_(path), min_separation_(min_separation), counts_(counts) {}

  /// A lower bound by the bodies' root volumes; once it exceeds `enough`, that will do.
  double rootBound(const Pair& pair, const Configuration& at, double enough) const;
  /// The width of a slab between the bodies: all of a lies below it, all of b above it, along the
  /// pair's direction, which is set. Negative if none was found: the hulls overlap, or nearly so. A
  /// slab wider than `enough` will do.
  double slab(Pair& pair, const Configuration& at, double enough) const;
  /// By the narrow phase: apart by more than `enough`, or less well known, within a factor of two
  /// of the distance; or in contact. Sets the pair's direction.
  Nearness ask(Pair& pair, const Configuration& at, double enough) const;
  /// The distance, of those that are nearer than `far`, which may exceed the exact one by rel_err
  /// of it, and by what docs/shapes.md says; where none is found, `lower` isn't below `far`. Of two
  /// meshes any that is at most `near_enough` will do. Sets the pair's direction.
  Measured measure(Pair& pair, const Configuration& at, double far, double rel_err,
                   double near_enough = 0) const;
  /// True only if the bodies are in contact, by a query that tells nothing else and takes less
  /// time; false if that would take a query as long as ask().
  bool touching(const Pair& pair, const Configuration& at) const;

  /// True if one of the bodies may lie in the other: both are marked meshes, or one is and the
  /// other a shape. Throws std::invalid_argument if a marked one is no solid any more.
  bool areSolids(const Pair& pair) const;
  /// True only if the bodies are in contact, as fcl::collide sees it; for solids also if.
  bool inContact(const Pair& pair, const Configuration& at) const;

  /// Returns the smaller radius of the bodies' balls, above 0.
  double smallerRadius(const Pair& pair) const {
    return std::max(0x1p-500, std::min(body(pair.a).content.radius, body(pair.b).content.radius));
  }

  /// Throws std::invalid_argument if no query serves the pair.
  void requireServed(int a, int b) const;

  /// Returns the cost of all searches of a mesh, in tests of volumes.
  long long cost() const { return cost_; }

 private:
  void count(const SearchCounts& counts) const;
  const BodyData& body(int id) const { return path_.linkage().bodies[id]; }
  const shape::Solid* shapeOf(int id) const {
    return body(id).kind == BodyKind::kShape ? &body(id).own->solid : nullptr;
  }
  MeshPair meshPair(const Pair& pair, const Configuration& at) const;
  /// A pair of which one is a mesh.
  MeshAndOther<double> meshAndOther(const Pair& pair, const Configuration& at) const;
  Nearness askShapes(Pair& pair, const Configuration& at) const;
  /// The width of a slab between two shapes, as shapeGap() finds it; negative if none was found.
  double gapOfShapes(int a, int b, const Configuration& at,
                     Eigen::Vector3d* direction = nullptr) const;

  const Path& path_;
  const double min_separation_;
  MotionCounts& counts_;
  mutable long long cost_ = 0;
};

}  // namespace kios::articulated
