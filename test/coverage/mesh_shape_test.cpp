// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Mesh against each of FCL's nine shapes, both orders, both GJK solvers, over any volume, against
// brute force over the triangles.

#include <set>

#include "coverage/shape_distance.h"
#include "coverage/tally.h"
#include "fcl/mesh_cases.h"

namespace kios::coverage {
namespace {

using testing::Frame;

struct Truth {
  double distance = 1e300;
  std::set<int> surely, possibly;  ///< triangles that overlap the shape, with a margin
  std::vector<std::array<Vector3d, 3>> triangles;  ///< in the shape's frame
};

Truth truthOf(const scenes::Mesh& mesh, const Frame& frame, const PointDistance& distance,
              double margin, bool is_plane) {
  Truth truth;
  const fcl::Transform3d X = frame.X_WB.inverse(Eigen::Isometry) * frame.X_WA;
  for (int i = 0; i < static_cast<int>(mesh.triangles.size()); ++i) {
    auto t = testing::corners(mesh, i);
    for (Vector3d& p : t) p = X * p;
    truth.triangles.push_back(t);
    const double d = triangleShapeDistance(t, distance, std::max(truth.distance, margin));
    truth.distance = std::min(truth.distance, d);
    if (d <= margin) truth.possibly.insert(i);
    if (is_plane) {  // without an inside: sure of it with corners on both sides
      const auto [low, high] = std::minmax({t[0][2], t[1][2], t[2][2]});
      if (low < 0.25 - margin && high > 0.25 + margin) truth.surely.insert(i);
    }
    // Sure of it if a corner or the centre is inside and stays so within the margin.
    const Vector3d centre = (t[0] + t[1] + t[2]) / 3;
    for (const Vector3d& p : {t[0], t[1], t[2], centre}) {
      bool deep = true;
      for (int way = 0; way < 6; ++way) {
        const Vector3d step = Vector3d::Unit(way / 2) * (way % 2 ? margin : -margin);
        if (distance(p + step) > 0) deep = false;
      }
      if (deep) truth.surely.insert(i);
    }
  }
  return truth;
}

// FCL's code for the distance to planes and halfspaces calls a null pointer (FCL.md 3, 17).
template <typename BV>
bool crashes(const std::string& shape, bool distance) {
  return !kOurs<BV> && distance && (shape == "plane" || shape == "halfspace");
}

template <typename BV>
void checkShape(const std::string& name, const ShapeCase<typename BV::S>& shape,
                const scenes::Mesh& given, std::uint64_t seed) {
  using S = typename BV::S;
  const scenes::Mesh mesh = rounded<S>(given);
  const auto model = scenes::buildModel<BV>(mesh);
  const double margin = 1e-6 + tolerance<S>(8);  // of iterative solvers, and of our oracle
  bool any_hit = false, any_miss = false;
  const bool endless = name == "plane" || name == "halfspace";
  for (Frame frame : testing::randomFrames(12, endless ? 2 : 0.9, seed)) {
    frame = {rounded<S>(frame.X_WA), rounded<S>(frame.X_WB)};
    const Truth truth = truthOf(mesh, frame, shape.distance, margin, name == "plane");
    any_hit = any_hit || !truth.surely.empty();
    any_miss = any_miss || truth.possibly.empty();
    for (const bool mesh_first : {true, false}) {
      for (const auto solver : {fcl::GST_LIBCCD, fcl::GST_INDEP}) {
        const fcl::CollisionGeometry<S>*g1 = model.get(), *g2 = shape.geometry.get();
        fcl::Transform3<S> X1 = frame.X_WA.cast<S>(), X2 = frame.X_WB.cast<S>();
        if (!mesh_first) std::swap(g1, g2), std::swap(X1, X2);

        fcl::CollisionRequest<S> request(testing::kAllContacts, true);
        request.gjk_solver_type = solver;
        fcl::CollisionResult<S> contacts;
        fcl::collide(g1, X1, g2, X2, request, contacts);
        std::set<int> hit;
        bool normals = true;
        for (std::size_t i = 0; i < contacts.numContacts(); ++i) {
          const auto& contact = contacts.getContact(i);
          hit.insert(static_cast<int>(contact.o1 == model.get() ? contact.b1 : contact.b2));
          normals = normals && contact.normal.allFinite() && contact.pos.allFinite() &&
                    std::abs(contact.normal.norm() - 1) < 1e-3 &&
                    std::isfinite(contact.penetration_depth);
        }
        const auto in = [](const std::set<int>& part, const std::set<int>& whole) {
          return std::includes(whole.begin(), whole.end(), part.begin(), part.end());
        };
        check<BV>(name + " contacts", in(truth.surely, hit) && in(hit, truth.possibly));
        check<BV>(name + " normals", normals);
        fcl::CollisionResult<S> verdict;
        fcl::CollisionRequest<S> first;
        first.gjk_solver_type = solver;
        const bool collides = fcl::collide(g1, X1, g2, X2, first, verdict) > 0;
        check<BV>(name + " verdict", collides ? !truth.possibly.empty() : truth.surely.empty());

        if (crashes<BV>(name, true)) continue;
        fcl::DistanceRequest<S> ask(true);
        ask.gjk_solver_type = solver;
        fcl::DistanceResult<S> result;
        const double d = fcl::distance(g1, X1, g2, X2, ask, result);
        // At overlap FCL says 0, or less; what less is worth is no matter here.
        const bool overlaps = truth.distance <= margin;
        check<BV>(
            name + " distance",
            overlaps ? d <= 2 * margin && std::isfinite(d) : std::abs(d - truth.distance) <= margin,
            std::to_string(d) + " for " + std::to_string(truth.distance));
        if (truth.distance < 10 * margin) continue;
        const bool model_is_first = result.o1 == model.get();
        const int triangle = static_cast<int>(model_is_first ? result.b1 : result.b2);
        const Vector3d p = result.nearest_points[model_is_first ? 0 : 1].template cast<double>();
        const Vector3d q = result.nearest_points[model_is_first ? 1 : 0].template cast<double>();
        const bool right = triangle >= 0 && triangle < model->num_tris &&
                           std::abs((p - q).norm() - truth.distance) <= margin &&
                           testing::distanceToTriangle(p, frame.X_WA, mesh, triangle) <= margin &&
                           shape.distance(frame.X_WB.inverse(Eigen::Isometry) * q) <= margin;
        check<BV>(name + " nearest points", right);
      }
    }
  }
  EXPECT_TRUE(any_hit && any_miss) << name;
}

template <typename BV>
class MeshShape : public ::testing::Test {};
TYPED_TEST_SUITE(MeshShape, Volumes);

TYPED_TEST(MeshShape, ClosedMesh) {
  for (const auto& [name, shape] : shapeCases<typename TypeParam::S>()) {
    checkShape<TypeParam>(name, shape, scenes::icosphere(0.6, 1), 401);
  }
}

TYPED_TEST(MeshShape, Soup) {
  for (const auto& [name, shape] : shapeCases<typename TypeParam::S>()) {
    checkShape<TypeParam>(name, shape, scenes::randomSoup(40, 0.6, 0.02, 0.7, 402), 403);
  }
}

// FCL.md 3, 16: FCL's leaf code for spheres does not set what it should.
TEST(MeshShapeOfFcl, SphereIsSeenWrong) { expectSeen("sphere nearest points"); }

// FCL.md 3, 17: a call through a null pointer, in a process of its own.
TEST(MeshShapeDeathTest, DistanceToAHalfspaceOfFcl) {
  const auto model = scenes::buildModel<fcl::OBBRSSd>(scenes::icosphere(0.6, 1));
  const fcl::Halfspaced halfspace(Vector3d::UnitZ(), -2);
  const auto ask = [&] {
    fcl::DistanceResultd result;
    fcl::distance(model.get(), fcl::Transform3d::Identity(), &halfspace,
                  fcl::Transform3d::Identity(), fcl::DistanceRequestd(), result);
  };
  EXPECT_DEATH(ask(), "");
}

}  // namespace
}  // namespace kios::coverage
