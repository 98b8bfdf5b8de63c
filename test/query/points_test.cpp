// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The nearest points of meshes, against integers over all triangles.
#include <gtest/gtest.h>

#include <pthread.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <string>
#include <system_error>
#include <thread>
#include <vector>

#include "fcl/expect_refused.h"
#include "fcl/mesh_cases.h"
#include "not_finite.h"
#include "query/hard_points.h"
#include "scalars.h"
#include "scenes/rational_oracle.h"
#include "scenes/triangle_pair.h"
#include "shapes.h"

namespace kios::testing {
namespace {

using Columns = Eigen::Matrix3Xd;

/// Small meshes of many kinds, of extent about 1; mesh_fuzz has others.
std::vector<NamedMesh> nastyMeshes() {
  return {{"torus", scenes::bumpyTorus(160)},
          {"poles", scenes::uvSphere(1, 6, 20)},
          {"soup", scenes::randomSoup(120, 1, 1e-4, 2, 3)},
          {"points, segments, triangles", degenerateMesh(90, 3, 1)},
          {"point", scenes::singleTriangle({1, 2, 3}, {1, 2, 3}, {1, 2, 3})}};
}

struct Answers {
  explicit Answers(Eigen::Index n) : distances(n), nearest(3, n), triangles(n) {}
  Eigen::VectorXd distances;
  Columns nearest;
  Eigen::VectorXi triangles;
  bool operator==(const Answers& o) const {
    return distances == o.distances && triangles == o.triangles &&
           (nearest.array() == o.nearest.array() || nearest.array().isNaN()).all();
  }
};

template <typename S>
Answers nearestOf(const Model<S>& model, const Columns& points, const PointRequest& request = {}) {
  Answers a(points.cols());
  nearestPoints(model, points, a.distances, a.nearest, a.triangles, request);
  return a;
}

template <typename S>
TriangleVerticesd cornersOf(const Model<S>& model, int triangle) {
  const fcl::Triangle& t = model.tri_indices[triangle];
  const auto corner = [&](int k) -> Pointd { return model.vertices[t[k]].template cast<double>(); };
  return {corner(0), corner(1), corner(2)};
}

long double distanceOfBox(const Vector3d& p, const TriangleVerticesd& t) {
  long double square = 0;
  for (int c = 0; c < 3; ++c) {
    const auto [low, high] = std::minmax({t[0][c], t[1][c], t[2][c]});
    const long double off = static_cast<long double>(p[c]) - std::clamp(p[c], low, high);
    square += off * off;
  }
  return std::sqrt(square);
}

/// Judges all answers, of a mesh as the model holds it.
template <typename S>
void expectNearest(const Model<S>& model, const Columns& points, const std::string& name) {
  const Answers answers = nearestOf(model, points);
  double largest = 0;
  for (int v = 0; v < model.num_vertices; ++v) {
    largest = std::max(largest, double{model.vertices[v].cwiseAbs().maxCoeff()});
  }
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    const Vector3d p = points.col(i);
    long double exact = kInfinity;
    for (int t = 0; t < model.num_tris; ++t) {
      const TriangleVerticesd corners = cornersOf(model, t);
      // By boxes first, as integers take long.
      if (distanceOfBox(p, corners) > exact + 1e-12L * (exact + largest)) continue;
      exact = std::min(exact, scenes::rationalDistance(p, corners));
    }
    const TriangleVerticesd near = cornersOf(model, answers.triangles[i]);
    const long double bound = 16 * 0x1p-52L * scenes::extent({{p, p, p}, near}) + 1e-310L;
    ASSERT_LE(std::abs(answers.distances[i] - exact), bound)
        << name << ", at " << p.transpose() << ", " << answers.distances[i];
    ASSERT_EQ(answers.distances[i] == 0, exact == 0) << name;
    ASSERT_LE(scenes::rationalDistance(answers.nearest.col(i), near),
              bound + 16 * 0x1p-52L * largest);
    const NearestPoint one = nearestPoint(model, p);
    ASSERT_TRUE(one.distance == answers.distances[i] && one.triangle == answers.triangles[i]);
  }
}

KIOS_SCALAR_SUITE(NearestPoints);

TYPED_TEST(NearestPoints, AllTrianglesInIntegers) {
  using S = TypeParam;
  const bool wide = sizeof(S) == sizeof(double);
  struct Place {
    double scale;
    Vector3d offset;
  };
  const std::vector<Place> places = {{1, {0, 0, 0}},
                                     {1, Vector3d(1, -1, 0.5) * (wide ? 1e9 : 1e3)},
                                     {1e-30, {0, 0, 0}},
                                     {1e30, {0, 0, 0}},
                                     {wide ? 1e-200 : 1e-18, {0, 0, 0}},
                                     {wide ? 1e200 : 1e18, {0, 0, 0}}};
  for (const auto& [name, mesh] : nastyMeshes()) {
    for (const Place& place : places) {
      const Mesh placed = transformed(mesh, place.scale, place.offset);
      const auto model = scenes::buildModel<kIOS<S>>(placed);
      expectNearest(*model, pointsAbout(placed, 48, place.scale, place.offset, 11),
                    name + ", scale " + std::to_string(std::log10(place.scale)));
    }
  }
}

TEST(NearestPointsOfMeshes, TheFirstOfEqualTriangles) {
  Mesh mesh = scenes::bumpyTorus(120);
  const std::size_t count = mesh.triangles.size();
  for (std::size_t i = 0; i < count; ++i) mesh.triangles.push_back(mesh.triangles[i]);
  const Columns points = pointsAbout(mesh, 300, 1, {0, 0, 0}, 2);
  const Answers answers = nearestOf(*kiosModel(mesh), points);
  EXPECT_LT(answers.triangles.maxCoeff(), static_cast<int>(count));
  for (Eigen::Index i = 0; i < points.cols(); i += 6) {  // vertices of the mesh
    int first = 0;
    const auto holds = [&](const fcl::Triangle& t) {
      for (int k = 0; k < 3; ++k) {
        if (mesh.vertices[t[k]] == points.col(i)) return true;
      }
      return false;
    };
    while (!holds(mesh.triangles[static_cast<std::size_t>(first)])) ++first;
    ASSERT_EQ(answers.triangles[i], first);
  }
}

TEST(NearestPointsOfMeshes, OrderThreadsAndPosesChangeNothing) {
  const Mesh mesh = scenes::bumpyTorus(2000);
  const auto model = kiosModel(mesh);
  const Columns points = pointsAbout(mesh, 3000, 1, {0, 0, 0}, 5);
  const Answers expected = nearestOf(*model, points);
  PointRequest request;
  for (const int threads : {0, 2, 3, 7}) {
    request.threads = threads;
    EXPECT_TRUE(nearestOf(*model, points, request) == expected);
  }
  const Answers reversed = nearestOf(*model, points.rowwise().reverse());
  EXPECT_EQ(reversed.distances.reverse(), expected.distances);
  EXPECT_EQ(reversed.triangles.reverse(), expected.triangles);

  request.X_WM.linear() << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  request.X_WM.translation() << 8, -4, 2;
  const Columns placed = (request.X_WM.linear() * points).colwise() + request.X_WM.translation();
  const Answers posed = nearestOf(*model, placed, request);
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    ASSERT_NEAR(posed.distances[i], expected.distances[i],
                1e-14 * (1 + expected.distances[i]) + 1e-15 * points.col(i).norm());
    ASSERT_LE((posed.nearest.col(i) - placed.col(i)).norm(),
              posed.distances[i] * (1 + 1e-14) + 1e-13);
  }
}

