// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "obbrss_cell.h"

#include "fcl_kios/fcl_kios.h"

namespace kios::bench {
namespace {

std::shared_ptr<fcl::CollisionGeometryd> converted(const robot::Geometry& geometry,
                                                   ObbrssModels& models) {
  auto& known = models[geometry.get()];
  if (known) return known;
  if (geometry->getObjectType() != fcl::OT_BVH) {
    known = std::const_pointer_cast<fcl::CollisionGeometryd>(geometry);
    return known;
  }
  const auto& model = static_cast<const Modeld&>(*geometry);
  auto obbrss = std::make_shared<fcl::BVHModel<fcl::OBBRSSd>>();
  obbrss->beginModel(model.num_tris, model.num_vertices);
  obbrss->addSubModel(
      std::vector<fcl::Vector3d>(model.vertices, model.vertices + model.num_vertices),
      std::vector<fcl::Triangle>(model.tri_indices, model.tri_indices + model.num_tris));
  obbrss->endModel();
  known = obbrss;
  return known;
}

}  // namespace

ObbrssCell::ObbrssCell(const Robot& robot, ObbrssModels& models) : robot_(robot) {
  const auto& arm = *robot.impl().arm;
  for (const auto& body : arm.bodies) {
    add(moving_, body.geometry, arm.links[static_cast<std::size_t>(body.entity)], body.node,
        body.X_LB, models);
  }
  for (const auto& object : robot.impl().objects) {
    const int node = object.link < 0 ? -1 : arm.tree.nodeOf(object.link);
    for (const auto& element : object.elements) {
      add(node < 0 ? still_ : moving_, element.geometry, object.name, node, object.X * element.X,
          models);
    }
  }
  moving_.setup();
  still_.setup();
}

void ObbrssCell::add(fcl::DynamicAABBTreeCollisionManagerd& manager,
                     const robot::Geometry& geometry, const std::string& name, int node,
                     const fcl::Transform3d& X, ObbrssModels& models) {
  parts_.push_back(std::unique_ptr<Part>(
      new Part{name, node, X, fcl::CollisionObjectd(converted(geometry, models), X)}));
  parts_.back()->object.setUserData(parts_.back().get());
  manager.registerObject(&parts_.back()->object);
}

bool ObbrssCell::isFree(const Eigen::VectorXd& q) {
  robot_.impl().arm->tree.place(q, placed_);
  for (auto& part : parts_) {
    if (part->node < 0) continue;
    part->object.setTransform(placed_[static_cast<std::size_t>(part->node)].pose(part->X));
    part->object.computeAABB();
  }
  moving_.update();
  contact_ = false;
  moving_.collide(this, &ObbrssCell::callback);
  if (!contact_) moving_.collide(&still_, this, &ObbrssCell::callback);
  return !contact_;
}

bool ObbrssCell::callback(fcl::CollisionObjectd* a, fcl::CollisionObjectd* b, void* cell) {
  auto& self = *static_cast<ObbrssCell*>(cell);
  const Part &first = *static_cast<const Part*>(a->getUserData()),
             &second = *static_cast<const Part*>(b->getUserData());
  if (first.node == second.node ||
      self.robot_.impl().allowed.count(robot::namePair(first.name, second.name)) != 0) {
    return false;
  }
  fcl::CollisionResultd result;
  fcl_own::collide(a->collisionGeometry().get(), a->getTransform(), b->collisionGeometry().get(),
                   b->getTransform(), fcl::CollisionRequestd(), result);
  self.contact_ = self.contact_ || result.isCollision();
  return self.contact_;
}

}  // namespace kios::bench
