// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Points: the nearest point of a mesh against all of its triangles, in batches that begin anywhere,
// winding numbers and the signs of distances, from solids and other meshes, against the sum of all
// angles.

#include "fcl_kios/points.h"
#include "fcl_kios/solids.h"

#include "fuzz/mesh_fuzz/pair.h"
#include "fuzz/mesh_fuzz/questions.h"
#include "scenes/containment_oracle.h"

namespace kios::fuzz {
namespace {

template <typename S>
class PointQuestion {
 public:
  explicit PointQuestion(const Case& c)
      : random_(c.draw),
        model_(modelOf<S>(c.meshes[0], c.foreign)),
        triangles_(BruteForce<S>::trianglesOf(c.meshes[0])) {
    for (const auto& t : triangles_) {
      for (const Vector3d& p : t) most_ = std::max(most_, (p - triangles_[0][0]).norm());
    }
  }

  Verdict run() {
    constexpr int kPoints = 12;
    Eigen::Matrix3Xd points(3, kPoints), nearest(3, kPoints);
    for (int i = 0; i < kPoints; ++i) points.col(i) = draw();
    Eigen::VectorXd distances(kPoints);
    Eigen::VectorXi triangles(kPoints);
    nearestPoints(*model_, points, distances, nearest, triangles);
    const bool is_solid = markIfSolid(*model_);
    const WindingTree tree(*model_);
    PointRequest request;
    if (!is_solid) request.winding = &tree;
    if (chance(random_, 0.5)) request.within = most_ * power(random_, -8, 1);
    Eigen::VectorXd with_sign(kPoints);
    signedDistances(*model_, points, with_sign, request);
    for (int i = 0; i < kPoints; ++i) {
      const Vector3d p = points.col(i);
      std::ostringstream call;
      call << "kios::nearestPoint(*A, {" << literal(p[0]) << ", " << literal(p[1]) << ", "
           << literal(p[2]) << "})";
      const NearestPoint one = nearestPoint(*model_, p);
      if (one.distance != distances[i] || one.triangle != triangles[i]) {
        return failure(Words() << "alone " << one.distance << " to " << one.triangle
                               << ", in a batch " << distances[i] << " to " << triangles[i],
                       call.str());
      }
      double least = std::numeric_limits<double>::infinity();
      for (const auto& t : triangles_) {
        least = std::min(least, triangleDistance<double>({p, p, p}, t).distance);
      }
      // Both kernels are right to 16 eps of the extent.
      const double bound = 64 * 0x1p-52 * (least + 2 * most_) + 1e-300;
      if (!(std::abs(one.distance - least) <= bound) || (one.distance == 0) != (least == 0)) {
        return failure(Words() << one.distance << ", but some triangle is " << least << " away",
                       call.str());
      }
      const double error = power(random_, -8, 0), number = tree.at(p, error);
      // Long doubles lose their digits near edges.
      const bool by_angles = one.distance > 1e-6 * most_;
      const double sum =
          by_angles ? static_cast<double>(testing::windingNumber(triangles_, p)) : tree.at(p, 0);
      const double far =
          one.distance <= request.within ? one.distance : std::numeric_limits<double>::infinity();
      const double own = signedDistance(*model_, p, request);
      const bool judges_sign = by_angles && std::abs(sum - 0.5) > 1e-6;
      if (with_sign[i] != own || std::abs(own) != far ||
          (judges_sign && (own < 0) != (sum > 0.5))) {
        return failure(Words() << "signed distance " << own << ", in a batch " << with_sign[i]
                               << ", unsigned " << far << ", winding number " << sum,
                       call.str());
      }
      if (!(std::abs(number - sum) <= error + 1e-9)) {
        return failure(
            Words() << "winding number " << number << ", the sum is " << sum << ", error " << error,
            call.str());
      }
    }
    return std::nullopt;
  }

 private:
  /// On, near, within and far from the mesh.
  Vector3d draw() {
    const auto& t =
        triangles_[static_cast<std::size_t>(below(random_, static_cast<int>(triangles_.size())))];
    Vector3d p = t[0];
    if (chance(random_, 0.5)) p = 0.5 * (t[0] + t[1]);
    if (chance(random_, 0.3)) p = (t[0] + t[1] + t[2]) / 3;
    if (chance(random_, 0.8)) p += most_ * power(random_, -16, 4) * scenes::direction(random_);
    return p;
  }

  Random random_;
  const std::shared_ptr<Model<S>> model_;
  const testing::Triangles triangles_;  ///< as S holds them
  double most_ = 0;                     ///< of them, from the first one
};

}  // namespace

Verdict askPoint(const Case& c) {
  return c.in_float ? PointQuestion<float>(c).run() : PointQuestion<double>(c).run();
}

}  // namespace kios::fuzz
