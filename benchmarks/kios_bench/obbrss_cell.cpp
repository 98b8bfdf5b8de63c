// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "obbrss_cell.h"

#include "calls.h"
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
  const auto add = [&](const robot::Geometry& geometry, const std::string& name, int node,
                       const fcl::Transform3d& X) {
    parts_.push_back({name, node, X});
    bodies_.add(converted(geometry, models), X, node >= 0);
  };
  for (const auto& body : arm.bodies) {
    add(body.geometry, arm.links[static_cast<std::size_t>(body.entity)], body.node, body.X_LB);
  }
  for (const robot::Object* object : robot.impl().ordered()) {
    const int node = object->link < 0 ? -1 : arm.tree.nodeOf(object->link);
    for (const auto& element : object->elements) {
      add(element.geometry, object->name, node, object->X * element.X);
    }
  }
  bodies_.setup();
}

bool ObbrssCell::isFree(const Eigen::VectorXd& q) {
  robot_.impl().arm->tree.place(q, placed_);
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    const Part& part = parts_[i];
    if (part.node < 0) continue;
    bodies_.place(i, placed_[static_cast<std::size_t>(part.node)].pose(part.X));
  }
  bodies_.update();
  return !bodies_.collide([this](int a, int b) {
    const Part &first = parts_[static_cast<std::size_t>(a)],
               &second = parts_[static_cast<std::size_t>(b)];
    if (first.node == second.node || robot_.impl().ignores(first.name, second.name)) return false;
    fcl::CollisionResultd result;
    FclCalls::collide(bodies_.object(a), bodies_.object(b), fcl::CollisionRequestd(), result);
    return result.isCollision();
  });
}

}  // namespace kios::bench
