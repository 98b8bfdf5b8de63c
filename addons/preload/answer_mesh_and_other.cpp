// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// A mesh and one of FCL's shapes, or an octree.
#include <cmath>
#include <exception>

#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/cone.h>
#include <fcl/geometry/shape/convex.h>
#include <fcl/geometry/shape/cylinder.h>
#include <fcl/geometry/shape/ellipsoid.h>
#include <fcl/geometry/shape/sphere.h>
#include "fcl_kios/contact.h"
#include "preload/implementation.h"
#include "volume/rounding.h"

namespace kios::preload {
namespace {

// What FCL's searches take, in nanoseconds, as `kios_bench preload` measures them: their tests
// can't be counted from here.
constexpr double kCollideByFcl = 3e3;
double timeOfDistance(const Mesh& mesh) {
  return 1e4 + 20 * static_cast<double>(mesh.num_triangles);
}
/// Says how long a mesh may be compared for a distance: FCL's take so much longer that any
/// comparison pays.
constexpr double kAnyTime = 1e9;

/// Does so for a verdict about a near pair: FCL's time less the copy's.
double timeToCompare(const Geometry& other) {
  switch (other.getNodeType()) {
    case fcl::GEOM_BOX:
    case fcl::GEOM_PLANE:
    case fcl::GEOM_HALFSPACE:
    case fcl::GEOM_OCTREE:  // of 20 us or more that both take
      return 1.3e3;
    default:
      return 6e3;  // FCL's GJK
  }
}

bool isOctree(const Geometry& geometry) { return geometry.getNodeType() == fcl::GEOM_OCTREE; }

/// Returns the radius of a sphere about the shape's origin that holds it; infinity where that isn't
/// cheap.
double radiusOf(const Geometry& shape) {
  const auto ofRound = [](const auto& round) { return round.radius + round.lz / 2; };
  switch (shape.getNodeType()) {
    case fcl::GEOM_BOX:
      return static_cast<const fcl::Boxd&>(shape).side.norm() / 2;
    case fcl::GEOM_SPHERE:
      return static_cast<const fcl::Sphered&>(shape).radius;
    case fcl::GEOM_ELLIPSOID:
      return static_cast<const fcl::Ellipsoidd&>(shape).radii.maxCoeff();
    case fcl::GEOM_CAPSULE:
      return ofRound(static_cast<const fcl::Capsuled&>(shape));
    case fcl::GEOM_CONE:
      return ofRound(static_cast<const fcl::Coned&>(shape));
    case fcl::GEOM_CYLINDER:
      return ofRound(static_cast<const fcl::Cylinderd&>(shape));
    default:
      return kInfinity;
  }
}

/// Holds a box that holds the model, by its root: centre and half sides along axes.
struct RootBox {
  fcl::Matrix3d axes;
  fcl::Vector3d center, half;
};
RootBox boxOf(const fcl::OBBd& box) { return {box.axis, box.To, box.extent}; }
RootBox boxOf(const fcl::OBBRSSd& bv) { return boxOf(bv.obb); }
RootBox boxOf(const fcl::kIOSd& bv) { return boxOf(bv.obb); }
RootBox boxOf(const fcl::RSSd& bv) {
  const fcl::Vector3d sides(bv.l[0] / 2, bv.l[1] / 2, 0);
  return {bv.axis, bv.To + bv.axis * sides, sides + fcl::Vector3d::Constant(bv.r)};
}

/// Whether the shape is clear of the model's root volume, by more than FCL's solvers are inexact:
/// FCL's volumes or solvers find no contact either.
bool isAway(const PosedPair& pair) {
  constexpr double kMargin = 1e-3;
  const RootBox root = withModel(*pair.a, pair.a->getNodeType(),
                                 [](const auto& model) { return boxOf(model.getBV(0).bv); });
  const fcl::Vector3d center =
      root.axes.transpose() *
      (pair.X_WA.linear().transpose() * (pair.X_WB.translation() - pair.X_WA.translation()) -
       root.center);
  const double radius = radiusOf(*pair.b) + kMargin * root.half.maxCoeff();
  return ((center.cwiseAbs() - root.half).array() > (1 + kMargin) * radius).any();
}

/// Calls ask(copy) with the mesh's current copy. False if there is none, or comparing it would take
/// longer than that.
template <typename Ask>
bool askCopy(Implementation& implementation, const Mesh& mesh, double time_to_compare,
             double time_of_fcl, const Ask& ask) {
  const auto takesTooLong = [&](std::size_t bytes) {
    return !implementation.always() && timeOfComparison(bytes) > time_to_compare;
  };
  const bool may_trust = implementation.start.mode == Mode::kTrust;
  if (!may_trust && takesTooLong(mesh.bytes())) return false;
  if (implementation.always()) implementation.makeCopy(mesh);
  {
    const CopyCache::ModelLease lease = implementation.copies.lease(mesh);
    if (!lease) return false;
    if (lease.hasCopy()) {
      if (takesTooLong(lease.bytesToCompare())) return false;
      if (lease.isCurrent()) {
        ask(lease.copy());
        return true;
      }
    }
  }
  implementation.copies.pay(mesh, time_of_fcl);
  return false;
}

}  // namespace

By answerWithOther(Implementation& implementation, const Mesh& mesh, const PosedPair& pair,
                   const CollisionRequest& request, CollisionResult& result) {
  const bool octree = isOctree(*pair.b);
  if (request.isSatisfied(result) || !pair.b->isOccupied()) return By::kHandedOn;
  if (!isRigid(pair.X_WA) || !isRigid(pair.X_WB)) return By::kHandedOn;
  if (!octree && isAway(pair)) return By::kFclSearch;
  // Contacts are FCL's to list, after which a verdict was in vain.
  if (wantsContacts(request) && !implementation.always()) return By::kHandedOn;
  try {
    CollisionResult verdict;
    const auto ask = [&](const Modeld& copy) {
      const CollisionRequest one(1, false);
      if (octree) {
        collideOctree(static_cast<const fcl::OcTreed&>(*pair.b), pair.X_WB, copy, pair.X_WA, one,
                      verdict);
      } else {
        collideShape(copy, pair.X_WA, *pair.b, pair.X_WB, one, verdict);
      }
    };
    if (!askCopy(implementation, mesh, timeToCompare(*pair.b), kCollideByFcl, ask))
      return By::kHandedOn;
    if (!verdict.isCollision()) return By::kCopies;
    if (wantsContacts(request)) return By::kHandedOn;
    fcl::Contact<double> contact = verdict.getContact(0);
    (octree ? contact.o2 : contact.o1) = pair.a;
    result.addContact(contact);
    return By::kCopies;
  } catch (const std::exception&) {
    return By::kHandedOn;
  }
}

By answerWithOther(Implementation& implementation, const Mesh& mesh, const PosedPair& pair,
                   DistanceResult& result) {
  if (!isRigid(pair.X_WA) || !isRigid(pair.X_WB)) return By::kHandedOn;
  const bool octree = isOctree(*pair.b);
  try {
    DistanceResult found(result.min_distance);
    // FCL gives nearest points, wanted or not, and ignores the errors that a request allows.
    const DistanceRequest exact(/*enable_nearest_points=*/true);
    const auto ask = [&](const Modeld& copy) {
      if (octree) {
        distanceOctree(static_cast<const fcl::OcTreed&>(*pair.b), pair.X_WB, copy, pair.X_WA, exact,
                       found);
      } else {
        distanceShape(copy, pair.X_WA, *pair.b, pair.X_WB, exact, found);
      }
    };
    if (!askCopy(implementation, mesh, kAnyTime, timeOfDistance(mesh), ask)) return By::kHandedOn;
    // At overlap FCL gives what its solver does: -1, a depth.
    if (!(found.min_distance > 0)) return By::kHandedOn;
    if (found.min_distance < result.min_distance) {
      (octree ? found.o2 : found.o1) = pair.a;
      result = found;
    }
    return By::kCopies;
  } catch (const std::exception&) {
    return By::kHandedOn;
  }
}

}  // namespace kios::preload