TEST(NearestPointsOfMeshes, WithinLeavesOutTheRestAlone) {
  const Mesh mesh = scenes::bumpyTorus(800);
  const auto model = kiosModel(mesh);
  const Columns points = pointsAbout(mesh, 600, 1, {0, 0, 0}, 5);
  const Answers all = nearestOf(*model, points);
  PointRequest request;
  for (const double within : {0.0, 1e-9, 0.1, 0.5}) {
    request.within = within;
    const Answers some = nearestOf(*model, points, request);
    for (Eigen::Index i = 0; i < points.cols(); ++i) {
      const bool near = all.distances[i] <= within;
      ASSERT_EQ(some.distances[i], near ? all.distances[i] : kInfinity);
      ASSERT_EQ(some.triangles[i], near ? all.triangles[i] : -1);
      ASSERT_EQ(some.nearest.col(i).hasNaN(), !near);
    }
  }
}

/// While it lives, few threads can start beside those that run, or none.
class FewThreads {
 public:
  explicit FewThreads(std::size_t stacks) {
    pthread_getattr_default_np(&before_);
    getrlimit(RLIMIT_AS, &limit_);
    pthread_attr_t large = before_;
    constexpr std::size_t kStack = std::size_t{1} << 33U;
    pthread_attr_setstacksize(&large, kStack);
    pthread_setattr_default_np(&large);
    std::size_t pages = 0;
    std::ifstream("/proc/self/statm") >> pages;
    rlimit few = limit_;
    few.rlim_cur =
        pages * static_cast<std::size_t>(sysconf(_SC_PAGESIZE)) + kStack * stacks + kStack / 2;
    setrlimit(RLIMIT_AS, &few);
  }
  FewThreads(const FewThreads&) = delete;
  ~FewThreads() {
    setrlimit(RLIMIT_AS, &limit_);
    pthread_setattr_default_np(&before_);
  }

