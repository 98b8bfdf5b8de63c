// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fcl_kios/compiler.h"  // first, as it says what flags are wrong

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

namespace kios::fcl_own {

template <typename S>
std::size_t collide(const fcl::CollisionGeometry<S>* o1, const fcl::Transform3<S>& tf1,
                    const fcl::CollisionGeometry<S>* o2, const fcl::Transform3<S>& tf2,
                    const fcl::CollisionRequest<S>& request, fcl::CollisionResult<S>& result) {
  return fcl::collide<S>(o1, tf1, o2, tf2, request, result);
}
template <typename S, typename Solver>
std::size_t collide(const fcl::CollisionGeometry<S>* o1, const fcl::Transform3<S>& tf1,
                    const fcl::CollisionGeometry<S>* o2, const fcl::Transform3<S>& tf2,
                    const Solver* solver, const fcl::CollisionRequest<S>& request,
                    fcl::CollisionResult<S>& result) {
  return fcl::collide<S, Solver>(o1, tf1, o2, tf2, solver, request, result);
}
template <typename S>
S distance(const fcl::CollisionGeometry<S>* o1, const fcl::Transform3<S>& tf1,
           const fcl::CollisionGeometry<S>* o2, const fcl::Transform3<S>& tf2,
           const fcl::DistanceRequest<S>& request, fcl::DistanceResult<S>& result) {
  return fcl::distance<S>(o1, tf1, o2, tf2, request, result);
}
template <typename S, typename Solver>
S distance(const fcl::CollisionGeometry<S>* o1, const fcl::Transform3<S>& tf1,
           const fcl::CollisionGeometry<S>* o2, const fcl::Transform3<S>& tf2, const Solver* solver,
           const fcl::DistanceRequest<S>& request, fcl::DistanceResult<S>& result) {
  return fcl::distance<Solver>(o1, tf1, o2, tf2, solver, request, result);
}
template <typename S>
S continuousCollide(const fcl::CollisionGeometry<S>* o1, const fcl::MotionBase<S>* motion1,
                    const fcl::CollisionGeometry<S>* o2, const fcl::MotionBase<S>* motion2,
                    const fcl::ContinuousCollisionRequest<S>& request,
                    fcl::ContinuousCollisionResult<S>& result) {
  return fcl::continuousCollide<S>(o1, motion1, o2, motion2, request, result);
}
template <typename S>
S continuousCollide(const fcl::CollisionGeometry<S>* o1, const fcl::Transform3<S>& tf1_beg,
                    const fcl::Transform3<S>& tf1_end, const fcl::CollisionGeometry<S>* o2,
                    const fcl::Transform3<S>& tf2_beg, const fcl::Transform3<S>& tf2_end,
                    const fcl::ContinuousCollisionRequest<S>& request,
                    fcl::ContinuousCollisionResult<S>& result) {
  return fcl::continuousCollide<S>(o1, tf1_beg, tf1_end, o2, tf2_beg, tf2_end, request, result);
}

}  // namespace kios::fcl_own
