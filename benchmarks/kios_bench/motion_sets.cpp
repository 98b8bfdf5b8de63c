// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "motion_set.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <fcl/math/bv/OBBRSS.h>
#include <fcl_kios/fcl_kios.h>

#include "calls.h"
#include "managed_bodies.h"
#include "sampled_edge.h"

namespace kios::bench {
namespace {

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
  explicit Certified(const scenes::Cell& cell) : linkage_(linkageOf(cell)) {}

  bool isFree(const scenes::Joints& q0, const scenes::Joints& q1) override {
    const auto answer = checkMotion(linkage_, vectorOf(q0), vectorOf(q1));
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

/// Samples of a path, each by FCL's dynamic AABB trees.
template <typename BV, typename Calls>
class Managed final : public MotionSet {
 public:
  explicit Managed(const scenes::Cell& cell) : cell_(cell) {
    const auto models = modelsOf<BV>(cell);
    for (int body = 0; body < cell.bodies(); ++body) {
      const bool moves = body < cell.moving();
      bodies_.add(models[body],
                  moves ? fcl::Transform3d::Identity() : cell.places[body - cell.moving()], moves);
    }
    bodies_.setup();
  }

  bool isFree(const scenes::Joints& q0, const scenes::Joints& q1) override {
    const auto is_free = [this](const Eigen::VectorXd& q) {
      return isFreeAt({q.data(), q.data() + q.size()});
    };
    return sampleInContact(is_free, vectorOf(q0), vectorOf(q1)).size() == 0;
  }
  long long takeQueried() override { return std::exchange(queried_, 0); }

  bool isFreeAt(const scenes::Joints& q) {
    place(q);
    return !bodies_.collide([this](int a, int b) {
      if (!cell_.admissible(a, b)) return false;
      ++queried_;
      fcl::CollisionResultd result;
      Calls::collide(bodies_.object(a), bodies_.object(b), fcl::CollisionRequestd(), result);
      return result.isCollision();
    });
  }
  double distanceAt(const scenes::Joints& q) {
    place(q);
    double least = std::numeric_limits<double>::infinity();
    bodies_.distance([&](int a, int b, double& reach) {
      if (cell_.admissible(a, b)) {
        fcl::DistanceResultd result;
        Calls::distance(bodies_.object(a), bodies_.object(b), fcl::DistanceRequestd(), result);
        least = std::min(least, result.min_distance);
      }
      reach = least;
      return !(least > 0);
    });
    return std::max(least, 0.0);
  }

 private:
  void place(const scenes::Joints& q) {
    scenes::placeLinks(cell_, q, poses_);
    for (std::size_t i = 0; i < poses_.size(); ++i) bodies_.place(i, poses_[i]);
    bodies_.update();
  }

  const scenes::Cell& cell_;
  ManagedBodies bodies_;
  std::vector<fcl::Transform3d> poses_;
  long long queried_ = 0;
};

/// Bounds how far points of the robots move on a path: each joint's angle times what lies beyond
/// it, the links that come after its own.
double sweptBound(const scenes::Cell& cell, const scenes::Joints& q0, const scenes::Joints& q1) {
  const std::vector<scenes::Link>& links = cell.robot.links;
  std::vector<double> beyond(links.size(), 0);
  double offsets = 0, radius = 0;
  for (std::size_t i = links.size(); i-- > 0;) {
    for (const auto& v : links[i].mesh.vertices) {
      radius = std::max(radius, (links[i].X_LM * v).norm());
    }
    beyond[i] = offsets + radius;
    offsets += links[i].X_PL.translation().norm();
  }
  double bound = 0;
  const std::size_t joints = links.size() - 1;  // the first link stands still
  for (std::size_t i = 0; i < q0.size(); ++i) {
    bound += std::abs(q1[i] - q0[i]) * beyond[1 + i % joints];
  }
  return bound;
}

}  // namespace

Eigen::VectorXd vectorOf(const scenes::Joints& q) {
  return Eigen::Map<const Eigen::VectorXd>(q.data(), static_cast<Eigen::Index>(q.size()));
}

std::function<double(const scenes::Joints&, const scenes::Joints&)> makeSampledClearance(
    const scenes::Cell& cell, double step) {
  const auto set = std::make_shared<Managed<fcl::OBBRSSd, FclCalls>>(cell);
  return [&cell, set, step](const scenes::Joints& q0, const scenes::Joints& q1) {
    const int samples = std::max(1, static_cast<int>(std::ceil(sweptBound(cell, q0, q1) / step)));
    double least = std::numeric_limits<double>::infinity();
    for (int i = 0; i <= samples; ++i) {
      least = std::min(least, set->distanceAt(scenes::between(q0, q1, 1.0 * i / samples)));
    }
    return least;
  };
}

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
  const auto set = std::make_shared<Managed<kIOSd, KiosCalls>>(cell);
  return [set](const scenes::Joints& q) { return set->isFreeAt(q); };
}

std::unique_ptr<MotionSet> makeCertified(const scenes::Cell& cell) {
  return std::make_unique<Certified>(cell);
}

std::unique_ptr<MotionSet> makeMotionSet(const std::string& name, const scenes::Cell& cell) {
  if (name == "sampled_kios") return std::make_unique<Managed<kIOSd, KiosCalls>>(cell);
  return std::make_unique<Managed<fcl::OBBRSSd, FclCalls>>(cell);
}

}  // namespace kios::bench
