// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>
#include <memory>
#include <vector>

#include "continuous/relative_motion.h"
#include "continuous/tuning.h"
#include "fcl_kios/model.h"
#include "fcl_kios/motion.h"
#include "volume/rounding.h"

namespace kios::continuous {

/// Returns a bound of the distance of the mesh's points from the origin of its frame. Throws
/// std::invalid_argument if it is not finished.
double reachOf(const Modeld& model);

/// Holds a moving pair of objects, t in [0, 1], and searches for the time that the pairs of a
/// tree's nodes, or of two trees', are apart. Source: Tang, Kim & Manocha, "C2A: controlled
/// conservative advancement for continuous collision detection of polygonal models" (2009).
class StepSearch {
 public:
  virtual ~StepSearch() = default;
  /// Returns a time h <= 1 - t such that they are proven apart from t to t + h: the longest one
  /// that a search finds.
  double apartFor(double t);

  /// For whoever takes single steps: none is looked for beyond `end`, and none takes many more
  /// tests than `most_tests`.
  void setLimits(double end, long long most_tests) {
    end_ = end;
    most_tests_ = most_tests;
  }
  /// Returns the cost of all steps, in tests of two volumes that don't move.
  long long cost() const {
    return tuning::kTestsOfMoving * (counts_.volume_tests + 3 * counts_.leaf_tests) + visits_;
  }

 protected:
  struct NodePair {
    int a, b;
  };

  StepSearch(const Motion& motion_a, double reach_a, const Motion& motion_b, double reach_b,
             ContinuousCounts& counts)
      : motion_(motion_a, motion_b, reach_a, reach_b), counts_(counts) {}

  /// A step from t is looked for.
  virtual void beginStep(double /*t*/) {}
  /// Returns true if the nodes' contents are proven apart for `duration`.
  virtual bool nodesApart(NodePair pair, const RelativeVelocities& v, double duration) = 0;
  /// Time for which two leaves are proven apart; any time of at least `required` will do.
  virtual double leavesApart(NodePair pair, const RelativeVelocities& v, double required) = 0;
  /// Goes on to another order in which pairs are split, if one may take fewer tests; `cost` was
  /// spent in vain on a step of length `way`.
  virtual bool changeOrder(double /*way*/, long long /*cost*/) { return false; }
  /// Is told what each step came to.
  virtual void noteStep(double /*way*/, long long /*cost*/) {}
  static constexpr int kMostParts = 8;
  /// Writes the pairs that a pair consists of, the nearest first, and returns how many; 0 for a
  /// pair of leaves.
  virtual int split(NodePair pair, const RelativeVelocities& v, NodePair* parts) = 0;

  const RelativeMotion motion_;
  ContinuousCounts& counts_;
  long long visits_ = 0;  ///< of single nodes

 private:
  long long budget_ = tuning::kLeastBudget;  ///< volume tests after which the next step is halved
  double end_ = 1;
  long long most_tests_ = std::numeric_limits<long long>::max();
  double window_ = 1, last_step_ = 1;
  NodePair last_ = {-1, -1};  ///< leaves that ended the last step
  std::vector<NodePair> stack_;
};

/// Two moving geometries, of which one at least is a mesh; all are referred to. Throws
/// std::invalid_argument if a model is not finished, or the pair is not served.
std::unique_ptr<StepSearch> movingPair(const fcl::CollisionGeometryd& a, const Motion& motion_a,
                                       const fcl::CollisionGeometryd& b, const Motion& motion_b,
                                       ContinuousCounts& counts);

}  // namespace kios::continuous
