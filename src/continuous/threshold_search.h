// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <vector>

#include "fcl_kios/motion.h"
#include "volume/rounding.h"

namespace kios::continuous {

/// The nearest pair of bodies at a place of their range.
struct Sight {
  double distance = kInfinity;  ///< an upper bound; 0 at contact
  int a = -1, b = -1;
  fcl::Vector3d point_a = RangeResult().point_a, point_b = point_a;
};

/// The nearest pair that was seen in a range so far, of those within the ceiling.
class Seen {
 public:
  /// Throws std::invalid_argument if an option is out of range.
  explicit Seen(const RangeRequest& request);

  double distance() const { return best_.distance; }
  const std::vector<double>& at() const { return at_; }
  /// The largest distance that matters.
  double ceiling() const { return std::max(0.0, request_.ceiling + request_.padding); }
  /// What is farther doesn't matter.
  double far() const { return std::min(distance(), ceiling()); }
  /// The width of the bracket that is asked for.
  double allowed() const;
  /// What a lower bound must reach, so that the bracket is as narrow as that.
  double enough() const;
  /// A relative error of distances of which the bracket hardly gets wider.
  double fineError() const;
  void keep(const Sight& sight, const std::vector<double>& at);
  /// Complete if `lower` is enough.
  RangeResult result(double lower, long long queries) const;

 private:
  const RangeRequest request_;
  Sight best_;
  std::vector<double> at_;
};

/// Bodies that move with s in [0, 1].
class MovingBodies {
 public:
  enum class Proof {
    kClear,    ///< all along, all pairs are farther apart than asked
    kRefuted,  ///< a pair is not, or can't be told, at a place that is named
    kSpent     ///< the queries were, before any of these
  };
  virtual ~MovingBodies() = default;
  /// The nearest pair at s, of those nearer than `far`; the distance, which two points have, may
  /// exceed the least by rel_err of it.
  virtual Sight look(double s, double far, double rel_err) = 0;
  /// Proves that all pairs are farther apart than `separation` >= 0 all along, or names a place.
  virtual Proof prove(double separation, double& place) = 0;

  long long queries = 0;  ///< made so far
};

/// The least clearance, by proofs for thresholds ever closer below the least distance that was
/// seen: a half, an eighth, ... of it, down to what the request allows. A proof that is refuted
/// names a place that is nearer, from which steps lead down to a least distance nearby. So `lower`
/// is always proven, and most of the time goes into the last proof. `at` is s.
RangeResult searchThresholds(MovingBodies& bodies, const RangeRequest& request);

}  // namespace kios::continuous
