// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Rays: the hits of all three queries against every triangle, by the exact kernel, and that against
// integers. At poses that map rays exactly all must be equal; at others a hit may only be disputed
// where the ray passes an edge within the bound of that map.

#include "fcl_kios/rays.h"

#include "fuzz/mesh_fuzz/hard_poses.h"
#include "fuzz/mesh_fuzz/pair.h"
#include "fuzz/mesh_fuzz/questions.h"
#include "scenes/ray_oracle.h"
#include "triangle/ray_triangle.h"

namespace kios::fuzz {
namespace {

template <typename S>
class RayQuestion {
 public:
  explicit RayQuestion(const Case& c)
      : random_(c.draw),
        model_(modelOf<S>(c.meshes[0], c.foreign)),
        X_(c.pose(0).cast<S>()),
        exact_pose_(X_.matrix().isIdentity(0)) {
    for (const auto& t : BruteForce<S>::trianglesOf(c.meshes[0])) {
      triangles_.push_back({t[0].template cast<double>(), t[1].template cast<double>(),
                            t[2].template cast<double>()});
      for (const auto& p : triangles_.back()) most_ = std::max(most_, p.cwiseAbs().maxCoeff());
    }
  }

  Verdict run() {
    for (int i = 0; i < 6; ++i) {
      if (auto wrong = askOne(draw())) return wrong;
    }
    return std::nullopt;
  }

 private:
  /// Returns a point of the mesh, in its frame.
  Vector3d content() {
    const auto& t =
        triangles_[static_cast<std::size_t>(below(random_, static_cast<int>(triangles_.size())))];
    switch (below(random_, 4)) {
      case 0:
        return t[0];
      case 1:
        return 0.5 * (t[0] + t[1]);
      case 2:
        return t[0] + random_.unit() * (t[2] - t[1]);
      default:
        return 0.25 * t[0] + 0.25 * t[1] + 0.5 * t[2];
    }
  }

  Ray<S> draw() {
    Vector3d from = content(), way;
    const double size = most_ > 0 ? most_ : 1;
    if (chance(random_, 0.7)) from += size * power(random_, -6, 3) * scenes::direction(random_);
    switch (below(random_, 4)) {
      case 0:
        way = content() - content();  // along an edge, or in a face
        break;
      case 1:
        way = scenes::latticePoint(random_, 1);
        break;
      default:
        way = content() - from;
    }
    if (way.isZero(0)) way = Vector3d::UnitZ();
    way *= chance(random_, 0.7) ? 1 : power(random_, -6, 6);
    Ray<S> ray;
    const fcl::Transform3d X = X_.template cast<double>();
    ray.origin = (X * from).cast<S>();
    ray.direction = (X.linear() * way).cast<S>();
    if (ray.direction.isZero(0)) ray.direction = fcl::Vector3<S>::UnitX();
    if (chance(random_, 0.3)) ray.t_min = static_cast<S>(random_.uniform(-2, 1));
    if (chance(random_, 0.3)) ray.t_max = ray.t_min + static_cast<S>(random_.uniform(0, 3));
    if (chance(random_, 0.2)) ray.t_max = std::max(ray.t_min, S{1});  // ends at what it aims at
    return ray;
  }

