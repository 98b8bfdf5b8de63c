// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/pair_query.h"
#include "motion/configuration.h"

namespace kios::articulated {

/// What is known of a pair of bodies at a configuration.
struct Nearness {
  /// They are proven so far apart, for the bodies at exact kinematics: the path's pad is subtracted.
  double apart = 0;
  bool contact = false;  ///< confirmed by the static query
};

/// The static queries about two bodies of a linkage at a configuration of a path, a < b. Asks by
/// thresholds: nothing is computed more exactly than the motion needs.
class BodyQueries {
 public:
  BodyQueries(const Path& path, double min_separation, MotionCounts& counts)
      : path_(path), min_separation_(min_separation), counts_(counts) {}

  /// A lower bound by the bodies' root volumes; once it exceeds `enough`, that will do.
  double rootBound(int a, int b, const Configuration& at, double enough) const;
  /// By the narrow phase: apart by more than `enough`, or less well known, within a factor of two of
  /// the distance; or in contact. `roots` is what rootBound() gave. `start` is where the search
  /// begins, and is set to where it ended.
  Nearness ask(int a, int b, const Configuration& at, double enough, double roots,
               engine::TrianglePairIds& start) const;

  /// Throws std::invalid_argument if no query serves the pair.
  void requireServed(int a, int b) const;

 private:
  const BodyData& body(int id) const { return path_.linkage().bodies[id]; }
  Nearness askMeshes(int a, int b, const Configuration& at, double enough, double roots,
                     engine::TrianglePairIds& start) const;
  Nearness askMeshAndOther(int mesh, int other, const Configuration& at, double enough) const;
  Nearness askShapes(int a, int b, const Configuration& at) const;

  const Path& path_;
  const double min_separation_;
  MotionCounts& counts_;
};

}  // namespace kios::articulated
