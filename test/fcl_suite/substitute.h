// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Included before FCL's own test files: the volume that IN_PLACE_OF_... names is ours from here on,
// in `kIOS<S>` and `fcl::kIOS<S>` alike, and so are its traversal nodes.

#include "prelude.h"

namespace fcl {
template <typename S>
using KiosInstead = kios::kIOS<S>;
namespace detail {
template <typename S>
using KiosCollisionNodeInstead = kios::MeshCollisionTraversalNode<S>;
template <typename S>
using KiosDistanceNodeInstead = kios::MeshDistanceTraversalNode<S>;
}  // namespace detail
}  // namespace fcl

#if defined(IN_PLACE_OF_kIOS)
#define kIOS KiosInstead
#define MeshCollisionTraversalNodekIOS KiosCollisionNodeInstead
#define MeshDistanceTraversalNodekIOS KiosDistanceNodeInstead
#elif defined(IN_PLACE_OF_RSS)
#define RSS KiosInstead
#define MeshCollisionTraversalNodeRSS KiosCollisionNodeInstead
#define MeshDistanceTraversalNodeRSS KiosDistanceNodeInstead
#elif defined(IN_PLACE_OF_OBB)
#define OBB KiosInstead
#define MeshCollisionTraversalNodeOBB KiosCollisionNodeInstead
#elif defined(IN_PLACE_OF_OBBRSS)
#define OBBRSS KiosInstead
#define MeshCollisionTraversalNodeOBBRSS KiosCollisionNodeInstead
#define MeshDistanceTraversalNodeOBBRSS KiosDistanceNodeInstead
#else
#error "one of IN_PLACE_OF_kIOS, _RSS, _OBB and _OBBRSS"
#endif
