// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <queue>
#include <vector>

#include "linkage/nearest.h"

namespace kios::articulated {

/// The least distance of a linkage's pairs over a box of coordinates, by branch and bound, best
/// first and pair by pair.
///
/// A box is taken for the path along its diagonal (Path): its rates are the ranges of joints, and
/// its pads hold in all of the box. From the middle c each joint i moves by at most h_i, half its
/// range, and a point by at most sum_i h_i rho_i(c), as Path says, seen from any link between the
/// two bodies: the joints on a's side of it move a, and those on b's side b. The link is taken from
/// which that is least: the turntable of an arm moves its thin column by less than its hand. What
/// is proven of the distance at c, less that, holds in the whole box. The coordinate that adds most
/// to it is halved.
///
/// A slab between the bodies at c, across n, proves more where they move along it. From that link
/// on, let m_i be n, turned back by what the joints before i turn from c on: joint i moves a point
/// within the plane across its axis, so along n by at most h_i rho_i |m_i x axis|, a slide by h_i
/// |m_i axis|; and m_i is turned on by at most h_i |m_i x axis|. Axes are those at c, and m_i is
/// off n by at most the sum of these.
class BoxSearch {
 public:
  BoxSearch(const Linkage::Impl& linkage, const Pair* only, const RangeRequest& request);

  RangeResult run(const Eigen::VectorXd& low, const Eigen::VectorXd& high);

 private:
  struct Task {
    double bound;  ///< of the pair's distance in the box
    Pair pair;
    Eigen::VectorXd low, high;
    long long number;  ///< for answers that are repeatable

    bool operator<(const Task& o) const {  // the least on top
      return bound != o.bound ? bound > o.bound : number > o.number;
    }
  };

  /// Looks at a configuration.
  void look(const Eigen::VectorXd& q);
  /// Steps along single coordinates from the nearest configuration to nearer ones in the box.
  void descend(const Eigen::VectorXd& low, const Eigen::VectorXd& high);
  /// A joint between two bodies: how far it moves points of either in half of a box.
  struct Step {
    int coordinate;
    double of_a, of_b;
    double angle;  ///< that it turns by
    Eigen::Vector3d axis;
  };
  /// Bounds how far two bodies come nearer to each other in a box whose middle is c, and sets what
  /// each coordinate adds to that.
  double moved(const Configuration& c, const Pair& pair, Eigen::VectorXd& parts);
  void addSteps(const Configuration& c, const Pair& pair, int side);
  /// Bounds the distance of two bodies in a box by slabs across the axes of their joints and the
  /// pair's direction, after moved(). Sets `parts` likewise, if there is a slab.
  double slabs(const Configuration& c, const Pair& pair, Eigen::VectorXd& parts) const;
  /// Bounds a pair in a box, or splits that.
  void open(Task task);
  bool spent() const { return nearest_.queries() >= request_.max_queries; }

  const Linkage::Impl& linkage_;
  const RangeRequest& request_;
  Nearest nearest_;
  continuous::Seen seen_;
  std::priority_queue<Task> waiting_;
  std::vector<Step> steps_;     ///< from a to b
  std::size_t seen_from_ = 0;   ///< those before it move a, the others b
  double settled_ = kInfinity;  ///< the least bound of what was left aside
  long long numbers_ = 0;
};

}  // namespace kios::articulated
