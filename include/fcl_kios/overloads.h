// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <type_traits>

#include "fcl_kios/detail/fcl_own.h"

// fcl::collide, fcl::distance and fcl::continuousCollide for objects that may hold a kios::kIOS
// model. FCL dispatches through tables inside libfcl that a foreign volume can't join; these
// overloads are preferred by overload resolution, also where FCL's default broadphase callbacks
// call them, and hand every pair without a kIOS model to FCL.
//
// libfcl holds FCL's queries in double alone. Those in float are templates, of FCL's and of ours: a
// file that calls them includes <fcl/narrowphase/collision.h> or <fcl/narrowphase/distance.h> and
// compiles FCL's tables, as without us. Where many files do, `extern template` lines in a header
// and one file that instantiates them spare the time (docs/swapping.md).
//
// A translation unit that sees objects only through FCL's headers needs this (light) header too:
// link the CMake target fcl_kios::force_include. Before C++20, explicit template arguments, and
// solver types that aren't templates of the scalar, reach FCL's templates, which know no kIOS (the
// model throws): write fcl::collide(...). In C++20 these forms come here too.
//
// A finished mesh over k-IOS is served against another, FCL's nine shapes and octrees; any other
// pair with a kIOS model throws std::invalid_argument and names both types. So does an unfinished
// model or a pose that isn't rigid, and a null object or geometry in any pair. Without a kIOS model
// all else is as in FCL.

namespace kios {
/// Returns true if the geometry is a fcl::BVHModel<kIOS>, finished or not.
bool holdsModel(const fcl::CollisionGeometry<double>* geometry);
bool holdsModel(const fcl::CollisionGeometry<float>* geometry);
namespace detail {
/// Throws std::invalid_argument if either is null.
void requireObjects(const void* object1, const void* object2);
/// Answers a pair with a kIOS model, and returns nothing for any other.
std::optional<std::size_t> collideModel(const fcl::CollisionGeometry<float>* o1,
                                        const fcl::Transform3<float>& tf1,
                                        const fcl::CollisionGeometry<float>* o2,
                                        const fcl::Transform3<float>& tf2,
                                        const fcl::CollisionRequest<float>& request,
                                        fcl::CollisionResult<float>& result);
std::optional<float> distanceOfModel(const fcl::CollisionGeometry<float>* o1,
                                     const fcl::Transform3<float>& tf1,
                                     const fcl::CollisionGeometry<float>* o2,
                                     const fcl::Transform3<float>& tf2,
                                     const fcl::DistanceRequest<float>& request,
                                     fcl::DistanceResult<float>& result);
}  // namespace detail
}  // namespace kios

