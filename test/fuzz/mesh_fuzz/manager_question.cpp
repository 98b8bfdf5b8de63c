// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// ManagerQuery over frames with one of FCL's managers, against fcl::distance of every pair. FCL's
// boxes decide which pairs come up: within their rounding a pair may be missed.

#include <map>
#include <set>

#include <fcl/broadphase/broadphase_dynamic_AABB_tree.h>
#include <fcl/narrowphase/distance_request.h>
#include <fcl/narrowphase/distance_result.h>
#include "fcl_kios/overloads.h"
#include "fcl_kios/scene.h"
#include "fuzz/mesh_fuzz/pair.h"
#include "fuzz/mesh_fuzz/questions.h"

namespace kios::fuzz {
namespace {

using Object = fcl::CollisionObjectd;

double distanceOf(const Object* a, const Object* b) {
  fcl::DistanceResultd result;
  return fcl::distance(a, b, fcl::DistanceRequestd(), result);
}

class ManagerQuestion {
 public:
  explicit ManagerQuestion(const Case& c) : random_(c.draw), case_(c), reach_(reachOf(c.meshes)) {
    for (std::size_t m = 0; m < c.meshes.size(); ++m) {
      const auto model = modelOf<double>(c.meshes[m], c.foreign);
      model->computeLocalAABB();
      objects_.push_back(std::make_unique<Object>(model, c.pose(m)));
      manager_.registerObject(objects_.back().get());
      for (const auto& frame : c.frames) {
        reach_ = std::max(reach_, frame[m].translation().norm());
        skew_ = std::max(skew_, skewOf(frame[m]));
        // What FCL's CollisionObject::computeAABB() takes for no rotation.
        const Eigen::Matrix3d R = frame[m].linear();
        if (R.isIdentity()) {
          ignored_ = std::max(ignored_, (R - Eigen::Matrix3d::Identity()).norm());
        }
      }
    }
    manager_.setup();
  }

  Verdict run() {
    for (std::size_t f = 0; f < case_.frames.size(); ++f) {
      for (std::size_t m = 0; m < objects_.size(); ++m) {
        objects_[m]->setTransform(case_.pose(m, f));
        objects_[m]->computeAABB();
      }
      manager_.update();
      if (auto wrong = askFrame(f)) return wrong;
    }
    return std::nullopt;
  }

 private:
  Verdict askFrame(std::size_t f) {
    const std::string call = "ManagerQuery in frame " + std::to_string(f);
    // FCL's boxes, and the orders of a pair, differ by rounding; of a rotation that is none, by it.
    const double slack = ((0x1p-45 + 8 * skew_) * 4 + 2 * ignored_) * reach_;
    double least = std::numeric_limits<double>::infinity();
    std::vector<double> all;
    for (std::size_t a = 0; a < objects_.size(); ++a) {
      for (std::size_t b = a + 1; b < objects_.size(); ++b) {
        all.push_back(distanceOf(objects_[a].get(), objects_[b].get()));
        least = std::min(least, all.back());
      }
    }
    query_.findClosest();
    manager_.distance(&query_, ManagerQuery<double>::callback);
    if (query_.pairs().size() != 1) {
      return failure(Words() << query_.pairs().size() << " closest pairs", call);
    }
    if (auto wrong = judge(query_.pairs()[0], call)) return wrong;
    if (!(query_.pairs()[0].distance <= least + slack)) {
      return failure(
          Words() << "closest at " << query_.pairs()[0].distance << ", brute force " << least,
          call);
    }
    const double margin =
        chance(random_, 0.5)
            ? all[static_cast<std::size_t>(below(random_, static_cast<int>(all.size())))]
            : random_.uniform(0, 2) * reach_;
    query_.findWithin(margin);
    manager_.distance(&query_, ManagerQuery<double>::callback);
    std::set<std::pair<const Object*, const Object*>> seen;
    for (const auto& pair : query_.pairs()) {
      if (auto wrong = judge(pair, call)) return wrong;
      if (!(pair.distance <= margin) || !seen.insert(std::minmax(pair.a, pair.b)).second) {
        return failure(
            Words() << "a pair at " << pair.distance << " within " << margin << ", or twice", call);
      }
    }
    std::size_t sure = 0, possible = 0;
    for (const double d : all) {
      sure += d < margin - slack ? 1 : 0;
      possible += d <= margin + slack ? 1 : 0;
    }
    if (seen.size() >= sure && seen.size() <= possible) return std::nullopt;
    return failure(Words() << seen.size() << " pairs within " << margin << "; brute force " << sure
                           << " to " << possible,
                   call);
  }

  static Verdict judge(const ManagerQuery<double>::Pair& pair, const std::string& call) {
    const double d = distanceOf(pair.a, pair.b);
    if (pair.distance == d) return std::nullopt;
    return failure(Words() << "a pair at " << pair.distance << ", fcl::distance " << d, call);
  }

  Random random_;
  const Case& case_;
  std::vector<std::unique_ptr<Object>> objects_;
  fcl::DynamicAABBTreeCollisionManagerd manager_;
  ManagerQuery<double> query_;
  double reach_, skew_ = 0, ignored_ = 0;
};

}  // namespace

Verdict askManager(const Case& c) { return ManagerQuestion(c).run(); }

}  // namespace kios::fuzz
