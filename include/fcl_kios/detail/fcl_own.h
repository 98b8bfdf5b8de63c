// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fcl_kios/detail/compiler.h"  // first, as it says what flags are wrong

#include <cstddef>

#include <fcl/common/types.h>

// FCL's own queries, for pairs without a kIOS model. A template's qualified calls are looked up
// where it is defined: here, as overloads.h includes this file first, they find FCL's templates
// only. Later, in C++20, fcl::collide<S>(...) would find our constrained ones.

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
template <typename S>
class ContinuousCollisionObject;
template <typename S>
struct ContinuousCollisionRequest;
template <typename S>
struct ContinuousCollisionResult;
template <typename S>
class MotionBase;

template <typename S>
FCL_EXPORT std::size_t collide(const CollisionGeometry<S>* o1, const Transform3<S>& tf1,
                               const CollisionGeometry<S>* o2, const Transform3<S>& tf2,
                               const CollisionRequest<S>& request, CollisionResult<S>& result);
template <typename S, typename NarrowPhaseSolver>
FCL_EXPORT std::size_t collide(const CollisionGeometry<S>* o1, const Transform3<S>& tf1,
                               const CollisionGeometry<S>* o2, const Transform3<S>& tf2,
                               const NarrowPhaseSolver* nsolver, const CollisionRequest<S>& request,
                               CollisionResult<S>& result);
template <typename S>
FCL_EXPORT S distance(const CollisionGeometry<S>* o1, const Transform3<S>& tf1,
                      const CollisionGeometry<S>* o2, const Transform3<S>& tf2,
                      const DistanceRequest<S>& request, DistanceResult<S>& result);
template <typename NarrowPhaseSolver>
typename NarrowPhaseSolver::S distance(
    const CollisionGeometry<typename NarrowPhaseSolver::S>* o1,
    const Transform3<typename NarrowPhaseSolver::S>& tf1,
    const CollisionGeometry<typename NarrowPhaseSolver::S>* o2,
    const Transform3<typename NarrowPhaseSolver::S>& tf2, const NarrowPhaseSolver* nsolver,
    const DistanceRequest<typename NarrowPhaseSolver::S>& request,
    DistanceResult<typename NarrowPhaseSolver::S>& result);
template <typename S>
FCL_EXPORT S continuousCollide(const CollisionGeometry<S>* o1, const MotionBase<S>* motion1,
                               const CollisionGeometry<S>* o2, const MotionBase<S>* motion2,
                               const ContinuousCollisionRequest<S>& request,
                               ContinuousCollisionResult<S>& result);
template <typename S>
FCL_EXPORT S continuousCollide(const CollisionGeometry<S>* o1, const Transform3<S>& tf1_beg,
                               const Transform3<S>& tf1_end, const CollisionGeometry<S>* o2,
                               const Transform3<S>& tf2_beg, const Transform3<S>& tf2_end,
                               const ContinuousCollisionRequest<S>& request,
                               ContinuousCollisionResult<S>& result);
}  // namespace fcl

// The functions declared above, and not those that are declared later.
namespace kios::fcl_own {
using fcl::collide;
using fcl::continuousCollide;
using fcl::distance;
}  // namespace kios::fcl_own
