// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>

#include <fcl/common/types.h>

// The preloaded library is in two parts. The interposer, which stands before libfcl in every
// process, is small and depends on neither FCL nor fcl_kios, so that it changes nothing where there
// is no FCL. The implementation answers; the interposer opens it at the first query of a process
// that has libfcl.

namespace fcl {
template <typename S>
class CollisionGeometry;
template <typename S>
class CollisionObject;
template <typename S>
struct CollisionRequest;
template <typename S>
struct CollisionResult;
template <typename S>
struct DistanceRequest;
template <typename S>
struct DistanceResult;
}  // namespace fcl

namespace kios::preload {

using Object = fcl::CollisionObject<double>;
using Geometry = fcl::CollisionGeometry<double>;
using Pose = fcl::Transform3<double>;
using CollisionRequest = fcl::CollisionRequest<double>;
using CollisionResult = fcl::CollisionResult<double>;
using DistanceRequest = fcl::DistanceRequest<double>;
using DistanceResult = fcl::DistanceResult<double>;

/// Holds the four queries that clients of libfcl import: fcl::collide<double> and
/// fcl::distance<double>.
struct Calls {
  std::size_t (*collide_objects)(const Object*, const Object*, const CollisionRequest&,
                                 CollisionResult&);
  std::size_t (*collide)(const Geometry*, const Pose&, const Geometry*, const Pose&,
                         const CollisionRequest&, CollisionResult&);
  double (*distance_objects)(const Object*, const Object*, const DistanceRequest&, DistanceResult&);
  double (*distance)(const Geometry*, const Pose&, const Geometry*, const Pose&,
                     const DistanceRequest&, DistanceResult&);
};

/// Says what the environment variable FCL_KIOS_PRELOAD asks for.
enum class Mode { kOff, kOn, kTrust, kVerify, kStats };

/// Calls of FCL's functions without which no model gets another content, but by writing it in
/// place: those that fit a volume, as builds and refits make them, and the end of a geometry, to
/// whose place another may be copied. Counted in Mode::kTrust only.
struct Fits {
  std::atomic<std::uint64_t> count{0};
  /// Whether a build was seen that read these vertices.
  bool (*seen)(const void* vertices) = nullptr;
};

struct Start {
  Calls fcl;  ///< FCL's own, to hand queries on to
  Mode mode;
  const Fits* fits;
};

/// Says what the interposer calls around fork(): before it, and after it in both processes. The
/// child has one thread, and so must find nothing that another one had taken.
struct Forks {
  void (*before)();
  void (*in_parent)();
  void (*in_child)();
};

struct Opened {
  const Calls* calls;  ///< nullptr: this FCL can't be served
  Forks forks;
  const char* difference;  ///< what of it is unlike libfcl.so.0.7 then
};

/// Is the type of the implementation's only symbol. Its calls throw nothing of their own.
using Open = Opened (*)(const Start*);
constexpr const char* kOpenName = "fcl_kios_preload_open";

}  // namespace kios::preload
