// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "preload/implementation.h"

#include <cmath>

namespace kios::preload {
namespace {

bool isOther(fcl::NODE_TYPE type) {
  static_assert(fcl::GEOM_HALFSPACE - fcl::GEOM_BOX == 8, "FCL has other shapes");
  return (type >= fcl::GEOM_BOX && type <= fcl::GEOM_HALFSPACE) || type == fcl::GEOM_OCTREE;
}

bool read(const Geometry* geometry, fcl::NODE_TYPE type, Mesh& mesh) {
  return withModel(*geometry, type, [&](const auto& model) { return readMesh(model, mesh); });
}

bool isKnown(fcl::GJKSolverType solver) {
  return solver == fcl::GST_LIBCCD || solver == fcl::GST_INDEP;
}

/// Calls ask(mesh, pair) with the mesh first if one of the two is a mesh and the other a shape or
/// an octree.
template <typename Ask>
By askAboutOther(const PosedPair& pair, fcl::NODE_TYPE type_a, fcl::NODE_TYPE type_b,
                 const Ask& ask) {
  Mesh mesh;
  if (isServed(type_a) && isOther(type_b) && read(pair.a, type_a, mesh)) return ask(mesh, pair);
  if (isServed(type_b) && isOther(type_a) && read(pair.b, type_b, mesh)) {
    return ask(mesh, PosedPair{pair.b, pair.X_WB, pair.a, pair.X_WA});
  }
  return By::kHandedOn;
}

}  // namespace

By Implementation::answer(const PosedPair& pair, const CollisionRequest& request,
                          CollisionResult& result) {
  const fcl::NODE_TYPE type_a = pair.a->getNodeType(), type_b = pair.b->getNodeType();
  if (request.enable_cost || request.num_max_contacts == 0 || request.enable_cached_gjk_guess ||
      !isKnown(request.gjk_solver_type)) {
    return By::kHandedOn;
  }
  if (type_a == type_b) {
    return withModel(*pair.a, type_a, [&](const auto& model_a) {
      return answerModels(*this, model_a, pair, request, result);
    });
  }
  return askAboutOther(pair, type_a, type_b, [&](const Mesh& mesh, const PosedPair& ordered) {
    return answerWithOther(*this, mesh, ordered, request, result);
  });
}

By Implementation::answer(const PosedPair& pair, const DistanceRequest& request,
                          DistanceResult& result) {
  const fcl::NODE_TYPE type_a = pair.a->getNodeType(), type_b = pair.b->getNodeType();
  // FCL stops at once at a bound of 0 or less, but may ask for the depth of a negative one.
  if (!isKnown(request.gjk_solver_type) || !(result.min_distance > 0)) return By::kHandedOn;
  if (type_a == type_b) {
    return withModel(*pair.a, type_a, [&](const auto& model_a) {
      return answerModels(*this, model_a, pair, request, result);
    });
  }
  return askAboutOther(pair, type_a, type_b, [&](const Mesh& mesh, const PosedPair& ordered) {
    // Nor has FCL a distance of OBB and a shape.
    const bool octree = ordered.b->getNodeType() == fcl::GEOM_OCTREE;
    if (ordered.a->getNodeType() == fcl::BV_OBB && !octree) return By::kHandedOn;
    return answerWithOther(*this, mesh, ordered, result);
  });
}

void Implementation::makeCopy(const Mesh& mesh) {
  {
    const CopyCache::ModelLease lease = copies.lease(mesh);
    if (!lease || (lease.hasCopy() && lease.isCurrent())) return;
  }
  copies.make(mesh);
}

bool isRigid(const Pose& X) {
  // A tenth of what k-IOS takes, so that roundings don't matter. False for NaN.
  constexpr double kMost = 1e-5;
  const fcl::Matrix3d R = X.linear();
  const double error = (R.transpose() * R - fcl::Matrix3d::Identity()).squaredNorm();
  return error <= kMost * kMost && R.determinant() > 0 && X.translation().allFinite();
}

}  // namespace kios::preload
