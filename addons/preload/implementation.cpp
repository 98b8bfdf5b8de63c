// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "preload/implementation.h"

#include <cmath>

namespace kios::preload {
namespace {

bool isOther(fcl::NODE_TYPE type) {
  switch (type) {
    case fcl::GEOM_BOX:
    case fcl::GEOM_SPHERE:
    case fcl::GEOM_ELLIPSOID:
    case fcl::GEOM_CAPSULE:
    case fcl::GEOM_CONE:
    case fcl::GEOM_CYLINDER:
    case fcl::GEOM_CONVEX:
    case fcl::GEOM_PLANE:
    case fcl::GEOM_HALFSPACE:
    case fcl::GEOM_OCTREE:
      return true;
    default:
      return false;
  }
}

bool read(const Geometry* geometry, fcl::NODE_TYPE type, Mesh& mesh) {
  switch (type) {
    case fcl::BV_OBB:
      return readMesh<fcl::OBBd>(geometry, mesh);
    case fcl::BV_RSS:
      return readMesh<fcl::RSSd>(geometry, mesh);
    case fcl::BV_kIOS:
      return readMesh<fcl::kIOSd>(geometry, mesh);
    case fcl::BV_OBBRSS:
      return readMesh<fcl::OBBRSSd>(geometry, mesh);
    default:
      return false;
  }
}

template <typename S>
bool isKnown(S solver) {
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

By Implementation::collide(const PosedPair& pair, const CollisionRequest& request,
                           CollisionResult& result) {
  const fcl::NODE_TYPE type_a = pair.a->getNodeType(), type_b = pair.b->getNodeType();
  if (request.enable_cost || request.num_max_contacts == 0 || request.enable_cached_gjk_guess ||
      !isKnown(request.gjk_solver_type)) {
    return By::kHandedOn;
  }
  if (type_a == type_b) {
    switch (type_a) {
      case fcl::BV_OBB:
        return collideModels<fcl::OBBd>(*this, pair, request, result);
      case fcl::BV_RSS:
        return collideModels<fcl::RSSd>(*this, pair, request, result);
      case fcl::BV_kIOS:
        return collideModels<fcl::kIOSd>(*this, pair, request, result);
      default:
        return collideModels<fcl::OBBRSSd>(*this, pair, request, result);
    }
  }
  return askAboutOther(pair, type_a, type_b, [&](const Mesh& mesh, const PosedPair& ordered) {
    return collideWithOther(*this, mesh, ordered, request, result);
  });
}

By Implementation::distance(const PosedPair& pair, const DistanceRequest& request,
                            DistanceResult& result) {
  const fcl::NODE_TYPE type_a = pair.a->getNodeType(), type_b = pair.b->getNodeType();
  // FCL stops at once at a bound of 0 or less, but may ask for the depth of a negative one.
  if (!isKnown(request.gjk_solver_type) || !(result.min_distance > 0)) return By::kHandedOn;
  if (type_a == type_b) {
    switch (type_a) {
      case fcl::BV_OBB:  // FCL has no such distance, and says so
        return By::kHandedOn;
      case fcl::BV_RSS:
        return distanceOfModels<fcl::RSSd>(*this, pair, request, result);
      case fcl::BV_kIOS:
        return distanceOfModels<fcl::kIOSd>(*this, pair, request, result);
      default:
        return distanceOfModels<fcl::OBBRSSd>(*this, pair, request, result);
    }
  }
  return askAboutOther(pair, type_a, type_b, [&](const Mesh& mesh, const PosedPair& ordered) {
    // Nor has it that of OBB and a shape.
    const bool octree = ordered.b->getNodeType() == fcl::GEOM_OCTREE;
    if (ordered.a->getNodeType() == fcl::BV_OBB && !octree) return By::kHandedOn;
    return distanceToOther(*this, mesh, ordered, result);
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

DistanceRequest exact(bool nearest_points) { return DistanceRequest(nearest_points); }

}  // namespace kios::preload
