// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

// The one translation unit that instantiates FCL's function tables for float, which libfcl lacks.

#include "fcl/dispatch.h"
#include "fcl_kios/overloads.h"

namespace fcl {

template std::size_t collide(const CollisionGeometry<float>*, const Transform3<float>&,
                             const CollisionGeometry<float>*, const Transform3<float>&,
                             const CollisionRequest<float>&, CollisionResult<float>&);
inline namespace kios_overloads {

[[gnu::hot]] std::size_t collide(const CollisionObject<float>* o1, const CollisionObject<float>* o2,
                                 const CollisionRequest<float>& request,
                                 CollisionResult<float>& result) {
  return kios::collide(o1, o2, request, result);
}

std::size_t collide(const CollisionGeometry<float>* o1, const Transform3<float>& tf1,
                    const CollisionGeometry<float>* o2, const Transform3<float>& tf2,
                    const CollisionRequest<float>& request, CollisionResult<float>& result) {
  return kios::collide(o1, tf1, o2, tf2, request, result);
}

[[gnu::hot]] float distance(const CollisionObject<float>* o1, const CollisionObject<float>* o2,
                            const DistanceRequest<float>& request, DistanceResult<float>& result) {
  return kios::distance(o1, o2, request, result);
}

float distance(const CollisionGeometry<float>* o1, const Transform3<float>& tf1,
               const CollisionGeometry<float>* o2, const Transform3<float>& tf2,
               const DistanceRequest<float>& request, DistanceResult<float>& result) {
  return kios::distance(o1, tf1, o2, tf2, request, result);
}

}  // namespace kios_overloads
}  // namespace fcl
