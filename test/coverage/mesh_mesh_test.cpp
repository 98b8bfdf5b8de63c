// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Mesh against mesh over any volume, against the oracle in long double.

#include <algorithm>

#include "coverage/tally.h"
#include "model/deform.h"
#include "scenes/random.h"

namespace kios::coverage {
namespace {

using testing::Frame;
using testing::MeshCase;
using testing::Pairs;
using testing::Vector3d;

// A pair of models over BV, and what is true of them.
template <typename BV>
struct Rig {
  using S = typename BV::S;
  using Model = fcl::BVHModel<BV>;
  Rig(const scenes::Mesh& a, const scenes::Mesh& b)
      : mesh_a(rounded<S>(a)),
        mesh_b(rounded<S>(b)),
        a(scenes::buildModel<BV>(mesh_a)),
        b(scenes::buildModel<BV>(mesh_b)),
        oracle(mesh_a, mesh_b) {}

  fcl::CollisionResult<S> collide(const Frame& f, std::size_t contacts) const {
    fcl::CollisionResult<S> result;
    const fcl::CollisionRequest<S> request(contacts);
    fcl::collide(a.get(), f.X_WA.cast<S>(), b.get(), f.X_WB.cast<S>(), request, result);
    return result;
  }
  fcl::DistanceResult<S> distance(const Frame& f, S at_most) const {
    fcl::DistanceResult<S> result(at_most);
    const fcl::DistanceRequest<S> request(true);
    fcl::distance(a.get(), f.X_WA.cast<S>(), b.get(), f.X_WB.cast<S>(), request, result);
    return result;
  }