namespace fcl {
inline namespace kios_overloads {

std::size_t collide(const CollisionObject<double>* o1, const CollisionObject<double>* o2,
                    const CollisionRequest<double>& request, CollisionResult<double>& result);
std::size_t collide(const CollisionGeometry<double>* o1, const Transform3<double>& tf1,
                    const CollisionGeometry<double>* o2, const Transform3<double>& tf2,
                    const CollisionRequest<double>& request, CollisionResult<double>& result);

/// Returns result.min_distance: 0 for meshes that intersect (polygon soups have no inside, so
/// enable_signed_distance adds nothing, but for marked solids: fcl_kios/solids.h), unchanged if the
/// pair is not nearer than it was on entry.
double distance(const CollisionObject<double>* o1, const CollisionObject<double>* o2,
                const DistanceRequest<double>& request, DistanceResult<double>& result);
double distance(const CollisionGeometry<double>* o1, const Transform3<double>& tf1,
                const CollisionGeometry<double>* o2, const Transform3<double>& tf2,
                const DistanceRequest<double>& request, DistanceResult<double>& result);

/// Names CollisionObject<float>, which is complete where a template is instantiated.
template <int kLate>
using LateObject = std::enable_if_t<kLate == 0, CollisionObject<float>>;

/// These serve floats. They are templates, so that FCL's tables are instantiated where they are
/// called, and more specialised than FCL's, so that they are preferred.
template <int = 0>
std::size_t collide(const CollisionGeometry<float>* o1, const Transform3<float>& tf1,
                    const CollisionGeometry<float>* o2, const Transform3<float>& tf2,
                    const CollisionRequest<float>& request, CollisionResult<float>& result) {
  const auto contacts = kios::detail::collideModel(o1, tf1, o2, tf2, request, result);
  return contacts ? *contacts : kios::fcl_own::collide(o1, tf1, o2, tf2, request, result);
}
template <int kLate = 0>
std::size_t collide(const CollisionObject<float>* o1, const CollisionObject<float>* o2,
                    const CollisionRequest<float>& request, CollisionResult<float>& result) {
  kios::detail::requireObjects(o1, o2);
  const LateObject<kLate>& a = *o1;
  const LateObject<kLate>& b = *o2;
  return kios_overloads::collide(a.collisionGeometry().get(), a.getTransform(),
                                 b.collisionGeometry().get(), b.getTransform(), request, result);
}
template <int = 0>
float distance(const CollisionGeometry<float>* o1, const Transform3<float>& tf1,
               const CollisionGeometry<float>* o2, const Transform3<float>& tf2,
               const DistanceRequest<float>& request, DistanceResult<float>& result) {
  const auto apart = kios::detail::distanceOfModel(o1, tf1, o2, tf2, request, result);
  return apart ? *apart : kios::fcl_own::distance(o1, tf1, o2, tf2, request, result);
}
template <int kLate = 0>
float distance(const CollisionObject<float>* o1, const CollisionObject<float>* o2,
               const DistanceRequest<float>& request, DistanceResult<float>& result) {
  kios::detail::requireObjects(o1, o2);
  const LateObject<kLate>& a = *o1;
  const LateObject<kLate>& b = *o2;
  return kios_overloads::distance(a.collisionGeometry().get(), a.getTransform(),
                                  b.collisionGeometry().get(), b.getTransform(), request, result);
}

/// Finds the first contact of two moving objects: kios::firstContact's contract, by one method for
/// every solver and motion type; FCL's own misses contacts. Motions and models are only read.
/// Double only, as FCL 0.7's continuousCollide<float> doesn't compile.
double continuousCollide(const CollisionGeometry<double>* o1, const MotionBase<double>* motion1,
                         const CollisionGeometry<double>* o2, const MotionBase<double>* motion2,
                         const ContinuousCollisionRequest<double>& request,
                         ContinuousCollisionResult<double>& result);
double continuousCollide(const CollisionGeometry<double>* o1, const Transform3<double>& tf1_beg,
                         const Transform3<double>& tf1_end, const CollisionGeometry<double>* o2,
                         const Transform3<double>& tf2_beg, const Transform3<double>& tf2_end,
                         const ContinuousCollisionRequest<double>& request,
                         ContinuousCollisionResult<double>& result);
double continuousCollide(const CollisionObject<double>* o1, const Transform3<double>& tf1_end,
                         const CollisionObject<double>* o2, const Transform3<double>& tf2_end,
                         const ContinuousCollisionRequest<double>& request,
                         ContinuousCollisionResult<double>& result);
double collide(const ContinuousCollisionObject<double>* o1,
               const ContinuousCollisionObject<double>* o2,
               const ContinuousCollisionRequest<double>& request,
               ContinuousCollisionResult<double>& result);

/// Serve the forms with a GJK solver, which pairs with a kIOS model don't need. Templates, so that
/// only files which call them pay for FCL's, and more specialised than FCL's.
template <typename S, template <typename> class Solver>
std::size_t collide(const CollisionGeometry<S>* o1, const Transform3<S>& tf1,
                    const CollisionGeometry<S>* o2, const Transform3<S>& tf2,
                    const Solver<S>* solver, const CollisionRequest<S>& request,
                    CollisionResult<S>& result) {
  if (kios::holdsModel(o1) || kios::holdsModel(o2)) {
    return kios_overloads::collide(o1, tf1, o2, tf2, request, result);
  }
  return kios::fcl_own::collide(o1, tf1, o2, tf2, solver, request, result);
}
template <typename S, template <typename> class Solver>
std::size_t collide(const CollisionObject<S>* o1, const CollisionObject<S>* o2,
                    const Solver<S>* solver, const CollisionRequest<S>& request,
                    CollisionResult<S>& result) {
  kios::detail::requireObjects(o1, o2);
  return kios_overloads::collide(o1->collisionGeometry().get(), o1->getTransform(),
                                 o2->collisionGeometry().get(), o2->getTransform(), solver, request,
                                 result);
}
template <typename S, template <typename> class Solver>
S distance(const CollisionGeometry<S>* o1, const Transform3<S>& tf1, const CollisionGeometry<S>* o2,
           const Transform3<S>& tf2, const Solver<S>* solver, const DistanceRequest<S>& request,
           DistanceResult<S>& result) {
  if (kios::holdsModel(o1) || kios::holdsModel(o2)) {
    return kios_overloads::distance(o1, tf1, o2, tf2, request, result);
  }
  return kios::fcl_own::distance(o1, tf1, o2, tf2, solver, request, result);
}
template <typename S, template <typename> class Solver>
S distance(const CollisionObject<S>* o1, const CollisionObject<S>* o2, const Solver<S>* solver,
           const DistanceRequest<S>& request, DistanceResult<S>& result) {
  kios::detail::requireObjects(o1, o2);
  return kios_overloads::distance(o1->collisionGeometry().get(), o1->getTransform(),
                                  o2->collisionGeometry().get(), o2->getTransform(), solver,
                                  request, result);
}

#if defined(__cpp_concepts) && __cpp_concepts >= 201907L
// C++20: more constrained than FCL's templates, which explicit template arguments and other
// solvers reach otherwise. The return types are deduced so that FCL's `extern template` lines,
// which name a type, mean FCL's templates and not these.
template <typename S>
concept KiosScalar = std::is_same_v<S, double> || std::is_same_v<S, float>;

template <typename S>
requires KiosScalar<S> auto collide(const CollisionObject<S>* o1, const CollisionObject<S>* o2,
                                    const CollisionRequest<S>& request,
                                    CollisionResult<S>& result) {
  return kios_overloads::collide(o1, o2, request, result);
}
template <typename S>
requires KiosScalar<S> auto collide(const CollisionGeometry<S>* o1, const Transform3<S>& tf1,
                                    const CollisionGeometry<S>* o2, const Transform3<S>& tf2,
                                    const CollisionRequest<S>& request,
                                    CollisionResult<S>& result) {
  return kios_overloads::collide(o1, tf1, o2, tf2, request, result);
}
template <typename S>
requires KiosScalar<S> auto distance(const CollisionObject<S>* o1, const CollisionObject<S>* o2,
                                     const DistanceRequest<S>& request, DistanceResult<S>& result) {
  return kios_overloads::distance(o1, o2, request, result);
}
template <typename S>
requires KiosScalar<S> auto distance(const CollisionGeometry<S>* o1, const Transform3<S>& tf1,
                                     const CollisionGeometry<S>* o2, const Transform3<S>& tf2,
                                     const DistanceRequest<S>& request, DistanceResult<S>& result) {
  return kios_overloads::distance(o1, tf1, o2, tf2, request, result);
}

template <typename S>
requires std::is_same_v<S, double> auto continuousCollide(
    const CollisionGeometry<S>* o1, const MotionBase<S>* motion1, const CollisionGeometry<S>* o2,
    const MotionBase<S>* motion2, const ContinuousCollisionRequest<S>& request,
    ContinuousCollisionResult<S>& result) {
  return kios_overloads::continuousCollide(o1, motion1, o2, motion2, request, result);
}
template <typename S>
requires std::is_same_v<S, double> auto continuousCollide(
    const CollisionGeometry<S>* o1, const Transform3<S>& tf1_beg, const Transform3<S>& tf1_end,
    const CollisionGeometry<S>* o2, const Transform3<S>& tf2_beg, const Transform3<S>& tf2_end,
    const ContinuousCollisionRequest<S>& request, ContinuousCollisionResult<S>& result) {
  return kios_overloads::continuousCollide(o1, tf1_beg, tf1_end, o2, tf2_beg, tf2_end, request,
                                           result);
}
template <typename S>
requires std::is_same_v<S, double> auto continuousCollide(
    const CollisionObject<S>* o1, const Transform3<S>& tf1_end, const CollisionObject<S>* o2,
    const Transform3<S>& tf2_end, const ContinuousCollisionRequest<S>& request,
    ContinuousCollisionResult<S>& result) {
  return kios_overloads::continuousCollide(o1, tf1_end, o2, tf2_end, request, result);
}
template <typename S>
requires std::is_same_v<S, double> auto collide(const ContinuousCollisionObject<S>* o1,
                                                const ContinuousCollisionObject<S>* o2,
                                                const ContinuousCollisionRequest<S>& request,
                                                ContinuousCollisionResult<S>& result) {
  return kios_overloads::collide(o1, o2, request, result);
}

template <typename S, typename NarrowPhaseSolver>
requires KiosScalar<S> auto collide(const CollisionGeometry<S>* o1, const Transform3<S>& tf1,
                                    const CollisionGeometry<S>* o2, const Transform3<S>& tf2,
                                    const NarrowPhaseSolver* solver,
                                    const CollisionRequest<S>& request,
                                    CollisionResult<S>& result) {
  if (kios::holdsModel(o1) || kios::holdsModel(o2)) {
    return kios_overloads::collide(o1, tf1, o2, tf2, request, result);
  }
  return kios::fcl_own::collide(o1, tf1, o2, tf2, solver, request, result);
}
template <typename S, typename NarrowPhaseSolver>
requires KiosScalar<S> auto collide(const CollisionObject<S>* o1, const CollisionObject<S>* o2,
                                    const NarrowPhaseSolver* solver,
                                    const CollisionRequest<S>& request,
                                    CollisionResult<S>& result) {
  kios::detail::requireObjects(o1, o2);
  return kios_overloads::collide(o1->collisionGeometry().get(), o1->getTransform(),
                                 o2->collisionGeometry().get(), o2->getTransform(), solver, request,
                                 result);
}
template <typename NarrowPhaseSolver>
requires KiosScalar<typename NarrowPhaseSolver::S> auto distance(
    const CollisionGeometry<typename NarrowPhaseSolver::S>* o1,
    const Transform3<typename NarrowPhaseSolver::S>& tf1,
    const CollisionGeometry<typename NarrowPhaseSolver::S>* o2,
    const Transform3<typename NarrowPhaseSolver::S>& tf2, const NarrowPhaseSolver* solver,
    const DistanceRequest<typename NarrowPhaseSolver::S>& request,
    DistanceResult<typename NarrowPhaseSolver::S>& result) {
  if (kios::holdsModel(o1) || kios::holdsModel(o2)) {
    return kios_overloads::distance(o1, tf1, o2, tf2, request, result);
  }
  return kios::fcl_own::distance(o1, tf1, o2, tf2, solver, request, result);
}
template <typename NarrowPhaseSolver>
requires KiosScalar<typename NarrowPhaseSolver::S> auto distance(
    const CollisionObject<typename NarrowPhaseSolver::S>* o1,
    const CollisionObject<typename NarrowPhaseSolver::S>* o2, const NarrowPhaseSolver* solver,
    const DistanceRequest<typename NarrowPhaseSolver::S>& request,
    DistanceResult<typename NarrowPhaseSolver::S>& result) {
  kios::detail::requireObjects(o1, o2);
  return kios_overloads::distance(o1->collisionGeometry().get(), o1->getTransform(),
                                  o2->collisionGeometry().get(), o2->getTransform(), solver,
                                  request, result);
}
#endif

}  // namespace kios_overloads
}  // namespace fcl
