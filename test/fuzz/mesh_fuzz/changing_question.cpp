// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Two meshes and a third geometry (a mesh, one of FCL's shapes, an octree) that move and change in
// place over frames, and nobody is told: the memories of SceneDistance and ManagerQuery against
// fcl::distance of every pair, bit by bit. Meshes may be marked as solids at any time.

#include <functional>
#include <map>
#include <stdexcept>
#include <utility>
#include <vector>

#include <fcl/geometry/octree/octree.h>
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/narrowphase/collision_object.h>
#include <fcl/narrowphase/distance_request.h>
#include <fcl/narrowphase/distance_result.h>
#include <octomap/octomap.h>
#include "fcl_kios/overloads.h"
#include "fcl_kios/scene.h"
#include "fcl_kios/solids.h"
#include "fuzz/mesh_fuzz/pair.h"
#include "fuzz/mesh_fuzz/questions.h"

namespace kios::fuzz {
namespace {

using Object = fcl::CollisionObjectd;

class ChangingQuestion {
 public:
  explicit ChangingQuestion(const Case& c) : random_(c.draw), case_(c), size_(reachOf(c.meshes)) {
    if (size_ == 0) size_ = 1;
    for (std::size_t m = 0; m < c.meshes.size(); ++m) {
      if (m == 2 && addOther()) continue;
      addMesh(m);
    }
    for (std::size_t m = 0; m < objects_.size(); ++m) {
      scene_.add(objects_[m]->collisionGeometry(), c.pose(m));
    }
    call_ = "draw " + std::to_string(c.draw);
  }

  Verdict run() {
    for (int f = 0; f < 8; ++f) {
      call_ += "; frame " + std::to_string(f) + ":";
      for (std::size_t m = 0; f > 0 && m < objects_.size(); ++m) {
        if (chance(random_, 0.3)) move(m);
        if (chance(random_, 0.4)) changes_[m]();
      }
      computeTruth();
      if (auto wrong = chance(random_, 0.6) ? askScene() : std::nullopt) return wrong;
      if (auto wrong = chance(random_, 0.6) ? askManager() : std::nullopt) return wrong;
    }
    return std::nullopt;
  }

 private:
  using Ids = std::pair<int, int>;

  void add(const std::shared_ptr<fcl::CollisionGeometryd>& geometry, std::function<void()> change) {
    objects_.push_back(std::make_unique<Object>(geometry, case_.pose(objects_.size())));
    changes_.push_back(std::move(change));
  }

  void addMesh(std::size_t m) {
    const auto model = modelOf<double>(case_.meshes[m], case_.foreign || chance(random_, 0.2));
    add(model, [this, model, mesh = case_.meshes[m], marked = false]() mutable {
      if (chance(random_, 0.2)) {
        marked = mark(*model);
        return;
      }
      deform(mesh);
      model->beginUpdateModel();
      model->updateSubModel(mesh.vertices);
      model->endUpdateModel(chance(random_, 0.7), chance(random_, 0.5));
      call_ += " mesh updated,";
      if (marked) marked = mark(*model);  // it may be none any more
    });
  }

  /// Closed meshes mostly stay closed.
  void deform(Mesh& mesh) {
    if (chance(random_, 0.3)) {
      const double noise = size_ * power(random_, -16, 0);
      for (Vector3d& p : mesh.vertices) p += noise * scenes::point(random_);
      return;
    }
    Eigen::Matrix3d stretch = Eigen::Matrix3d::Identity();
    for (int i = 0; i < 3; ++i)
      stretch.col(i) += power(random_, -16, -0.5) * scenes::point(random_);
    const Vector3d offset = size_ * power(random_, -16, 0) * scenes::point(random_);
    for (Vector3d& p : mesh.vertices) p = stretch * p + offset;
  }

  /// Marks the model as a solid, unless it is none.
  bool mark(Modeld& model) {
    const bool marked = markIfSolid(model);
    if (marked) call_ += " marked,";
    return marked;
  }

