// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Rays against meshes, by brute force with exact rational verdicts. mesh_fuzz compares the three
// queries with each other, at poses and over nastier meshes.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "fcl_kios/rays.h"
#include "scalars.h"
#include "scenes/ray_oracle.h"
#include "shapes.h"

namespace kios::testing {
namespace {

template <typename S>
const fcl::Transform3<S> kIdentity = fcl::Transform3<S>::Identity();

/// The weights' point lies on the ray at t, and is what is told.
template <typename S>
void expectOnBoth(const Model<S>& model, const Ray<S>& ray, const RayHit<S>& hit) {
  using Long = Eigen::Matrix<long double, 3, 1>;
  const Long start = ray.origin.template cast<long double>(),
             way = hit.t * ray.direction.template cast<long double>();
  Long point = Long::Zero();
  long double size = start.norm() + way.norm();
  for (int i = 0; i < 3; ++i) {
    const Long corner =
        model.vertices[model.tri_indices[hit.triangle][i]].template cast<long double>();
    point += hit.weights[i] * corner;
    size += corner.norm();
  }
  // Numbers below the least normal one are rounded absolutely.
  const long double bound = 8 * std::numeric_limits<S>::epsilon() * size +
                            8 * static_cast<long double>(std::numeric_limits<S>::denorm_min());
  EXPECT_LE((start + way - point).norm(), bound);
  EXPECT_LE((hit.point.template cast<long double>() - point).norm(), bound);
}

/// Judges all hits, the model at the world's origin. Returns their number.
template <typename S>
std::size_t expectBruteForce(const Model<S>& model, const Ray<S>& ray) {
  SCOPED_TRACE(::testing::Message()
               << std::hexfloat << "origin " << ray.origin.transpose() << " direction "
               << ray.direction.transpose() << " t " << ray.t_min << " " << ray.t_max);
  constexpr S kMax = std::numeric_limits<S>::max();
  auto hits = allHits(model, kIdentity<S>, ray);
  EXPECT_TRUE(std::is_sorted(hits.begin(), hits.end(),
                             [](const auto& a, const auto& b) { return a.t < b.t; }));
  std::sort(hits.begin(), hits.end(),
            [](const auto& a, const auto& b) { return a.triangle < b.triangle; });
  std::size_t at = 0;
  for (int t = 0; t < model.num_tris; ++t) {
    std::array<Eigen::Vector3d, 3> corners;
    for (std::size_t i = 0; i < 3; ++i) {
      corners[i] = model.vertices[model.tri_indices[t][i]].template cast<double>();
    }
    const auto exact = scenes::rationalRayHit(
        {ray.origin.template cast<double>(), ray.direction.template cast<double>(), ray.t_min,
         std::min(ray.t_max, kMax)},
        corners);
    const bool listed = at < hits.size() && hits[at].triangle == t;
    EXPECT_EQ(listed, exact.has_value()) << t;
    const RayHit<S>* const hit = listed ? &hits[at++] : nullptr;
    if (!hit || !exact) continue;
    // One rounding of t to S, after one to double.
    const S next = std::nextafter(std::abs(hit->t), std::numeric_limits<S>::infinity());
    const auto half = 0.5L * (static_cast<long double>(next) - std::abs(hit->t));
    EXPECT_LE(std::abs(static_cast<long double>(hit->t) - exact->t), half * (1 + 0x1p-9L));
    EXPECT_EQ(hit->side, !exact->crosses       ? RaySide::kEdgeOn
                         : exact->along_normal ? RaySide::kBack
                                               : RaySide::kFront);
    expectOnBoth(model, ray, *hit);
  }
  EXPECT_EQ(at, hits.size());
  return hits.size();
}

/// Returns a ray from `far` sizes away, or from the mesh: at a corner, a point of an edge or the
/// middle of a triangle, along an edge or anywhere.
template <typename S>
Ray<S> hardRay(const Model<S>& model, S far, Random& random) {
  const fcl::Triangle& ids = model.tri_indices[static_cast<int>(random.unit() * model.num_tris)];
  const fcl::Vector3<S> p = model.vertices[ids[0]], q = model.vertices[ids[1]],
                        r = model.vertices[ids[2]];
  const fcl::Vector3<S> targets[] = {p, S(0.5) * (p + q), p + S(random.unit()) * (q - p),
                                     (p + q + r) / S(3), q};
  const kIOS<S>& root = model.getBV(0).bv;
  const auto kind = static_cast<std::size_t>(random.unit() * 7);
  Ray<S> ray;
  ray.origin = root.center0 + far * root.radius0 * inCube(random).cast<S>();
  ray.direction = kind < 5 ? (targets[kind] - ray.origin).eval() : (q - p).eval();
  if (kind == 5) ray.origin = p - ray.direction;
  if (kind == 6) ray.origin = targets[3];
  if (random.unit() < 0.2) ray.t_min = S(-1);
  if (random.unit() < 0.2) ray.t_max = S(1);
  return ray;
}

KIOS_SCALAR_SUITE(RayQuery);

// From inside a closed mesh every ray leaves it, and both ways; nothing passes at the vertices and
// edges that it is aimed at.
TYPED_TEST(RayQuery, WatertightInEveryPose) {
  using S = TypeParam;
  struct Closed {
    Mesh mesh;
    fcl::Vector3d inside;
  };
  const auto cast = [](const fcl::Vector3d& v) { return fcl::Vector3<S>(v.template cast<S>()); };
  for (const Closed& closed :
       {Closed{scenes::bumpyTorus(600), {1, 0, 0}}, Closed{scenes::icosphere(1, 2), {0, 0, 0.1}},
        Closed{scenes::uvSphere(1, 9, 60), {0.05, 0, 0}},
        Closed{scenes::subdividedBox({1, 2, 3}, 5), {0.1, 0.2, -0.3}}}) {
    const auto model = scenes::buildModel<kIOS<S>>(closed.mesh);
    const Mesh& mesh = closed.mesh;
    int lost = 0;
    for (const fcl::Transform3d& X_double : scenes::randomPoses(12, 3, 21)) {
      const fcl::Transform3<S> X = X_double.cast<S>();
      Ray<S> ray;
      ray.origin = X * cast(closed.inside);
      for (const fcl::Triangle& t : mesh.triangles) {
        const fcl::Vector3<S> p = X * cast(mesh.vertices[t[0]]), q = X * cast(mesh.vertices[t[1]]);
        for (const fcl::Vector3<S>& target : {p, (S(0.5) * (p + q)).eval()}) {
          ray.direction = target - ray.origin;
          lost += firstHit(*model, X, ray) ? 0 : 1;
          lost += anyHit(*model, X, ray) ? 0 : 1;
          ray.direction = -ray.direction;
          lost += anyHit(*model, X, ray) ? 0 : 1;
        }
      }
    }
    EXPECT_EQ(lost, 0);
  }
}

// Triangles that share the point that is hit agree on t, bit by bit.
TYPED_TEST(RayQuery, OnePointHasOneParameter) {
  using S = TypeParam;
  const Mesh mesh = scenes::subdividedBox({4, 4, 4}, 4);
  const auto model = scenes::buildModel<kIOS<S>>(mesh);
  Random random(4);
  for (int i = 0; i < 200; ++i) {
    Ray<S> ray;
    ray.origin = fcl::Vector3<S>(3, static_cast<S>(random.uniform(-5, 5)), 7);
    ray.direction = static_cast<S>(random.uniform(0.1, 3)) *
                    (fcl::Vector3<S>(1, ray.origin[1], 2) - ray.origin);
    const auto hits = allHits(*model, kIdentity<S>, ray);
    for (std::size_t k = 1; k < hits.size(); ++k) {
      if (hits[k].t == hits[k - 1].t) continue;
      EXPECT_GT((hits[k].point - hits[k - 1].point).norm(), S(1e-4));
    }
  }
}

// A frame maps the ray within the bound that is stated; points lie where they should.
TYPED_TEST(RayQuery, PosesMoveARayWithinTheBound) {
  using S = TypeParam;
  using Long = Eigen::Matrix<long double, 3, 1>;
  const Mesh mesh = scenes::bumpyTorus(300);
  const auto model = scenes::buildModel<kIOS<S>>(mesh);
  Random random(12);
  int hits = 0;
  for (const double offset : {1.0, 1e3, 1e9}) {
    for (fcl::Transform3d X_double : scenes::randomPoses(40, offset, 31)) {
      if (hits % 3 == 0) X_double.linear() *= 1 + 1e-6;  // as given, not as a rotation
      const fcl::Transform3<S> X = X_double.cast<S>();
      const fcl::Vector3d target(random.uniform(-1.3, 1.3), random.uniform(-1.3, 1.3), 0);
      Ray<S> ray;
      ray.origin = X * fcl::Vector3<S>(static_cast<S>(3 + offset), S(2), S(5));
      ray.direction = S(3) * (X * target.cast<S>().eval() - ray.origin);
      if (ray.direction.isZero(0)) continue;
      const Long T = X.translation().template cast<long double>(),
                 o = ray.origin.template cast<long double>(),
                 d = ray.direction.template cast<long double>();
      const auto R = X.linear().template cast<long double>().eval();
      for (const RayHit<S>& hit : allHits(*model, X, ray)) {
        ++hits;
        Long v[3], world[3], point = Long::Zero();
        for (int i = 0; i < 3; ++i) {
          v[i] = model->vertices[model->tri_indices[hit.triangle][i]].template cast<long double>();
          world[i] = R * v[i] + T;
          point += hit.weights[i] * world[i];
        }
        const Long n = (world[1] - world[0]).cross(world[2] - world[0]).normalized();
        const long double t = n.dot(world[0] - o) / n.dot(d);
        // Each coordinate by 2^-48, turned: by sqrt(3) of that along n; R is off one by 1e-6.
        const long double moved =
            2 * 0x1p-48L * ((o - T).template lpNorm<1>() + std::abs(t) * d.template lpNorm<1>());
        const long double rounding = std::numeric_limits<S>::epsilon() * std::abs(t);
        EXPECT_LE(std::abs(hit.t - t), moved / std::abs(n.dot(d)) + rounding);
        long double largest = T.cwiseAbs().maxCoeff() + 2;
        EXPECT_LE((hit.point.template cast<long double>() - point).norm(),
                  8 * std::numeric_limits<S>::epsilon() * largest);
      }
    }
  }
  EXPECT_GT(hits, 50);
}

// Poses that turn axes into axes, and move by what floats hold, map exactly.
TYPED_TEST(RayQuery, ExactPosesAreExact) {
  using S = TypeParam;
  const auto model = scenes::buildModel<kIOS<S>>(scenes::subdividedBox({4, 4, 4}, 4));
  fcl::Transform3<S> X = kIdentity<S>;
  X.linear() << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  X.translation() << 1, -2, S(0.5);
  Random random(6);
  for (int i = 0; i < 200; ++i) {
    Ray<S> local;
    for (int c = 0; c < 3; ++c) {
      local.origin[c] = static_cast<S>(std::floor(random.uniform(-6, 7)));
      local.direction[c] = static_cast<S>(std::floor(random.uniform(-2, 3)));
    }
    if (local.direction.isZero(0)) continue;
    Ray<S> ray = local;
    ray.origin = X * local.origin;
    ray.direction = X.linear() * local.direction;
    const auto hits = allHits(*model, X, ray), expected = allHits(*model, kIdentity<S>, local);
    ASSERT_EQ(hits.size(), expected.size());
    for (std::size_t k = 0; k < hits.size(); ++k) {
      EXPECT_EQ(hits[k].t, expected[k].t);
      EXPECT_EQ(hits[k].triangle, expected[k].triangle);
      EXPECT_EQ(hits[k].side, expected[k].side);
    }
  }
}

TYPED_TEST(RayQuery, ScalesAndFarOrigins) {
  using S = TypeParam;
  Random random(5);
  std::size_t hits = 0;
  const auto scales = sizeof(S) == sizeof(double)
                          ? std::vector<double>{1e-300, 1e-150, 1e-12, 1e12, 1e150, 1e290}
                          : std::vector<double>{1e-30, 1e-12, 1e12, 1e30};
  for (const double scale : scales) {
    const Mesh mesh = transformed(scenes::bumpyTorus(100), scale, fcl::Vector3d::Zero());
    const auto model = scenes::buildModel<kIOS<S>>(mesh);
    for (int i = 0; i < 40; ++i) hits += expectBruteForce(*model, hardRay(*model, S(2), random));
  }
  EXPECT_GT(hits, 200u);
  hits = 0;
  const auto model = scenes::buildModel<kIOS<S>>(scenes::bumpyTorus(200));
  for (const double far : {2.0, 1e3, 1e6, 1e9, 1e15, 1e30}) {
    for (int i = 0; i < 40; ++i) hits += expectBruteForce(*model, hardRay(*model, S(far), random));
  }
  EXPECT_GT(hits, 100u);
}

TYPED_TEST(RayQuery, BadInputIsRefused) {
  using S = TypeParam;
  const auto model = scenes::buildModel<kIOS<S>>(scenes::icosphere(1, 0));
  Ray<S> ray;
  ray.direction.setZero();
  EXPECT_THROW(firstHit(*model, kIdentity<S>, ray), std::invalid_argument);
  EXPECT_THROW(anyHit(*model, kIdentity<S>, ray), std::invalid_argument);
  EXPECT_THROW(allHits(*model, kIdentity<S>, ray), std::invalid_argument);
  EXPECT_THROW(firstHit(Model<S>(), kIdentity<S>, Ray<S>()), std::invalid_argument);
  fcl::Transform3<S> sheared = kIdentity<S>;
  sheared.linear()(0, 1) = S(0.1);
  EXPECT_THROW(firstHit(*model, sheared, Ray<S>()), std::invalid_argument);
  EXPECT_TRUE(firstHit(*model, kIdentity<S>, Ray<S>()));
  model->beginReplaceModel();
  EXPECT_THROW(firstHit(*model, kIdentity<S>, Ray<S>()), std::invalid_argument);
}

// A point beyond the largest finite t is no hit, and no hit is infinite.
TYPED_TEST(RayQuery, TinyDirections) {
  using S = TypeParam;
  const auto model = scenes::buildModel<kIOS<S>>(scenes::subdividedBox({2, 2, 2}, 1));
  Ray<S> ray;
  ray.origin = {S(-3), S(0.25), S(0.125)};
  ray.direction = {std::numeric_limits<S>::min(), 0, 0};
  const auto hit = firstHit(*model, kIdentity<S>, ray);
  ASSERT_TRUE(hit);
  EXPECT_EQ(hit->t, 2 / std::numeric_limits<S>::min());
  ray.direction[0] = std::numeric_limits<S>::denorm_min();
  EXPECT_FALSE(firstHit(*model, kIdentity<S>, ray));
  ray.origin[0] = -1;
  EXPECT_EQ(firstHit(*model, kIdentity<S>, ray)->t, 0);
}

}  // namespace
}  // namespace kios::testing
