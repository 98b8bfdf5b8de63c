// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "model/in_double.h"

#include <utility>
#include <vector>

#include <fcl/config.h>
#include "fcl_kios/model.h"
#include "shape/visit_shape.h"

#if FCL_HAVE_OCTOMAP
#include <fcl/geometry/octree/octree.h>

namespace kios {
namespace {

std::shared_ptr<const octomap::OcTree> cellsOf(const fcl::OcTreef& octree);

/// FCL hands out an octree's cells but not the tree that owns them. An explicit instantiation may
/// name a private member.
template <auto kTree>
struct CellsOf {
  friend std::shared_ptr<const octomap::OcTree> cellsOf(const fcl::OcTreef& octree) {
    return octree.*kTree;
  }
};
template struct CellsOf<&fcl::OcTreef::tree>;

}  // namespace
}  // namespace kios
#endif

namespace kios {
namespace {

using Geometry = std::shared_ptr<fcl::CollisionGeometryd>;

/// A geometry without a query, for which FCL says so.
class Unknown final : public fcl::CollisionGeometryd {
 public:
  Unknown(fcl::OBJECT_TYPE object, fcl::NODE_TYPE node) : object_(object), node_(node) {}
  fcl::OBJECT_TYPE getObjectType() const override { return object_; }
  fcl::NODE_TYPE getNodeType() const override { return node_; }
  void computeLocalAABB() override {}

 private:
  const fcl::OBJECT_TYPE object_;
  const fcl::NODE_TYPE node_;
};

Geometry convexInDouble(const fcl::Convexf& convex) {
  std::vector<fcl::Vector3d> vertices;
  vertices.reserve(convex.getVertices().size());
  for (const fcl::Vector3f& p : convex.getVertices()) vertices.emplace_back(p.cast<double>());
  return std::make_shared<fcl::Convexd>(
      std::make_shared<const std::vector<fcl::Vector3d>>(std::move(vertices)),
      convex.getFaceCount(), std::make_shared<const std::vector<int>>(convex.getFaces()));
}

template <typename BV>
Geometry meshInDouble(const fcl::CollisionGeometryf& geometry) {
  const auto& mesh = static_cast<const fcl::BVHModel<BV>&>(geometry);
  const bool cloud = mesh.getModelType() == fcl::BVH_MODEL_POINTCLOUD;
  detail::requireConvertible(mesh.build_state, cloud ? mesh.num_vertices : mesh.num_tris,
                             mesh.getNumBVs());
  std::vector<fcl::Vector3d> vertices;
  vertices.reserve(static_cast<std::size_t>(mesh.num_vertices));
  for (int i = 0; i < mesh.num_vertices; ++i)
    vertices.emplace_back(mesh.vertices[i].template cast<double>());
  if (cloud) return makePointCloud(vertices);
  return makeModel(vertices, {mesh.tri_indices, mesh.tri_indices + mesh.num_tris});
}

#if FCL_HAVE_OCTOMAP
Geometry octreeInDouble(const fcl::OcTreef& octree) {
  auto in_double = std::make_shared<fcl::OcTreed>(cellsOf(octree));
  const fcl::OcTreef fresh(cellsOf(octree));
  // Set only where the caller set them: log odds and probabilities are rounded into each other.
  if (octree.getOccupancyThres() != fresh.getOccupancyThres()) {
    in_double->setOccupancyThres(octree.getOccupancyThres());
  }
  if (octree.getFreeThres() != fresh.getFreeThres()) in_double->setFreeThres(octree.getFreeThres());
  in_double->setCellDefaultOccupancy(octree.getDefaultOccupancy());
  return in_double;
}
#endif

Geometry converted(const fcl::CollisionGeometryf& geometry) {
  Geometry made;
  const bool is_shape = visitShape(
      geometry,
      [&](const fcl::Boxf& s) { made = std::make_shared<fcl::Boxd>(s.side.cast<double>()); },
      [&](const fcl::Spheref& s) { made = std::make_shared<fcl::Sphered>(s.radius); },
      [&](const fcl::Ellipsoidf& s) {
        made = std::make_shared<fcl::Ellipsoidd>(s.radii.cast<double>());
      },
      [&](const fcl::Capsulef& s) { made = std::make_shared<fcl::Capsuled>(s.radius, s.lz); },
      [&](const fcl::Conef& s) { made = std::make_shared<fcl::Coned>(s.radius, s.lz); },
      [&](const fcl::Cylinderf& s) { made = std::make_shared<fcl::Cylinderd>(s.radius, s.lz); },
      [&](const fcl::Planef& s) { made = std::make_shared<fcl::Planed>(s.n.cast<double>(), s.d); },
      [&](const fcl::Halfspacef& s) {
        made = std::make_shared<fcl::Halfspaced>(s.n.cast<double>(), s.d);
      },
      [&](const fcl::TrianglePf& t) {
        made = std::make_shared<fcl::TrianglePd>(t.a.cast<double>(), t.b.cast<double>(),
                                                 t.c.cast<double>());
      },
      [&](const fcl::Convexf& convex) { made = convexInDouble(convex); });
  if (is_shape) return made;
  switch (geometry.getNodeType()) {
    case fcl::BV_AABB:
      return meshInDouble<fcl::AABBf>(geometry);
    case fcl::BV_OBB:
      return meshInDouble<fcl::OBBf>(geometry);
    case fcl::BV_RSS:
      return meshInDouble<fcl::RSSf>(geometry);
    case fcl::BV_kIOS:
      return meshInDouble<fcl::kIOSf>(geometry);
    case fcl::BV_OBBRSS:
      return meshInDouble<fcl::OBBRSSf>(geometry);
    case fcl::BV_KDOP16:
      return meshInDouble<fcl::KDOPf<16>>(geometry);
    case fcl::BV_KDOP18:
      return meshInDouble<fcl::KDOPf<18>>(geometry);
    case fcl::BV_KDOP24:
      return meshInDouble<fcl::KDOPf<24>>(geometry);
#if FCL_HAVE_OCTOMAP
    case fcl::GEOM_OCTREE:
      return octreeInDouble(static_cast<const fcl::OcTreef&>(geometry));
#endif
    default:
      return std::make_shared<Unknown>(geometry.getObjectType(), geometry.getNodeType());
  }
}

}  // namespace

std::shared_ptr<const fcl::CollisionGeometryd> inDouble(const fcl::CollisionGeometryf& geometry) {
  const Geometry in_double = converted(geometry);
  in_double->cost_density = geometry.cost_density;
  in_double->threshold_occupied = geometry.threshold_occupied;
  in_double->threshold_free = geometry.threshold_free;
  return in_double;
}

std::shared_ptr<const fcl::CollisionGeometryd> inDouble(const fcl::CollisionGeometryd& geometry) {
  return {std::shared_ptr<void>(), &geometry};
}

}  // namespace kios
