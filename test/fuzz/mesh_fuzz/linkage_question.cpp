// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// kios::checkMotion of a chain of joints that carries a mesh amid obstacles (meshes, shapes,
// octrees, some marked as solids), against the static queries at samples of the path: what is
// proven clear has no contact, what is named is in contact, and nothing before a first contact is.

#include <algorithm>
#include <ctime>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include <fcl/geometry/octree/octree.h>
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/narrowphase/collision_request.h>
#include <fcl/narrowphase/collision_result.h>
#include <fcl/narrowphase/distance_request.h>
#include <fcl/narrowphase/distance_result.h>
#include <octomap/octomap.h>
#include "fcl_kios/linkage.h"
#include "fcl_kios/overloads.h"
#include "fcl_kios/solids.h"
#include "fuzz/mesh_fuzz/hard_meshes.h"
#include "fuzz/mesh_fuzz/pair.h"
#include "fuzz/mesh_fuzz/questions.h"

namespace kios::fuzz {
namespace {

using Geometry = std::shared_ptr<const fcl::CollisionGeometryd>;

class LinkageQuestion {
 public:
  explicit LinkageQuestion(const Case& c) : random_(c.draw), case_(c), size_(reachOf(c.meshes)) {
    if (size_ == 0) size_ = 1;
  }

  Verdict run() {
    for (const Transform3d& X : case_.frames[0]) {
      if (skewOf(X) > 1e-14) return std::nullopt;
    }
    buildChain();
    for (std::size_t i = 1; i < case_.meshes.size(); ++i) addObstacle(i);
    const double way = power(random_, -3, 0.5);
    q0_ = middle_ -
          way * random_.unit() * Eigen::VectorXd::Ones(middle_.size()).cwiseProduct(signs());
    q1_ = q0_ + way * signs();
    MotionRequest request;
    request.resolution = std::exp2(-below(random_, 21));
    request.first_contact = chance(random_, 0.5);
    if (chance(random_, 0.3)) request.min_separation = size_ * power(random_, -6, -1);
    const int most = queriesWithin(kTriangleTests);
    request.max_queries = chance(random_, 0.2) ? 1 + below(random_, most) : most;
    const MotionResult answer = checkMotion(linkage_, q0_, q1_, request);
    call_ = "checkMotion: draw " + std::to_string(case_.draw) + ", resolution " +
            literal(request.resolution) + ", first " + std::to_string(request.first_contact) +
            ", separation " + literal(request.min_separation) + ", queries " +
            std::to_string(request.max_queries);
    return judge(request, answer);
  }

 private:
  static constexpr long long kTriangleTests = 800'000;  // of 1 us each

  /// The queries that even brute force answers within so many tests of two triangles: where all of
  /// two meshes' features are nearer to each other than floats can tell, none is spared.
  int queriesWithin(long long tests) const {
    std::size_t most = 1;
    for (const Mesh& mesh : case_.meshes) most = std::max(most, mesh.triangles.size());
    const auto pairs = static_cast<long long>(most * most);
    return static_cast<int>(std::clamp<long long>(tests / pairs, 8, 500));
  }

  Eigen::VectorXd signs() {
    Eigen::VectorXd v(middle_.size());
    for (int i = 0; i < v.size(); ++i) v[i] = units_[i] * random_.uniform(-1, 1);
    return v;
  }

  /// A chain of one to three joints, at whose middle the first mesh stands at its pose.
  void buildChain() {
    const int joints = 1 + below(random_, 3);
    Linkage scratch;
    int link = -1;
    middle_.resize(joints);
    for (int i = 0; i < joints; ++i) {
      Joint joint;
      joint.type = chance(random_, 0.5) ? JointType::kRevolute : JointType::kPrismatic;
      Transform3d X = Transform3d::Identity();
      if (chance(random_, 0.6)) X.linear() = scenes::rotation(random_);
      X.translation() = size_ * random_.uniform(-1, 1) * scenes::point(random_);
      joint.X_PJ = X;
      joint.axis = chance(random_, 0.5) ? Vector3d(Vector3d::UnitX()) : scenes::direction(random_);
      units_.push_back(joint.type == JointType::kRevolute ? 1 : size_);
      middle_[i] = units_.back() * random_.uniform(-1, 1);
      scratch.addLink(link, joint);
      link = linkage_.addLink(link, joint);
    }
    const int probe = scratch.addBody(link, std::make_shared<fcl::Sphered>(size_));
    const Transform3d X_WL = scratch.pose(probe, middle_);
    add(link, modelOf<double>(case_.meshes[0], case_.foreign), X_WL.inverse() * case_.pose(0));
    if (joints == 1 || !chance(random_, 0.3)) return;
    add(0, modelOf<double>(relativeOf(case_.meshes[0], random_), false), Transform3d::Identity());
  }

