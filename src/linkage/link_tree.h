// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <atomic>
#include <memory>
#include <mutex>
#include <vector>

#include "fcl_kios/linkage.h"
#include "linkage/body_content.h"
#include "linkage/obstacle_tree.h"

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

/// A body where it is placed: on a link, or in the world. `own` is null once it was removed.
struct BodyData {
  std::shared_ptr<const Content> own;
  BodyKind kind = BodyKind::kMesh;
  const Modeld* model = nullptr;  ///< of a mesh
  bool bounded = true;            ///< half-spaces and planes are not
  bool meets = false;             ///< anything can
  int link = -1;
  fcl::Transform3d X_LB;  ///< its rotation orthonormal as a link's
  ContentBound content;   ///< in the link's frame
  double reach = 0;  ///< of the content from its link's origin; of an unbounded one, of its plane
  ObstacleBox box = {};      ///< of an obstacle, and its farthest from the world's origin
  int carried = -1;          ///< among those on links
  int first_motion = 0;      ///< of its BodyMotions in a configuration; those of obstacles are one
  std::vector<int> ignored;  ///< bodies with which it is not checked, ascending

  void place(int to, const fcl::Transform3d& X);
  bool ignores(int other) const {
    return std::binary_search(ignored.begin(), ignored.end(), other);
  }
};

/// A body on a link.
struct CarriedBody {
  int body;
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

/// What queries find out of a linkage, until it changes: its number of pairs, and one like it whose
/// octrees were measured later. A copy is empty.
class RenewedLinkage {
 public:
  RenewedLinkage() = default;
  RenewedLinkage(const RenewedLinkage& /*other*/) {}
  RenewedLinkage& operator=(const RenewedLinkage&) = delete;
  ~RenewedLinkage() = default;

  /// Measures the octrees of `linkage` again, unless the last time will do.
  std::shared_ptr<const Linkage::Impl> of(const Linkage::Impl& linkage) const;
  /// The number of pairs to be checked.
  long long pairsOf(const Linkage::Impl& linkage) const;
  void forget() {
    impl_.reset();
    pairs_ = kUnknown;
  }

 private:
  static constexpr long long kUnknown = -1;
  mutable std::atomic<long long> pairs_{kUnknown};
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

/// Sets points of two shapes, of which one is bounded at least, that are nearest to each other as
/// GJK finds them, the supports being right to rounding: their distance is never less than that of
/// the shapes.
void nearPoints(const BodyData& a, const fcl::Transform3d& X_WA, const BodyData& b,
                const fcl::Transform3d& X_WB, fcl::Vector3d& on_a, fcl::Vector3d& on_b);

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
  std::vector<articulated::BodyData> bodies;      // by number; removed ones too
  std::vector<articulated::CarriedBody> carried;  // their pairs to be checked
  articulated::ObstacleTree obstacles;            // that anything can meet
  int coordinates = 0;
  int num_motions = 1;  ///< of bodies in a configuration: one by each moving joint, and one more

  std::vector<int> free;  ///< numbers of bodies
  articulated::SpareScratch spare;
  articulated::RenewedLinkage renewed;

  bool has(int body) const {
    return body >= 0 && body < static_cast<int>(bodies.size()) && bodies[body].own;
  }

  /// Throws std::invalid_argument if there is no such body.
  articulated::BodyData& at(int body);

  /// This one; or, where an octree has got cells outside of the box that was measured, one that
  /// holds them. Throws std::invalid_argument if any other geometry was changed.
  std::shared_ptr<const Impl> current() const;
  bool holdsCells() const;
  void measureOctrees();

  /// The number of pairs to be checked.
  long long pairs() const;
  /// The number of moving joints that carry both links.
  int shared(int link_a, int link_b) const;

  fcl::Transform3d checkedPose(const articulated::Content& body, int link,
                               const fcl::Transform3d& X_LB) const;
  int addBody(int link, std::shared_ptr<const articulated::Content> own,
              const fcl::Transform3d& X_LB);
  void addPairs(int body);  // of one that is placed and has none
  void dropPairs(int body);
  int sharedOfPair(const articulated::BodyData& a, int b) const;
};

}  // namespace kios
