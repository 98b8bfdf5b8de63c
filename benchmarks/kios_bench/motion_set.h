// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <utility>

#include <fcl_kios/fcl_kios.h>

#include "scenes/cells.h"

namespace kios::bench {

Eigen::VectorXd vectorOf(const scenes::Joints& q);

/// The linkage of a cell: bodies have the cell's numbers.
Linkage linkageOf(const scenes::Cell& cell);

/// A way to tell whether a straight path in joint space is free of contact.
class MotionSet {
 public:
  virtual ~MotionSet() = default;
  /// Returns true if no contact is found from q0, which is free, to q1.
  virtual bool isFree(const scenes::Joints& q0, const scenes::Joints& q1) = 0;
  /// Returns pairs for which the narrow phase was asked since the last call, and, of ours,
  /// undecided paths.
  virtual long long takeQueried() { return 0; }
  virtual long long takeUnresolved() { return 0; }
};

/// By checkMotion(), `kios` in rows. The cell must outlive it.
std::unique_ptr<MotionSet> makeCertified(const scenes::Cell& cell);

/// By their names in rows: `sampled_kios` and `fcl_obbrss`, samples at most 0.01 rad apart in the
/// largest joint, each with FCL's dynamic AABB trees over k-IOS and OBBRSS. Samples are taken in
/// the order of OMPL's discrete validator: the end, the middle, the middles of the halves. The cell
/// must outlive it.
std::unique_ptr<MotionSet> makeMotionSet(const std::string& name, const scenes::Cell& cell);

/// Returns true if a configuration is free of contact, by the static query of every pair whose
/// boxes meet.
std::function<bool(const scenes::Joints&)> makeStaticCheck(const scenes::Cell& cell);

/// Returns the least distance of the admissible pairs on a straight path, by FCL's dynamic AABB
/// trees over OBBRSS at samples between which nothing moves farther than `step`. The cell must
/// outlive it.
std::function<double(const scenes::Joints&, const scenes::Joints&)> makeSampledClearance(
    const scenes::Cell& cell, double step);

}  // namespace kios::bench
