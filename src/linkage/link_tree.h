// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "continuous/occupied_box.h"
#include "fcl_kios/linkage/linkage.h"
#include "fcl_kios/model/model.h"
#include "linkage/content_bound.h"
#include "linkage/obstacle_tree.h"
#include "linkage/support.h"
#include "model/prepared.h"
#include "shape/solid.h"

namespace kios::articulated {

/// A link with its joint. The rotation is orthonormal to 16 u (Frobenius norm of R^T R - I, u =
/// 2^-53), the axis of length 1 to rounding.
struct LinkData {
  int parent = -1;
  JointType type = JointType::kFixed;
  Eigen::Matrix3d R_PJ;
  Eigen::Vector3d t_PJ;
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();
  double unit = 0;                    ///< radians or lengths that a unit of the coordinate means
  int coordinate = -1;                ///< -1 if fixed
  double multiplier = 1, offset = 0;  ///< of the coordinate

  /// Where the joint stands, in radians or lengths.
  double at(double q) const { return (multiplier * q + offset) * unit; }
  std::vector<int>
      moving;          ///< links with moving joints from the world to this one, itself included
  int level = 0;       ///< joints, fixed ones included, from the world to this link
  double offsets = 0;  ///< sum of |t_PJ| of those, rounded up
};

enum class BodyKind { kMesh, kShape, kOctree };

struct BodyData {
  std::shared_ptr<const fcl::CollisionGeometryd> geometry;
  BodyKind kind = BodyKind::kMesh;
  const Modeld* model = nullptr;  ///< of a mesh
  shape::Solid solid;             ///< of a shape
  int link = -1;
  fcl::Transform3d X_LB;  ///< its rotation orthonormal as a link's
  bool bounded = true;    ///< half-spaces and planes are not
  bool occupied = true;
  bool meets = true;      ///< false: it isn't occupied, or an octree without cells
  ContentBound content;   ///< in the link's frame
  SupportTable supports;  ///< of the content in the link's frame; empty if unbounded
  double reach = 0;  ///< of the content from its link's origin; of an unbounded one, of its plane
  ObstacleBox box = {};        ///< of an obstacle
  double obstacle_length = 0;  ///< how far an obstacle reaches from the world's origin
  int carried = -1;            ///< among those on links
  int first_motion = 0;  ///< of its BodyMotions in a configuration; those of obstacles are all one
  ModelState state;      ///< of a mesh when it was added
  std::vector<double> shape_values;  ///< likewise of a shape; see model/shape_values.h
#if FCL_HAVE_OCTOMAP
  continuous::OccupiedBox cells;  ///< of an octree, when its content was measured
#endif

  /// Throws std::invalid_argument, naming the body, if what was measured of it when it was added
  /// is not so any more. Octrees may change.
  void requireUnchanged(std::size_t id) const;
  /// True unless the body is an octree with cells outside of those that were measured.
  bool holdsCells() const;
};

/// A body on a link, and those with which it must not come into contact.
struct CarriedBody {
  int body;
  std::vector<int> allowed;  ///< obstacles that it may touch, ascending
  /// By the bodies that are carried before it: the first `shared` moving joints on the ways from
  /// the world to both links are the same ones, and move both bodies alike. kNever if the pair
  /// isn't checked.
  std::vector<int> shared;
  static constexpr int kNever = -1;
};

struct Scratch;

/// Memory of a search that ended, for the next one; whoever takes it has it alone. A copy is empty.
class SpareScratch {
 public:
  SpareScratch() = default;
  SpareScratch(const SpareScratch& /*other*/) {}
  SpareScratch& operator=(const SpareScratch&) = delete;
  ~SpareScratch();
  std::unique_ptr<Scratch> exchange(std::unique_ptr<Scratch> by) const;

 private:
  mutable std::atomic<Scratch*> kept_{nullptr};
};

/// A linkage like another one, whose octrees were measured later. A copy is empty.
class RenewedLinkage {
 public:
  RenewedLinkage() = default;
  RenewedLinkage(const RenewedLinkage& /*other*/) {}
  RenewedLinkage& operator=(const RenewedLinkage&) = delete;
  ~RenewedLinkage() = default;

  /// Measures the octrees of `linkage` again, unless the last time will do.
  std::shared_ptr<const Linkage::Impl> of(const Linkage::Impl& linkage) const;

 private:
  mutable std::mutex mutex_;
  mutable std::shared_ptr<const Linkage::Impl> impl_;
};

/// A proven lower bound of the distance of two shapes, of which one is bounded at least: GJK
/// proposes a direction, and the slab across it, as wide as the shapes' supports leave it, is the
/// bound, whatever GJK got wrong. Negative if no slab was found. Off by rounding alone, which is
/// below 2^-46 of the lengths from the world's origin.
/// `direction`, if given, is set to the slab's, from a to b in the world, if both are bounded.
double shapeGap(const BodyData& a, const fcl::Transform3d& X_WA, const BodyData& b,
                const fcl::Transform3d& X_WB, fcl::Vector3d* direction = nullptr);

/// FCL's own verdict: are they in contact? Or are they at most `within` > 0 apart? Half-spaces and
/// planes are judged by their gap, which is exact but for rounding: FCL finds cylinders in planes
/// that they don't meet, unless it is asked for contacts.
bool shapesMeet(const BodyData& a, const fcl::Transform3d& X_WA, const BodyData& b,
                const fcl::Transform3d& X_WB, double within);

}  // namespace kios::articulated

namespace kios {

class Linkage::Impl {
 public:
  std::vector<articulated::LinkData> links;
  std::vector<articulated::BodyData> bodies;
  /// The pairs to be checked: all but those of one link and those that are allowed.
  std::vector<articulated::CarriedBody> carried;
  std::vector<articulated::ObstacleBox> obstacles;  ///< those that anything can meet
  int coordinates = 0;
  int num_motions = 1;  ///< of bodies in a configuration: one by each moving joint, and one more
  long long num_pairs = 0;
  double farthest_obstacle = 0;  ///< the largest obstacle_length

  /// The obstacles' tree, built by whoever asks for it first; threads may ask at once.
  const articulated::ObstacleTree& obstacleTree() const {
    std::call_once(lazy_tree_->built,
                   [this] { lazy_tree_->tree = articulated::ObstacleTree(obstacles); });
    return lazy_tree_->tree;
  }

  int addLink(int parent, const Joint& joint);
  int addBody(int link, std::shared_ptr<const fcl::CollisionGeometryd> geometry,
              const fcl::Transform3d& X_LB);
  void allow(int a, int b);

  /// This one; or, where an octree has got cells outside of the box that was measured, one that
  /// holds them. Throws std::invalid_argument if any other geometry was changed.
  std::shared_ptr<const Impl> current() const;
  bool holdsCells() const;
  void measureOctrees();

  articulated::SpareScratch spare;

  /// The number of moving joints that carry both links.
  int shared(int link_a, int link_b) const;

 private:
  void addPairs(int body);

  struct LazyTree {
    std::once_flag built;
    articulated::ObstacleTree tree;
  };
  std::shared_ptr<LazyTree> lazy_tree_ = std::make_shared<LazyTree>();  ///< copies share it

  std::vector<std::pair<int, int>> allowed_;
  articulated::RenewedLinkage renewed_;
};

}  // namespace kios
