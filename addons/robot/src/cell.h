// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "body.h"
#include "box_lanes.h"
#include "fcl_kios/linkage.h"
#include "fcl_kios/robot/answers.h"
#include "kinematic_tree.h"

namespace kios::robot {

struct Nearness;

/// An obstacle (X in the world), or what is attached (X in its link's frame).
struct Object {
  std::string name;  ///< empty: its place is free
  int link = -1;     ///< of the URDF
  fcl::Transform3d X = fcl::Transform3d::Identity();
  std::vector<Element> elements;
  long long order = 0;                  ///< objects come in this order
  std::vector<std::string> touch = {};  ///< pairs that are ignored for as long as it is attached
};

/// A robot as its files describe it: the same for all copies.
struct Arm {
  Description description;
  KinematicTree tree;
  Linkage linkage;  ///< with the links' bodies
  std::vector<Body> bodies;
  std::vector<std::string> links;
};

/// Who is checked: a link, an obstacle, or what is attached.
struct Entity {
  std::string name;
  double padding = 0;
  std::vector<int> ignored;  ///< entities, ascending
};

/// A robot among its obstacles, made for queries. Entities are the links, then the objects by their
/// places. Queries are const; in between, objects may come, go and change, each at the cost of its
/// own pairs. Copies share geometry.
class Cell {
 public:
  /// Makes the cell of the links alone.
  Cell(std::shared_ptr<const Arm> arm, const std::vector<Entity>& links);

  /// An object comes, goes, or is another one: elsewhere, attached, padded, ignored.
  void come(int entity, Entity who, const Object& object);
  void go(int entity);
  void change(int entity, Entity who, const Object& object);
  /// Moves an obstacle.
  void move(int entity, const Object& object);

  const Arm& arm() const { return *arm_; }
  const Entity& entity(int i) const { return entities_[i]; }

  std::optional<RobotContact> contact(const Eigen::VectorXd& q) const;
  bool inContact(const Eigen::VectorXd& q) const;
  RobotClearance clearance(const Eigen::VectorXd& q, const ClearanceRequest& options) const;
  std::vector<RobotClearance> clearances(const Eigen::VectorXd& q, double within) const;
  /// The proofs' linkages; copies are for threads of their own.
  struct Proof {
    double separation;  ///< the sum of the paddings of all its pairs
    Linkage linkage;
    std::vector<int> bodies;  ///< by the linkage's numbers
    long long pairs = 0;
  };
  const std::vector<Proof>& proofs() const { return proofs_; }
  RobotMotion checkMotion(const std::vector<Proof>& proofs, const Eigen::VectorXd& q0,
                          const Eigen::VectorXd& q1, const MotionRequest& request) const;
  /// The least of the parts of a range. Each need not look at what can't narrow the bracket of
  /// those before, and gets its share of the queries.
  static RangeResult leastOf(
      std::size_t parts, const RangeRequest& request,
      const std::function<RangeResult(std::size_t part, const RangeRequest&)>& ask);
  /// The least clearance of all proofs, each of which is asked with its own padding.
  RobotRange leastClearance(
      const RangeRequest& request,
      const std::function<RangeResult(const Linkage&, const RangeRequest&)>& ask) const;
  std::vector<RobotRange> leastClearances(
      const RangeRequest& request,
      const std::function<std::vector<RangeResult>(const Linkage&, const RangeRequest&)>& ask)
      const;

 private:
  /// Bodies, in the order of answers: the carried one, if one isn't; else that of the earlier
  /// place.
  struct Pair {
    int a, b;
  };
  /// A pair and a lower bound of its clearance.
  struct Candidate {
    double bound;
    int a, b;
    bool operator<(const Candidate& o) const { return bound > o.bound; }  // the least on top
  };
  struct Placed;

  void set(int entity, Entity who);  ///< of which no body is listed
  /// Lists a body among its like, and takes it from there.
  void list(int body);
  void unlist(int body);
  /// Puts an object's bodies where it says, and lists them.
  void put(int entity, const Object& object);
  void withdraw(int entity);

  bool checked(const Body& a, const Body& b) const {
    const std::vector<int>& ignored = entities_[a.entity].ignored;
    return a.meets && b.meets && a.node != b.node &&
           !std::binary_search(ignored.begin(), ignored.end(), b.entity);
  }
  void checkCarried();
  bool isChecked(const Body& carried, const Body& other) const {
    if (other.node < 0) return checked(other, carried);
    return checked_[static_cast<std::size_t>(carried.place) * carried_.size() +
                    static_cast<std::size_t>(other.place)] != 0;
  }
  /// Calls visit(other) for the listed bodies whose pairs with this one may be checked.
  template <typename Visit>
  void forOthers(int body, const Visit& visit) const;
  /// The proof of a pair that is checked, made if need be; -1 for other pairs.
  int proofOf(int a, int b);
  int numberIn(int proof, int body) const {
    if (body < num_link_bodies_) return body;
    const auto& numbers = bodies_[body].numbers;
    return proof < static_cast<int>(numbers.size()) ? numbers[proof] : -1;
  }
  /// Adds `sign` to the numbers of pairs of the proofs of a body's pairs.
  void countPairs(int body, int sign);
  /// Takes a body to where it is in the proofs that have pairs of it, and out of the others.
  void enterProofs(int body);
  /// Drops the proofs without pairs, and sorts the others.
  void settle();
  /// Where a body comes in Robot::elements().
  int placeOf(int body) const;
  /// An answer about a proof's linkage, with bodies in the place of its numbers.
  template <typename Result>
  static Result withBodies(const Proof& proof, Result result);
  /// Names the bodies, and puts their places in order. True if they were the other way round.
  template <typename Result>
  bool setNames(Result& result) const;
  RobotRange named(RangeResult result) const;

  /// Bounds the distance of the ball of body a from the box of body b.
  double ballToBox(const Placed& placed, int a, int b) const;
  double boundOf(const Placed& placed, int a, int b) const;
  bool findContact(Placed& placed, Pair& found) const;
  /// With `contact`, it is filled in for a pair that is known to be near.
  bool touch(const Placed& placed, int a, int b, RobotContact* contact) const;
  /// Pairs whose bound is at most `within`.
  void candidates(const Placed& placed, double within, RobotPairs among,
                  std::vector<Candidate>& found) const;
  RobotClearance answer(const Placed& placed, const Candidate& pair, const Nearness& near,
                        bool gradient) const;
  void addGradient(const Placed& placed, const Body& a, const Body& b, Nearness& near,
                   RobotClearance& answer) const;

  std::shared_ptr<const Arm> arm_;
  std::vector<Entity> entities_;
  std::vector<std::vector<int>> bodies_of_;  ///< by entity
  std::vector<long long> orders_;            ///< by entity, of objects
  std::vector<Body> bodies_;                 ///< the links' come first
  std::vector<int> free_;                    ///< places of bodies that went
  int num_link_bodies_ = 0;
  std::vector<int> carried_;    ///< bodies that links carry
  std::vector<int> obstacles_;  ///< the others, as in boxes_
  std::vector<char> checked_;   ///< by two carried bodies
  BoxLanes boxes_;
  std::vector<Proof> proofs_;
  std::vector<int> ascending_;  ///< those that are asked, by separations; one at least
};

}  // namespace kios::robot
