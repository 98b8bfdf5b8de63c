// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fcl_kios/continuous/continuous.h"

namespace kios::continuous {

/// Holds a moving pair of objects, t in [0, 1].
class MovingPair {
 public:
  virtual ~MovingPair() = default;
  /// Returns true if they touch at t; exact.
  virtual bool touching(double t) = 0;
  /// Returns a time h <= 1 - t such that they are proven apart from t to t + h: the longest one
  /// that a search finds, or any of at least `required` that costs less for its length.
  virtual double apartFor(double t, double required) = 0;
};

/// First contact: `time` is at most the time of every contact.
struct FirstContact {
  bool found;
  double time;  ///< 1 if none was found
};

/// Conservative advancement: proves one interval after the other free, until the end or until a
/// contact at most toc_err later is known. Where the provable intervals shrink below toc_err / 2^20
/// and no contact is known, it gives up and reports one. Throws std::invalid_argument if toc_err is
/// NaN or negative. Source: Mirtich, "Timewarp rigid body simulation" (2000); Zhang, Redon, Lee &
/// Kim, "Continuous collision detection for articulated models using Taylor models and temporal
/// culling" (2007).
FirstContact advance(MovingPair& pair, double toc_err, ContinuousCounts& counts);

}  // namespace kios::continuous