  Verdict askOne(const Ray<S>& ray) {
    std::ostringstream call;
    call << "kios::Ray<S> ray; ray.origin = {" << literal(ray.origin[0]) << ", "
         << literal(ray.origin[1]) << ", " << literal(ray.origin[2]) << "}; ray.direction = {"
         << literal(ray.direction[0]) << ", " << literal(ray.direction[1]) << ", "
         << literal(ray.direction[2]) << "}; ray.t_min = " << literal(ray.t_min)
         << "; ray.t_max = " << literal(ray.t_max) << "; kios::allHits(*A, X[0], ray)";
    const auto all = allHits(*model_, X_, ray);
    const auto first = firstHit(*model_, X_, ray);
    if (first.has_value() != !all.empty() || anyHit(*model_, X_, ray) != !all.empty() ||
        (first && (first->t != all[0].t || first->triangle != all[0].triangle))) {
      return failure(Words() << all.size()
                             << " hits in all, first: " << (first ? first->triangle : -1)
                             << ", any: " << anyHit(*model_, X_, ray),
                     call.str());
    }
    const std::size_t limit = static_cast<std::size_t>(below(random_, 4));
    const auto some = allHits(*model_, X_, ray, limit);
    bool prefix = some.size() == std::min(limit, all.size());
    for (std::size_t i = 0; prefix && i < some.size(); ++i) {
      prefix = some[i].t == all[i].t && some[i].triangle == all[i].triangle;
    }
    if (!prefix) {
      return failure(
          Words() << some.size() << " hits up to " << limit << " differ from all " << all.size(),
          call.str());
    }
    for (std::size_t i = 1; i < all.size(); ++i) {
      if (all[i - 1].t > all[i].t || (all[i - 1].t == all[i].t && sizeof(S) == sizeof(double) &&
                                      all[i - 1].triangle >= all[i].triangle)) {
        return failure(Words() << "hits out of order at " << i, call.str());
      }
    }

    // The ray in the model's frame.
    const Eigen::Matrix3d inverse = X_.linear().template cast<double>().inverse();
    const Vector3d away =
        ray.origin.template cast<double>() - X_.translation().template cast<double>();
    const Vector3d direction = ray.direction.template cast<double>();
    const double t_max = std::min<double>(ray.t_max, std::numeric_limits<S>::max());
    const GivenRay given = {
        exact_pose_ ? Vector3d(ray.origin.template cast<double>()) : Vector3d(inverse * away),
        exact_pose_ ? direction : Vector3d(inverse * direction), 0, ray.t_min, t_max};
    const ExactRay exact(given, most_);
    const double error = exact_pose_ ? 0 : 0x1p-47 * away.lpNorm<1>();
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
      TriangleHit expected = {};
      const bool hits = exact.hits(triangles_[t], expected);
      if (chance(random_, 0.1)) {
        const auto judged = scenes::rationalRayHit(
            {given.origin, given.direction, given.t_min, given.t_max}, triangles_[t]);
        if (judged.has_value() != hits || (hits && static_cast<double>(judged->t) != expected.t &&
                                           std::abs(static_cast<double>(judged->t - expected.t)) >
                                               std::abs(expected.t) * 0x1p-53)) {
          return failure(Words() << "the kernel on triangle " << static_cast<int>(t) << ": " << hits
                                 << " at " << expected.t << ", exactly " << judged.has_value(),
                         call.str());
        }
      }
      const RayHit<S>* found = nullptr;
      for (const auto& hit : all) {
        if (hit.triangle == static_cast<int>(t)) found = &hit;
      }
      if ((found != nullptr) != hits) {
        if (!exact_pose_ && nearEdge(given, triangles_[t], error)) continue;
        return failure(Words() << "triangle " << static_cast<int>(t) << (hits ? " missed" : " hit")
                               << "; exactly " << hits << " at " << expected.t,
                       call.str());
      }
      if (hits && exact_pose_ && found->t != static_cast<S>(expected.t)) {
        return failure(Words() << "triangle " << static_cast<int>(t) << " at " << found->t
                               << ", exactly " << expected.t,
                       call.str());
      }
    }
    return std::nullopt;
  }

  /// True if rounding may decide: the ray's part passes the triangle's border, or begins or ends at
  /// it, by no more than the rounding of the mapped points.
  bool nearEdge(const GivenRay& ray, const TriangleVertices<double>& t, double error) const {
    const double length = ray.direction.norm();
    const auto far = [&](double at) {  // beyond the mesh nothing matters
      const double reach = (ray.origin.norm() + 4 * most_) / length;
      return Vector3d(ray.origin + std::clamp(at, -reach, reach) * ray.direction);
    };
    const Vector3d p = far(ray.t_min), q = far(ray.t_max);
    const double bound = 4 * error + 0x1p-46 * ((p - q).norm() + ray.origin.norm() + most_);
    const TriangleVertices<double> segment = {p, q, q};
    if (triangleDistance<double>({p, p, p}, t).distance <= bound ||
        triangleDistance<double>({q, q, q}, t).distance <= bound) {
      return true;
    }
    for (int k = 0; k < 3; ++k) {
      const Vector3d &u = t[k], &v = t[(k + 1) % 3];
      if (triangleDistance<double>(segment, {u, v, v}).distance <= bound) return true;
    }
    // Nearly in the triangle's plane.
    const Vector3d n = (t[1] - t[0]).cross(t[2] - t[0]);
    return std::abs(n.dot(ray.direction)) <= 1e-9 * n.norm() * length;
  }

  Random random_;
  const std::shared_ptr<Model<S>> model_;
  const fcl::Transform3<S> X_;
  const bool exact_pose_;
  std::vector<TriangleVertices<double>> triangles_;  ///< as S holds them
  double most_ = 0;                                  ///< largest coordinate
};

}  // namespace

Verdict askRay(const Case& c) {
  return c.in_float ? RayQuestion<float>(c).run() : RayQuestion<double>(c).run();
}

}  // namespace kios::fuzz