  void addObstacle(std::size_t i) {
    const double kind = random_.unit();
    if (kind < 0.15) {
      add(-1, std::make_shared<fcl::Boxd>(size_ * Vector3d(1, 0.3, power(random_, -4, 0))),
          case_.pose(i));
    } else if (kind < 0.3) {
      add(-1, std::make_shared<fcl::Sphered>(size_ * power(random_, -3, 0)), case_.pose(i));
    } else if (kind < 0.4) {
      const auto cells = std::make_shared<octomap::OcTree>(0.3 * size_);
      for (int k = 0; k < 5; ++k) {
        const Vector3d p = size_ * scenes::point(random_);
        cells->updateNode(p.x(), p.y(), p.z(), true);
      }
      add(-1, std::make_shared<fcl::OcTreed>(std::shared_ptr<const octomap::OcTree>(cells)),
          case_.pose(i));
    } else {
      add(-1, modelOf<double>(case_.meshes[i], case_.foreign), case_.pose(i));
    }
  }

  void add(int link, std::shared_ptr<fcl::CollisionGeometryd> geometry, const Transform3d& X_LB) {
    if (auto* const model = dynamic_cast<Modeld*>(geometry.get()); model && chance(random_, 0.5)) {
      markIfSolid(*model);
    }
    linkage_.addBody(link, geometry, X_LB);
    bodies_.emplace_back(link, std::move(geometry));
  }

  bool touch(std::size_t a, std::size_t b, const Eigen::VectorXd& q, double separation) const {
    const Transform3d X = linkage_.pose(static_cast<int>(a), q),
                      Y = linkage_.pose(static_cast<int>(b), q);
    fcl::CollisionResultd contacts;
    fcl::collide(bodies_[a].second.get(), X, bodies_[b].second.get(), Y, fcl::CollisionRequestd(),
                 contacts);
    if (contacts.isCollision()) return true;
    if (separation == 0) return false;
    fcl::DistanceResultd result;
    return fcl::distance(bodies_[a].second.get(), X, bodies_[b].second.get(), Y,
                         fcl::DistanceRequestd(), result) <= separation;
  }

  std::optional<std::pair<std::size_t, std::size_t>> contactAt(double s, double separation) const {
    const Eigen::VectorXd q = q0_ + s * (q1_ - q0_);
    for (std::size_t a = 0; a < bodies_.size(); ++a) {
      for (std::size_t b = a + 1; b < bodies_.size(); ++b) {
        if (bodies_[a].first == bodies_[b].first) continue;
        if (touch(a, b, q, separation)) return std::make_pair(a, b);
      }
    }
    return std::nullopt;
  }

  Verdict judge(const MotionRequest& request, const MotionResult& answer) const {
    const bool clear = answer.verdict == MotionVerdict::kClear;
    const bool spent = answer.verdict == MotionVerdict::kBudgetSpent;
    if (spent && answer.counts.queries < request.max_queries) {
      return failure(Words() << "a spent budget after " << answer.counts.queries << " queries",
                     call_);
    }
    if (!clear &&
        !(answer.from <= answer.to && (spent || answer.to - answer.from <= request.resolution))) {
      return failure(Words() << "an interval from " << answer.from << " to " << answer.to, call_);
    }
    if (answer.verdict == MotionVerdict::kContact &&
        !touch(static_cast<std::size_t>(answer.body_a), static_cast<std::size_t>(answer.body_b),
               q0_ + answer.to * (q1_ - q0_), request.min_separation)) {
      return failure(Words() << "no contact of " << answer.body_a << " and " << answer.body_b
                             << " at " << answer.to,
                     call_);
    }
    const double free = clear ? 2 : request.first_contact ? answer.from : 0;
    // Between meshes of which all triangles are equally near, as far as rounding can tell, a
    // distance takes milliseconds: not all samples are worth that.
    constexpr int kSamples = 60;
    constexpr std::clock_t kLongest = CLOCKS_PER_SEC / 4;
    const std::clock_t begin = std::clock();
    for (int i = 0; i <= kSamples && std::clock() - begin < kLongest; ++i) {
      const double s = static_cast<double>((37 * i) % (kSamples + 1)) / kSamples;
      if (s >= free) continue;
      if (const auto pair = contactAt(s, request.min_separation)) {
        return failure(Words() << "verdict " << static_cast<int>(answer.verdict) << " from "
                               << answer.from << ", but bodies " << static_cast<int>(pair->first)
                               << " and " << static_cast<int>(pair->second) << " touch at " << s,
                       call_);
      }
    }
    return std::nullopt;
  }

  Random random_;
  const Case& case_;
  double size_;
  Linkage linkage_;
  std::vector<std::pair<int, Geometry>> bodies_;  ///< link and geometry
  std::vector<double> units_;                     ///< of the coordinates
  Eigen::VectorXd middle_, q0_, q1_;
  std::string call_;
};

}  // namespace

Verdict askLinkage(const Case& c) { return LinkageQuestion(c).run(); }

}  // namespace kios::fuzz
