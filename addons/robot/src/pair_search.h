// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "cell.h"
#include "fcl_kios/robot/answers.h"

namespace kios::robot {

/// Whether two links can touch within the limits of the joints between them, by branch and bound
/// over boxes of configurations.
///
/// Let c be the middle of a box and h_i the farthest that joint i turns or slides from there. By
/// the derivation of docs/motions.md, a point x of a body comes no farther in the box than sum_i
/// h_i rho_i(c), rho_i the distance of x from axis i in the one configuration c (1 for a prismatic
/// joint), the sum over the joints between the point and whoever looks at it. Two bodies that are
/// farther apart at c than they may come are apart in the whole box. Seen from the link that
/// carries both, both bodies move, each by the joints of its own side; seen from one of the bodies,
/// the other one moves by the joints of both sides. All three bounds hold; the least is used.
///
/// A slab between the boxes of two bodies at c, across n, proves more where they move along it. In
/// the sum of steps from which the bound above comes, one joint after the other, joint i turns a
/// point within the plane across its axis, which the joints before it have turned by at most the
/// sum of their angles: so the step's length along n is at most h_i rho_i (|n x axis| + that sum),
/// and that of a slide h_i (|n axis| + that sum).
///
/// Rounding is as in src/linkage/configuration.h; 2^-40 stands here in the place of 2^-43.
class PairSearch {
 public:
  PairSearch(const Arm& arm, int link_a, int link_b);

  /// Looks for contacts by samples and steps towards smaller distances. Returns true if that
  /// settles the pair; sets verdict and configuration.
  bool look(LinkPair& result);
  /// Looks for a proof in up to so many boxes, until `late` returns true; counts them. Sets the
  /// verdict, and where a contact is met its configuration.
  void prove(long long max_boxes, const std::function<bool()>& late, LinkPair& result);

 private:
  /// A moving joint between the two.
  struct Between {
    int node;
    int slot;      ///< of its coordinate among those that matter
    double scale;  ///< radians or lengths that a unit of the coordinate means, >= 0
    bool slides, of_a;
  };
  struct Side {
    int node;
    std::vector<const Body*> bodies;
    std::vector<fcl::Transform3d> poses;
    std::vector<fcl::Vector3d> centers;
    double level = 0, length = 0;  ///< of the chain and the farthest body
  };

  void findRanges();
  void place(const std::vector<double>& middle);
  bool sample(LinkPair& result);
  bool descend(LinkPair& result);
  bool touchingAt(LinkPair& result);
  /// How far the pair of bodies may come nearer to each other in a box, by slot in `parts` too.
  double motionBound(const std::vector<double>& half, std::size_t i, std::size_t k,
                     std::vector<double>& parts);
  /// Whether a slab across n, or across a side of a body's box, stays between the bodies in a box.
  bool slabStays(const fcl::Vector3d& n, const std::vector<double>& half, std::size_t i,
                 std::size_t k) const;
  bool anySlabStays(const std::vector<double>& half, std::size_t i, std::size_t k) const;
  double radiusFrom(const Between& joint, const Side& side, std::size_t body) const;
  bool proveApart(std::size_t i, std::size_t k, long long max_boxes,
                  const std::function<bool()>& late, LinkPair& result);
  Eigen::VectorXd configuration() const;

  const Arm& arm_;
  std::vector<int> nodes_;  ///< between the two and what carries both, parents first
  int shared_ = -1;         ///< the node that carries both
  std::vector<Between> joints_;
  std::vector<int> coordinates_;  ///< by slot
  std::vector<double> low_, high_, middle_;
  bool bounded_ = true;  ///< the box is all that matters
  Side a_, b_;
  double pad_ = 0;
  std::vector<PlacedLink> placed_;
  std::vector<double> ways_;  ///< by joint: how far it moves its side in a box, by motionBound()
};

}  // namespace kios::robot
