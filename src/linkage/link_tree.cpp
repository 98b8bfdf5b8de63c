// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "linkage/link_tree.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fcl/config.h>
#if FCL_HAVE_OCTOMAP
#include <fcl/geometry/octree/octree.h>
#endif
#include "continuous/motion.h"
#include "model/kios_model.h"
#include "model/shape_values.h"
#include "shape/shape_solid.h"
#include "volume/errors.h"
#include "volume/rounding.h"

namespace kios {
namespace {

using articulated::BodyData;
using articulated::BodyKind;
using articulated::CarriedBody;
using articulated::LinkData;
using Eigen::Vector3d;

constexpr double kLargest = 0x1p300;  // of coordinates and lengths, so that no product overflows

void requireTranslation(const Vector3d& t, const char* what) {
  if (!(t.lpNorm<1>() <= kLargest)) {
    refuse("the translation of the ", what, " is NaN, infinite or too large.");
  }
}

/// Points whose hull, grown by `margin`, contains a geometry, in its frame.
struct Hull {
  std::vector<Vector3d> points;
  double margin = 0;
  Vector3d center = Vector3d::Zero();
};

void addBox(const Vector3d& low, const Vector3d& high, std::vector<Vector3d>& points) {
  for (int i = 0; i < 8; ++i) {
    points.emplace_back((i & 1) != 0 ? high.x() : low.x(), (i & 2) != 0 ? high.y() : low.y(),
                        (i & 4) != 0 ? high.z() : low.z());
  }
}

/// Cylinders and cones lie in prisms of eight sides: 1 / cos(pi / 8) < 1.0824.
void addPrism(double radius, double half_length, std::vector<Vector3d>& points) {
  constexpr double kEighth = 0.7853981633974483;
  for (int i = 0; i < 8; ++i) {
    const double x = 1.0824 * radius * std::cos(i * kEighth);
    const double y = 1.0824 * radius * std::sin(i * kEighth);
    points.emplace_back(x, y, -half_length);
    points.emplace_back(x, y, half_length);
  }
}

Hull hullOf(const shape::Solid& solid) {
  using shape::Kind;
  Hull hull;
  hull.margin = solid.margin();
  switch (solid.kind) {
    case Kind::kSphere:
      hull.points = {Vector3d::Zero()};
      break;
    case Kind::kCapsule:
      hull.points = {{0, 0, -solid.half_length}, {0, 0, solid.half_length}};
      break;
    case Kind::kBox:
    case Kind::kEllipsoid:
      addBox(-solid.half, solid.half, hull.points);
      break;
    case Kind::kCylinder:
    case Kind::kCone:
      addPrism(solid.radius, solid.half_length, hull.points);
      break;
    case Kind::kConvex: {
      hull.points = solid.points;
      const auto [low, high] = shape::rangeOf(hull.points);
      hull.center = 0.5 * (low + high);
      break;
    }
    default:
      hull.points = {solid.offset * solid.normal};
  }
  return hull;
}

Hull hullOf(const Modeld& model) {
  Hull hull;
  std::vector<char> taken(static_cast<std::size_t>(model.num_vertices), 0);
  hull.points.reserve(taken.size());
  for (int i = 0; i < model.num_tris; ++i) {
    for (int k = 0; k < 3; ++k) {
      const std::size_t vertex = model.tri_indices[i][k];
      if (taken[vertex] == 0) hull.points.push_back(model.vertices[vertex]);
      taken[vertex] = 1;
    }
  }
  hull.center = model.getBV(0).bv.center0;
  return hull;
}

#if FCL_HAVE_OCTOMAP
/// The box of the occupied cells; no points if there are none. Cells have their places by two sums
/// in octomap and in FCL, which differ by rounding.
Hull hullOf(const fcl::OcTreed& octree, const continuous::OccupiedBox& cells) {
  Hull hull;
  if (cells.empty()) return hull;
  addBox(cells.low, cells.high, hull.points);
  hull.center = 0.5 * (cells.low + cells.high);
  hull.margin = 0x1p-40 * octree.getRootBV().max_.lpNorm<1>();
  return hull;
}
#endif

Hull measure(BodyData& body) {
  const fcl::CollisionGeometryd& geometry = *body.geometry;
  if (const Modeld* const model = asModel(&geometry)) {
    requireFinished(*model);
    body.kind = BodyKind::kMesh;
    body.model = model;
    body.state = stateOf(*model);
    return hullOf(*model);
  }
  if (isShape(geometry)) {
    body.kind = BodyKind::kShape;
    body.solid = toSolid(geometry);
    shape::makeRows(body.solid);
    body.shape_values = shapeValues(geometry);
    body.bounded = body.solid.bounded();
    return hullOf(body.solid);
  }
#if FCL_HAVE_OCTOMAP
  if (geometry.getObjectType() == fcl::OT_OCTREE) {
    const auto& octree = static_cast<const fcl::OcTreed&>(geometry);
    body.kind = BodyKind::kOctree;
    body.cells = continuous::occupiedBox(octree);
    return hullOf(octree, body.cells);
  }
#endif
  const bool mesh = geometry.getObjectType() == fcl::OT_BVH;
  refuse("a body of a linkage can't be a ", typeName(geometry),
         mesh ? "; convert it by kios::toKIOS(model)."
              : "; replace it by a mesh, built by kios::makeModel().");
}

/// Sets what bounds the content, whose hull in the geometry's frame is given.
void setContent(BodyData& body, Hull hull) {
  if (hull.points.empty()) hull.points.push_back(hull.center);
  double size = hull.margin;
  for (const Vector3d& p : hull.points) size = std::max(size, p.lpNorm<1>());
  if (!(size <= kLargest)) refuse("a body of a linkage is too large.");

  // Moved points round by less than 16 u of the lengths.
  hull.margin += 0x1p-48 * (size + body.X_LB.translation().norm());
  for (Vector3d& p : hull.points) p = body.X_LB * p;
  hull.center = body.X_LB * hull.center;
  body.content = articulated::boundOf(hull.points, hull.margin, hull.center);
  body.reach = body.content.reach();
  if (body.bounded) body.supports = articulated::SupportTable(hull.points, hull.margin);
  if (body.link >= 0) {
    return;
  }
  body.obstacle_length = (body.X_LB.translation().norm() + body.reach) * (1 + 0x1p-50);
  for (int i = 0; i < 3; ++i) {
    body.box.low[i] = kInfinity;
    body.box.high[i] = -kInfinity;
    for (const Vector3d& p : hull.points) {
      body.box.low[i] = std::min(body.box.low[i], p[i] - hull.margin);
      body.box.high[i] = std::max(body.box.high[i], p[i] + hull.margin);
    }
    if (body.bounded) continue;
    body.box.low[i] = -kInfinity;
    body.box.high[i] = kInfinity;
  }
}

bool turns(const std::vector<LinkData>& links, int link) {
  if (link < 0) return false;
  const auto& moving = links[link].moving;
  return std::any_of(moving.begin(), moving.end(),
                     [&](int i) { return links[i].type == JointType::kRevolute; });
}

}  // namespace

int Linkage::Impl::addLink(int parent, const Joint& joint) {
  const int link = static_cast<int>(links.size());
  if (parent < -1 || parent >= link) {
    refuse("a link's parent must be -1, the world, or a link that was added before, but is ",
           parent, ".");
  }
  LinkData data;
  data.parent = parent;
  data.type = joint.type;
  data.R_PJ = continuous::orthonormal(joint.X_PJ.linear(), "pose of a joint");
  data.t_PJ = joint.X_PJ.translation();
  requireTranslation(data.t_PJ, "pose of a joint");
  if (parent >= 0) {
    data.moving = links[parent].moving;
    data.level = links[parent].level;
    data.offsets = links[parent].offsets;
  }
  ++data.level;
  data.offsets = (data.offsets + data.t_PJ.norm()) * (1 + 0x1p-50);
  switch (joint.type) {
    case JointType::kFixed:
      break;
    case JointType::kRevolute:
    case JointType::kPrismatic: {
      const double unit = joint.axis.stableNorm();
      if (!(unit > 0 && unit <= kLargest)) {
        refuse("the axis of a joint that moves must be finite and of a length above 0.");
      }
      data.unit = unit;
      data.axis = (joint.axis / unit).normalized();
      constexpr int kMost = 1 << 20;
      if (joint.coordinate < -1 || joint.coordinate >= kMost) {
        refuse("a joint's coordinate must be -1, the next one, or below 2^20, but is ",
               joint.coordinate, ".");
      }
      constexpr double kLargestFactor = 0x1p100;
      if (!(std::abs(joint.multiplier) <= kLargestFactor &&
            std::abs(joint.offset) <= kLargestFactor)) {
        refuse("the multiplier or the offset of a joint is NaN, infinite or too large.");
      }
      data.coordinate = joint.coordinate < 0 ? coordinates : joint.coordinate;
      data.multiplier = joint.multiplier;
      data.offset = joint.offset;
      data.moving.push_back(link);
      break;
    }
    default:
      refuse("a joint's type must be fixed, revolute or prismatic.");
  }
  links.push_back(std::move(data));
  coordinates = std::max(coordinates, links.back().coordinate + 1);
  return link;
}

int Linkage::Impl::addBody(int link, std::shared_ptr<const fcl::CollisionGeometryd> geometry,
                           const fcl::Transform3d& X_LB) {
  if (link < -1 || link >= static_cast<int>(links.size())) {
    refuse("a body's link must be -1, an obstacle, or one that was added before, but is ", link,
           ".");
  }
  if (!geometry) refuse("the geometry of a body of a linkage is null.");
  BodyData body;
  body.geometry = std::move(geometry);
  body.link = link;
  body.X_LB.setIdentity();
  body.X_LB.linear() = continuous::orthonormal(X_LB.linear(), "pose of a body");
  body.X_LB.translation() = X_LB.translation();
  requireTranslation(X_LB.translation(), "pose of a body");
  const Hull hull = measure(body);
  body.occupied = body.geometry->isOccupied();
  body.meets = body.occupied && !hull.points.empty();
  if (!body.bounded && turns(links, link)) {
    refuse("a half-space or a plane can't turn: a revolute joint carries it.");
  }
  setContent(body, hull);
  if (link < 0) {
    farthest_obstacle = std::max(farthest_obstacle, body.obstacle_length);
  } else {
    body.carried = static_cast<int>(carried.size());
    body.first_motion = num_motions;
    num_motions += static_cast<int>(links[link].moving.size()) + 1;
  }
  bodies.push_back(std::move(body));
  const int id = static_cast<int>(bodies.size()) - 1;
  bodies.back().box.body = id;
  addPairs(id);
  return id;
}

int Linkage::Impl::shared(int link_a, int link_b) const {
  const auto &a = links[link_a].moving, &b = links[link_b].moving;
  const auto length = static_cast<std::ptrdiff_t>(std::min(a.size(), b.size()));
  return static_cast<int>(std::mismatch(a.begin(), a.begin() + length, b.begin()).first -
                          a.begin());
}

void Linkage::Impl::addPairs(int body) {
  const BodyData& data = bodies[body];
  const auto meet = [&](int other) { return data.meets && bodies[other].meets; };
  if (data.link < 0) {
    if (!data.meets) return;
    obstacles.push_back(data.box);
    lazy_tree_ = std::make_shared<LazyTree>();
    for (const CarriedBody& other : carried) num_pairs += meet(other.body) ? 1 : 0;
    return;
  }
  CarriedBody added;
  added.body = body;
  if (data.meets) num_pairs += static_cast<long long>(obstacles.size());
  for (const CarriedBody& other : carried) {
    const BodyData& with = bodies[other.body];
    const bool checked = meet(other.body) && with.link != data.link;
    added.shared.push_back(checked ? shared(with.link, data.link) : CarriedBody::kNever);
    num_pairs += checked ? 1 : 0;
  }
  carried.push_back(std::move(added));
}

void Linkage::Impl::allow(int a, int b) {
  const int count = static_cast<int>(bodies.size());
  if (a < 0 || b < 0 || a >= count || b >= count) {
    refuse("a pair of bodies is allowed of which one was not added: ", a, " and ", b, ".");
  }
  if (a == b) refuse("body ", a, " is allowed to touch itself, which is never checked.");
  if (bodies[a].carried < bodies[b].carried) std::swap(a, b);
  if (bodies[a].carried < 0) return;
  allowed_.emplace_back(a, b);
  CarriedBody& body = carried[bodies[a].carried];
  if (bodies[b].carried >= 0) {
    int& joints = body.shared[bodies[b].carried];
    if (joints != CarriedBody::kNever) --num_pairs;
    joints = CarriedBody::kNever;
    return;
  }
  const auto at = std::lower_bound(body.allowed.begin(), body.allowed.end(), b);
  if (at != body.allowed.end() && *at == b) return;
  body.allowed.insert(at, b);
  if (bodies[a].meets && bodies[b].meets) --num_pairs;
}

void Linkage::Impl::measureOctrees() {
  farthest_obstacle = 0;
  for (BodyData& body : bodies) {
    if (body.kind == BodyKind::kOctree) {
      const Hull hull = measure(body);
      body.meets = body.occupied && !hull.points.empty();
      setContent(body, hull);
    }
    farthest_obstacle = std::max(farthest_obstacle, body.obstacle_length);
  }
  const auto allowed = std::exchange(allowed_, {});
  carried.clear();
  obstacles.clear();
  lazy_tree_ = std::make_shared<LazyTree>();
  num_pairs = 0;
  for (std::size_t i = 0; i < bodies.size(); ++i) addPairs(static_cast<int>(i));
  for (const auto& [a, b] : allowed) allow(a, b);
}

}  // namespace kios
