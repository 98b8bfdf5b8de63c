// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "motion_set.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <deque>
#include <vector>

#include <fcl/broadphase/broadphase_dynamic_AABB_tree.h>
#include <fcl/math/bv/OBBRSS.h>
#include <fcl_kios/model/model.h>

#include "calls.h"

namespace kios::bench {
namespace {

using Object = fcl::CollisionObjectd;

Eigen::VectorXd vectorOf(const scenes::Joints& q) {
  return Eigen::Map<const Eigen::VectorXd>(q.data(), static_cast<Eigen::Index>(q.size()));
}

template <typename BV>
std::vector<std::shared_ptr<fcl::BVHModel<BV>>> modelsOf(const scenes::Cell& cell) {
  std::vector<std::shared_ptr<fcl::BVHModel<BV>>> models;
  for (int body = 0; body < cell.bodies(); ++body) {
    const bool again = body >= cell.links() && body < cell.moving();
    models.push_back(again ? models[body % cell.links()] : scenes::buildModel<BV>(cell.mesh(body)));
  }
  return models;
}

class Certified final : public MotionSet {
 public:
  Certified(const std::string& name, const scenes::Cell& cell)
      : MotionSet(name), linkage_(linkageOf(cell)) {}

  bool isFree(const scenes::Joints& q0, const scenes::Joints& q1) override {
    const MotionAnswer answer = checkMotion(linkage_, vectorOf(q0), vectorOf(q1));
    queried_ += answer.counts.narrow_queries;
    if (answer.verdict == MotionVerdict::kUnresolved) ++unresolved_;
    return answer.verdict == MotionVerdict::kClear;
  }
  long long takeQueried() override { return std::exchange(queried_, 0); }
  long long takeUnresolved() override { return std::exchange(unresolved_, 0); }

 private:
  const Linkage linkage_;
  long long queried_ = 0, unresolved_ = 0;
};

/// Samples of a path, each by FCL's dynamic AABB trees, one of the links and one of what stands
/// still.
template <typename BV, typename Calls>
class Managed final : public MotionSet {
 public:
  Managed(const std::string& name, const scenes::Cell& cell)
      : MotionSet(name), cell_(cell), models_(modelsOf<BV>(cell)) {
    for (int body = 0; body < cell.bodies(); ++body) {
      const bool moves = body < cell.moving();
      const auto X = moves ? fcl::Transform3d::Identity() : cell.places[body - cell.moving()];
      objects_.push_back(std::make_unique<Object>(models_[body], X));
      objects_.back()->setUserData(reinterpret_cast<void*>(static_cast<std::intptr_t>(body)));
      (moves ? moving_ : still_).registerObject(objects_.back().get());
    }
    moving_.setup();
    still_.setup();
  }

  bool isFree(const scenes::Joints& q0, const scenes::Joints& q1) override {
    constexpr double kStep = 0.01;
    double most = 0;
    for (std::size_t i = 0; i < q0.size(); ++i) most = std::max(most, std::abs(q1[i] - q0[i]));
    const int count = std::max(1, static_cast<int>(std::ceil(most / kStep - 1e-9)));
    if (!isFreeAt(q1)) return false;
    halves_.assign(1, {1, count - 1});
    while (!halves_.empty()) {
      const auto [first, last] = halves_.front();
      halves_.pop_front();
      if (first > last) continue;
      const int middle = (first + last) / 2;
      if (!isFreeAt(scenes::between(q0, q1, 1.0 * middle / count))) return false;
      halves_.emplace_back(first, middle - 1);
      halves_.emplace_back(middle + 1, last);
    }
    return true;
  }
  long long takeQueried() override { return std::exchange(queried_, 0); }

  bool isFreeAt(const scenes::Joints& q) {
    scenes::placeLinks(cell_, q, poses_);
    for (std::size_t i = 0; i < poses_.size(); ++i) {
      objects_[i]->setTransform(poses_[i]);
      objects_[i]->computeAABB();
    }
    moving_.update();
    contact_ = false;
    if (!still_.empty()) moving_.collide(&still_, this, &Managed::callback);
    if (!contact_) moving_.collide(this, &Managed::callback);
    return !contact_;
  }

 private:
  static int idOf(const Object* object) {
    return static_cast<int>(reinterpret_cast<std::intptr_t>(object->getUserData()));
  }
  static bool callback(Object* o1, Object* o2, void* data) {
    Managed& self = *static_cast<Managed*>(data);
    if (self.contact_) return true;
    if (!self.cell_.admissible(idOf(o1), idOf(o2))) return false;
    ++self.queried_;
    fcl::CollisionResultd result;
    Calls::collide(o1, o2, fcl::CollisionRequestd(), result);
    self.contact_ = result.isCollision();
    return self.contact_;
  }

  const scenes::Cell& cell_;
  std::vector<std::shared_ptr<fcl::BVHModel<BV>>> models_;
  std::vector<std::unique_ptr<Object>> objects_;
  std::vector<fcl::Transform3d> poses_;
  std::deque<std::pair<int, int>> halves_;
  long long queried_ = 0;
  fcl::DynamicAABBTreeCollisionManagerd moving_, still_;
  bool contact_ = false;
};

}  // namespace

Linkage linkageOf(const scenes::Cell& cell) {
  Linkage linkage;
  const auto models = modelsOf<kIOSd>(cell);
  for (std::size_t r = 0; r < cell.bases.size(); ++r) {
    const int first = static_cast<int>(r) * cell.links();
    for (int i = 0; i < cell.links(); ++i) {
      const scenes::Link& link = cell.robot.links[i];
      Joint joint;
      joint.type = i == 0 ? JointType::kFixed : JointType::kRevolute;
      joint.X_PJ = i == 0 ? cell.bases[r] * link.X_PL : link.X_PL;
      linkage.addLink(i == 0 ? -1 : first + cell.robot.parents[i], joint);
      linkage.addBody(first + i, models[i], link.X_LM);
    }
  }
  for (std::size_t i = 0; i < cell.obstacles.size(); ++i) {
    linkage.addBody(-1, models[cell.moving() + i], cell.places[i]);
  }
  for (const auto& [a, b] : cell.allowed) linkage.allow(a, b);
  return linkage;
}

std::function<bool(const scenes::Joints&)> makeStaticCheck(const scenes::Cell& cell) {
  const auto set = std::make_shared<Managed<kIOSd, KiosCalls>>("", cell);
  return [set](const scenes::Joints& q) { return set->isFreeAt(q); };
}

std::unique_ptr<MotionSet> makeCertified(const std::string& name, const scenes::Cell& cell) {
  return std::make_unique<Certified>(name, cell);
}

std::unique_ptr<MotionSet> makeMotionSet(const std::string& name, const scenes::Cell& cell) {
  if (name == "sampled_kios") return std::make_unique<Managed<kIOSd, KiosCalls>>(name, cell);
  return std::make_unique<Managed<fcl::OBBRSSd, FclCalls>>(name, cell);
}

}  // namespace kios::bench