  /// Adds a shape or an octree; returns false for a mesh.
  bool addOther() {
    switch (below(random_, 5)) {
      case 0: {
        const auto box = std::make_shared<fcl::Boxd>(size_, 0.5 * size_, 0.2 * size_);
        add(box, [this, box] { box->side[below(random_, 3)] = length("side"); });
        return true;
      }
      case 1: {
        const auto ball = std::make_shared<fcl::Sphered>(0.5 * size_);
        add(ball, [this, ball] { ball->radius = length("radius"); });
        return true;
      }
      case 2: {
        const auto capsule = std::make_shared<fcl::Capsuled>(0.2 * size_, size_);
        add(capsule, [this, capsule] {
          (chance(random_, 0.5) ? capsule->radius : capsule->lz) = length("capsule");
        });
        return true;
      }
      case 3: {
        const auto cells = std::make_shared<octomap::OcTree>(0.3 * size_);
        const auto measure = [this, cells] {
          const Vector3d p = size_ * power(random_, -1, 0.7) * scenes::point(random_);
          cells->updateNode(p.x(), p.y(), p.z(), chance(random_, 0.7));
          call_ += " a cell measured,";
        };
        measure();
        add(std::make_shared<fcl::OcTreed>(std::shared_ptr<const octomap::OcTree>(cells)), measure);
        return true;
      }
      default:
        return false;
    }
  }

  double length(const char* what) {
    call_ += std::string(" ") + what + " changed,";
    return size_ * power(random_, -2, 0.3);
  }

  void move(std::size_t m) {
    const auto frame =
        static_cast<std::size_t>(below(random_, static_cast<int>(case_.frames.size())));
    objects_[m]->setTransform(case_.pose(m, frame));
    scene_.move(static_cast<int>(m), case_.pose(m, frame));
    call_ += " " + std::to_string(m) + " moved,";
  }

  void computeTruth() {
    for (std::size_t a = 0; a < objects_.size(); ++a) {
      for (std::size_t b = a + 1; b < objects_.size(); ++b) {
        fcl::DistanceResultd result;
        truth_[{static_cast<int>(a), static_cast<int>(b)}] =
            fcl::distance(objects_[a].get(), objects_[b].get(), fcl::DistanceRequestd(), result);
      }
    }
  }

  /// Returns a length at which something happens.
  double threshold() {
    auto it = truth_.begin();
    std::advance(it, below(random_, static_cast<int>(truth_.size())));
    return chance(random_, 0.5) ? ulps(it->second, scenes::integer(random_, -30, 30))
                                : it->second * random_.uniform(0.1, 3);
  }

  Verdict askScene() {
    if (chance(random_, 0.4)) {
      call_ += " closestPair()";
      const auto pair = scene_.closestPair();
      double least = std::numeric_limits<double>::infinity();
      for (const auto& [ids, d] : truth_) least = std::min(least, d);
      if (pair && pair->distance == least) return std::nullopt;
      return failure(Words() << (pair ? pair->distance : -1) << ", fcl::distance " << least, call_);
    }
    const double margin = threshold();
    call_ += " pairsWithin(" + literal(margin) + ")";
    std::map<Ids, double> found;
    for (const auto& pair : scene_.pairsWithin(margin)) found[{pair.a, pair.b}] = pair.distance;
    return compare(found, margin);
  }

  /// The callback of every pair, as a manager without AABBs calls it.
  Verdict askManager() {
    const double margin = threshold();
    call_ += " ManagerQuery(" + literal(margin) + ")";
    query_.findWithin(margin);
    std::map<const Object*, int> names;
    for (std::size_t a = 0; a < objects_.size(); ++a) {
      names[objects_[a].get()] = static_cast<int>(a);
      for (std::size_t b = a + 1; b < objects_.size(); ++b) {
        double dist = margin;
        ManagerQueryd::callback(objects_[a].get(), objects_[b].get(), &query_, dist);
      }
    }
    std::map<Ids, double> found;
    for (const auto& pair : query_.pairs()) {
      found[{names.at(pair.a), names.at(pair.b)}] = pair.distance;
    }
    return compare(found, margin);
  }

  Verdict compare(const std::map<Ids, double>& found, double margin) const {
    for (const auto& [ids, d] : truth_) {
      const auto it = found.find(ids);
      if (it == found.end() ? d <= margin : it->second != d || !(d <= margin)) {
        return failure(Words() << "pair " << text(ids) << " at "
                               << (it == found.end() ? -1 : it->second) << ", fcl::distance " << d,
                       call_);
      }
    }
    return std::nullopt;
  }

  Random random_;
  const Case& case_;
  double size_;
  std::vector<std::unique_ptr<Object>> objects_;
  std::vector<std::function<void()>> changes_;  ///< of each object's geometry, in place
  SceneDistanced scene_;
  ManagerQueryd query_;
  std::map<Ids, double> truth_;
  std::string call_;
};

}  // namespace

Verdict askChanging(const Case& c) { return ChangingQuestion(c).run(); }

}  // namespace kios::fuzz