  scenes::Mesh mesh_a, mesh_b;
  std::shared_ptr<Model> a, b;
  scenes::MeshOracle oracle;
};

template <typename S>
std::vector<Frame> framesFor(int count, double spread, std::uint64_t seed) {
  auto frames = testing::randomFrames(count, spread, seed);
  for (Frame& f : frames) f = {rounded<S>(f.X_WA), rounded<S>(f.X_WB)};
  return frames;
}

template <typename S>
Pairs pairsOf(const fcl::CollisionResult<S>& result) {
  Pairs pairs;
  for (std::size_t i = 0; i < result.numContacts(); ++i) {
    pairs.emplace_back(static_cast<int>(result.getContact(i).b1),
                       static_cast<int>(result.getContact(i).b2));
  }
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  return pairs;
}

// The pairs that meet wherever B is moved by `tol`, and those that meet somewhere there.
struct Bracket {
  Pairs surely, possibly;
};
Bracket bracket(const scenes::MeshOracle& oracle, const Frame& frame, double tol) {
  Bracket found;
  found.surely = found.possibly = oracle.collidingPairs(frame.X_WA, frame.X_WB);
  for (int way = 0; way < 6; ++way) {
    Frame moved = frame;
    moved.X_WB.translation()[way / 2] += way % 2 == 0 ? tol : -tol;
    const Pairs pairs = oracle.collidingPairs(moved.X_WA, moved.X_WB);
    Pairs both, any;
    std::set_intersection(found.surely.begin(), found.surely.end(), pairs.begin(), pairs.end(),
                          std::back_inserter(both));
    std::set_union(found.possibly.begin(), found.possibly.end(), pairs.begin(), pairs.end(),
                   std::back_inserter(any));
    found.surely.swap(both);
    found.possibly.swap(any);
  }
  return found;
}

bool within(const Pairs& part, const Pairs& whole) {
  return std::includes(whole.begin(), whole.end(), part.begin(), part.end());
}

// All checks of a pair at the given poses, in rows that start with `row`.
template <typename BV>
void checkPair(const std::string& row, const Rig<BV>& rig, const std::vector<Frame>& frames) {
  using S = typename BV::S;
  const double size = testing::sizeOf(rig.mesh_a, rig.mesh_b);
  for (const Frame& frame : frames) {
    const double tol =
        tolerance<S>(size + frame.X_WA.translation().norm() + frame.X_WB.translation().norm());
    const Bracket truth = bracket(rig.oracle, frame, 8 * tol);
    const double exact = rig.oracle.distance(frame.X_WA, frame.X_WB);
    const auto first = rig.collide(frame, 1);
    const bool hit = first.isCollision();
    check<BV>(row + " verdict", hit ? !truth.possibly.empty() : truth.surely.empty());
    const Pairs pairs = pairsOf(rig.collide(frame, testing::kAllContacts));
    check<BV>(row + " contacts", within(truth.surely, pairs) && within(pairs, truth.possibly));

    const auto near = rig.distance(frame, std::numeric_limits<S>::max());
    const double d = near.min_distance;
    check<BV>(row + " distance", std::abs(d - exact) <= tol,
              std::to_string(d) + " for " + std::to_string(exact));
    if (exact > tol) {
      const Vector3d p = near.nearest_points[0].template cast<double>();
      const Vector3d q = near.nearest_points[1].template cast<double>();
      const bool right = std::abs((p - q).norm() - exact) <= tol &&
                         testing::distanceToTriangle(p, frame.X_WA, rig.mesh_a, near.b1) <= tol &&
                         testing::distanceToTriangle(q, frame.X_WB, rig.mesh_b, near.b2) <= tol;
      check<BV>(row + " nearest points", right);
      const S below = static_cast<S>(0.5 * exact), above = static_cast<S>(2 * exact);
      check<BV>(row + " bound of the result",
                rig.distance(frame, below).min_distance == below &&
                    std::abs(rig.distance(frame, above).min_distance - exact) <= tol);
    }
  }
}

template <typename BV>
class MeshMesh : public ::testing::Test {};
TYPED_TEST_SUITE(MeshMesh, Volumes);

TYPED_TEST(MeshMesh, GeneralPosition) {
  for (const MeshCase& c : testing::meshCases()) {
    const Rig<TypeParam> rig(c.a, c.b);
    checkPair("general", rig, framesFor<typename TypeParam::S>(30, c.spread, 301));
  }
}

// Segments, points and slivers among the triangles.
TYPED_TEST(MeshMesh, DegenerateTriangles) {
  scenes::Random random(302);
  const auto flatten = [&](scenes::Mesh mesh) {
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
      Vector3d* p = &mesh.vertices[mesh.triangles[i][0]];  // a soup's corners stand together
      if (i % 3 == 0) p[2] = p[0] + random.unit() * (p[1] - p[0]);
      if (i % 3 == 1) p[2] = p[0] + random.unit() * (p[1] - p[0]) + Vector3d::Constant(1e-9);
      if (i % 9 == 2) p[1] = p[2] = p[0];
    }
    return mesh;
  };
  for (int i = 0; i < 4; ++i) {
    const Rig<TypeParam> rig(flatten(scenes::randomSoup(40, 0.4, 0.1, 1, 303 + i)),
                             flatten(scenes::randomSoup(40, 0.4, 0.1, 1, 313 + i)));
    checkPair("degenerate", rig, framesFor<typename TypeParam::S>(25, 1.2, 304));
  }
}

// Boxes of dyadic size that share a face, an edge or a corner, or miss by 2^-10.
TYPED_TEST(MeshMesh, Touching) {
  using S = typename TypeParam::S;
  const scenes::Mesh box = scenes::subdividedBox({1, 1, 1}, 2);
  const Rig<TypeParam> rig(box, box);
  for (int x = 0; x <= 1; ++x) {
    for (int y = 0; y <= 1; ++y) {
      for (const double gap : {0.0, 0x1p-10}) {
        for (const double shift : {0.0, 0.125, 0.3125}) {
          Frame frame{fcl::Transform3d::Identity(), fcl::Transform3d::Identity()};
          frame.X_WB.translation() = Vector3d(1 + gap, y ? 1 + gap : shift, x ? 1 + gap : shift);
          const double exact = rig.oracle.distance(frame.X_WA, frame.X_WB);
          check<TypeParam>("touching verdict", rig.collide(frame, 1).isCollision() == (exact == 0));
          const S d = rig.distance(frame, std::numeric_limits<S>::max()).min_distance;
          check<TypeParam>("touching distance",
                           std::abs(d - exact) <= tolerance<S>(2) && (d == 0) == (exact == 0));
        }
      }
    }
  }
}

// After FCL's refits, in both directions, and a rebuild.
TYPED_TEST(MeshMesh, DeformingModels) {
  using S = typename TypeParam::S;
  Rig<TypeParam> rig(scenes::bumpyTorus(200), scenes::icosphere(0.7, 1));
  const scenes::Mesh original = rig.mesh_a;
  const auto frames = framesFor<S>(8, 1.2, 305);
  for (int step = 0; step < 6; ++step) {
    rig.mesh_a.vertices = testing::swayed(original, 0.7 * step);
    rig.mesh_a = rounded<S>(rig.mesh_a);
    rig.oracle = scenes::MeshOracle(rig.mesh_a, rig.mesh_b);
    std::vector<fcl::Vector3<S>> vertices;
    for (const Vector3d& p : rig.mesh_a.vertices) vertices.push_back(p.cast<S>());
    rig.a->beginReplaceModel();
    rig.a->replaceSubModel(vertices);
    rig.a->endReplaceModel(step % 3 != 2, step % 3 == 0);
    checkPair(step % 3 == 0   ? "refit bottom-up"
              : step % 3 == 1 ? "refit top-down"
                              : "rebuilt",
              rig, frames);
  }
}

// One result for many queries keeps what is nearest so far, and its points where they were.
TYPED_TEST(MeshMesh, ReusedResult) {
  using S = typename TypeParam::S;
  const Rig<TypeParam> rig(scenes::bumpyTorus(120), scenes::icosphere(0.4, 1));
  fcl::DistanceResult<S> result;
  fcl::Vector3<S> before = fcl::Vector3<S>::Zero();
  S least = std::numeric_limits<S>::max();
  for (const Frame& frame : framesFor<S>(400, 4, 306)) {
    if (least < 0.05) {
      result.clear();
      least = std::numeric_limits<S>::max();
    }
    const fcl::DistanceRequest<S> request(true);
    fcl::distance(rig.a.get(), frame.X_WA.cast<S>(), rig.b.get(), frame.X_WB.cast<S>(), request,
                  result);
    if (result.min_distance == least) {
      check<TypeParam>("reused result", result.nearest_points[0] == before);
    }
    least = result.min_distance;
    before = result.nearest_points[0];
  }
}

// Far from the world's origin together: the offset is common to both and costs nothing.
TYPED_TEST(MeshMesh, CommonOffset) {
  using S = typename TypeParam::S;
  const Rig<TypeParam> rig(scenes::bumpyTorus(150), scenes::bumpyTorus(150));
  const double far = std::is_same_v<S, double> ? 0x1p30 : 0x1p10;
  for (Frame frame : framesFor<S>(40, 2, 307)) {
    frame.X_WA.translation() += Vector3d::Constant(far);
    frame.X_WB.translation() += Vector3d::Constant(far);
    frame = {rounded<S>(frame.X_WA), rounded<S>(frame.X_WB)};
    const double exact = rig.oracle.distance(frame.X_WA, frame.X_WB);
    const S d = rig.distance(frame, std::numeric_limits<S>::max()).min_distance;
    check<TypeParam>("common offset distance", std::abs(d - exact) <= tolerance<S>(8));
    if (exact > tolerance<S>(8)) {
      check<TypeParam>("common offset verdict", !rig.collide(frame, 1).isCollision());
    }
  }
}

// These must show, as FCL has them; else the checks above check nothing.
TEST(MeshMeshOfFcl, BottomUpRefitIsSeenWrong) { expectSeen("refit bottom-up distance"); }
TEST(MeshMeshOfFcl, CommonOffsetIsSeenToCost) { expectSeen("common offset distance"); }
TEST(MeshMeshOfFcl, MovedPointsOfAResultAreSeenWrong) { expectSeen("reused result"); }

}  // namespace
}  // namespace kios::coverage
