// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fcl/narrowphase/collision_object.h>
#include <fcl/narrowphase/collision_request.h>
#include <fcl/narrowphase/collision_result.h>
#include <fcl/narrowphase/distance_request.h>
#include <fcl/narrowphase/distance_result.h>
#include "preload/calls.h"
#include "preload/copy_cache.h"
#include "preload/policy.h"

namespace kios::preload {

/// Says who answered a query.
enum class By {
  kHandedOn,   ///< nobody yet: FCL's own function is to be called, with the result as it was
  kFclSearch,  ///< FCL's search, made here: its first test, or all of it
  kCopies
};

/// Returns what FCL's functions return of a result.
inline std::size_t valueOf(const CollisionResult& result) { return result.numContacts(); }
inline double valueOf(const DistanceResult& result) { return result.min_distance; }

/// Holds two geometries at poses in the world.
struct PosedPair {
  const Geometry* a;
  const Pose& X_WA;
  const Geometry* b;
  const Pose& X_WB;
};

/// Whether a pair can concern us at all: most pairs of FCL's shapes leave here.
inline bool isServed(const Geometry* a, const Geometry* b) {
  return a && b && (isServed(a->getNodeType()) || isServed(b->getNodeType()));
}

/// Answers for FCL. Whatever it can't answer as FCL would, or is cheaper there, it leaves to be
/// handed on; so it does where k-IOS refuses what it is given.
class Implementation {
 public:
  explicit Implementation(const Start& start) : start(start), copies(start) {}

  /// Answers for pairs that isServed() says.
  By answer(const PosedPair& pair, const CollisionRequest& request, CollisionResult& result);
  By answer(const PosedPair& pair, const DistanceRequest& request, DistanceResult& result);

  const Start start;
  CopyCache copies;
  Policy policy;

  /// Every pair is asked of copies, from the first query on.
  bool always() const { return start.mode == Mode::kVerify; }
  /// Makes the model's copy of its present content.
  void makeCopy(const Mesh& mesh);
};

// The parts of Implementation::answer().

/// Both of the pair are models over BV; model_a is its a.
template <typename BV>
By answerModels(Implementation& implementation, const fcl::BVHModel<BV>& model_a,
                const PosedPair& pair, const CollisionRequest& request, CollisionResult& result);
template <typename BV>
By answerModels(Implementation& implementation, const fcl::BVHModel<BV>& model_a,
                const PosedPair& pair, const DistanceRequest& request, DistanceResult& result);

/// FCL has no distance of models over OBB, and says so.
inline By answerModels(Implementation&, const fcl::BVHModel<fcl::OBBd>&, const PosedPair&,
                       const DistanceRequest&, DistanceResult&) {
  return By::kHandedOn;
}

/// The mesh is the pair's a, whatever the order of FCL's call.
By answerWithOther(Implementation& implementation, const Mesh& mesh, const PosedPair& pair,
                   const CollisionRequest& request, CollisionResult& result);
By answerWithOther(Implementation& implementation, const Mesh& mesh, const PosedPair& pair,
                   DistanceResult& result);

/// Whether a pose is surely one that k-IOS takes: finite, rigid, no reflection.
bool isRigid(const Pose& X);

/// Whether contacts, rather than a verdict, are wanted.
inline bool wantsContacts(const CollisionRequest& request) {
  return request.enable_contact || request.num_max_contacts > 1;
}

/// What of an FCL isn't as in the libfcl.so.0.7 that this library was built for: nullptr if all is
/// that is looked at. A copy that a program brings along may have been built with other flags. Its
/// tables of virtual functions are compared by size; then its constructors make objects, which are
/// read, and compared with this library's own.
const char* differenceOf(const Calls& fcl);

}  // namespace kios::preload