 private:
  pthread_attr_t before_;
  rlimit limit_;
};

std::size_t threadsThatStart(std::size_t most) {
  std::vector<std::thread> threads;
  try {
    while (threads.size() < most) threads.emplace_back([] {});
  } catch (const std::system_error&) {
  }
  for (std::thread& thread : threads) thread.join();
  return threads.size();
}

TEST(NearestPointsOfMeshes, ThreadsThatCannotStart) {
  const Mesh mesh = scenes::icosphere(1, 2);
  const auto model = kiosModel(mesh);
  const Columns points = pointsAbout(mesh, 20000, 1, {0, 0, 0}, 5);
  const Answers expected = nearestOf(*model, points);
  PointRequest request;
  request.threads = 60;
  for (const std::size_t stacks : {0U, 3U}) {
    Answers answers(points.cols());
    {
      const FewThreads few(stacks);
      ASSERT_EQ(threadsThatStart(60), stacks);
      nearestPoints(*model, points, answers.distances, answers.nearest, answers.triangles, request);
    }
    EXPECT_TRUE(answers == expected);
  }
}

TEST(NearestPointsOfMeshes, BadArgumentsAreNamed) {
  const auto model = kiosModel(scenes::icosphere(1, 1));
  Columns points = Columns::Zero(3, 4);
  const auto ask = [&](const PointRequest& request = {}) { nearestOf(*model, points, request); };
  for (const double bad : {kNaN, kInfinity, -kInfinity, 0x1p1001}) {
    points(1, 2) = bad;
    expectRefused([&] { ask(); }, "column 2");
    expectRefused([&] { nearestPoint(*model, points.col(2)); }, "");
  }
  points(1, 2) = 0;
  PointRequest request;
  for (const double bad : {-1.0, kNaN}) {
    request.within = bad;
    expectRefused([&] { ask(request); }, "within");
  }
  request = {};
  request.threads = -1;
  expectRefused([&] { ask(request); }, "threads");
  request = {};
  request.X_WM.linear() *= 2;
  expectRefused([&] { ask(request); }, "");
  Answers few(3);
  Eigen::VectorXd distances(4);
  expectRefused([&] { nearestPoints(*model, points, distances, few.nearest, few.triangles); },
                "nearest points has room for 3");
  EXPECT_EQ(nearestOf(*model, Columns(3, 0)).distances.size(), 0);
  model->beginReplaceModel();
  EXPECT_THROW(nearestPoint(*model, {0, 0, 0}), std::invalid_argument);
}

}  // namespace
}  // namespace kios::testing
