// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The memory that builds and queries take, as docs/guarantees.md states it: the stack of a thread
// that runs on a painted one, and what is allocated.
#include <gtest/gtest.h>
#include <pthread.h>

#include <atomic>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <new>

#include "fcl/partners.h"
#include "scenes/cad_shapes.h"

namespace {
std::atomic<std::size_t> allocated{0};
}

__attribute__((noinline)) void* operator new(std::size_t size) {
  allocated += size;
  if (void* const p = std::malloc(size)) return p;
  throw std::bad_alloc();
}
__attribute__((noinline)) void operator delete(void* p) noexcept { std::free(p); }
__attribute__((noinline)) void operator delete(void* p, std::size_t) noexcept { std::free(p); }

namespace kios::testing {
namespace {

constexpr std::size_t kStack = std::size_t{4} << 20;
constexpr std::uint64_t kPaint = 0xA5C3A5C35A3C5A3CU;

void* call(void* ask) {
  (*static_cast<const std::function<void()>*>(ask))();
  return nullptr;
}

/// Returns the bytes of a thread's stack that were written.
std::size_t stackOfThread(const std::function<void()>& ask) {
  std::vector<std::uint64_t> stack(kStack / sizeof(std::uint64_t), kPaint);
  pthread_attr_t attributes;
  pthread_attr_init(&attributes);
  pthread_attr_setstack(&attributes, stack.data(), kStack);
  pthread_t thread;
  EXPECT_EQ(pthread_create(&thread, &attributes, &call, const_cast<std::function<void()>*>(&ask)),
            0);
  pthread_join(thread, nullptr);
  pthread_attr_destroy(&attributes);
  std::size_t untouched = 0;
  while (untouched < stack.size() && stack[untouched] == kPaint) ++untouched;
  return kStack - untouched * sizeof(std::uint64_t);
}

/// Those that a call takes beyond what a thread does, in KiB.
double stackOf(const std::string& name, const std::function<void()>& ask) {
  const std::size_t empty = stackOfThread([] {});
  const double kib = static_cast<double>(stackOfThread(ask) - empty) / 1024;
  std::printf("%-28s %.1f KiB\n", name.c_str(), kib);
  return kib;
}

TEST(Memory, StackOfBuildsAndQueries) {
  const Mesh mesh = scenes::bumpyTorus(5000);
  const auto torus = kiosModel(mesh), strips = kiosModel(scenes::stripCylinder(400, 0.6, 0.001));
  const Transform3d here = Transform3d::Identity();
  constexpr double kQuery = 96, kBuild = 16;
  EXPECT_LE(stackOf("endModel", [&] { kiosModel(scenes::bumpyTorus(5001)); }), kBuild);
  EXPECT_LE(stackOf("prepare", [&] { prepare(*torus); }), kBuild);
  for (const double far : {0.0, 0.7, 3.0}) {
    const Transform3d X(Eigen::Translation3d(far, 0.1, 0.2));
    EXPECT_LE(stackOf("fcl::distance",
                      [&] {
                        fcl::DistanceResultd result;
                        fcl::distance(torus.get(), here, strips.get(), X,
                                      fcl::DistanceRequestd(true), result);
                      }),
              kQuery);
    EXPECT_LE(stackOf("kios::distanceBracket, closerThan",
                      [&] {
                        kios::distanceBracket(*torus, here, *strips, X);
                        closerThan(*torus, here, *strips, X, 0.1);
                      }),
              kQuery);
    for (const std::size_t most : {1, 1000}) {
      EXPECT_LE(stackOf("fcl::collide",
                        [&, most] {
                          fcl::CollisionResultd result;
                          fcl::collide(torus.get(), here, strips.get(), X,
                                       fcl::CollisionRequestd(most, true), result);
                        }),
                kQuery);
    }
    for (const auto& [name, other] : partners()) {
      EXPECT_LE(stackOf(name,
                        [&, &partner = other] {
                          fcl::DistanceResultd result;
                          fcl::distance(torus.get(), here, partner.get(), X,
                                        fcl::DistanceRequestd(true), result);
                          fcl::CollisionResultd contacts;
                          fcl::collide(torus.get(), here, partner.get(), X,
                                       fcl::CollisionRequestd(10, true), contacts);
                        }),
                kQuery);
    }
    Rayd ray;
    ray.origin = Vector3d(-3, 0.9, far);
    EXPECT_LE(stackOf("allHits", [&] { allHits(*torus, here, ray); }), kQuery);
    EXPECT_LE(stackOf("continuousCollide",
                      [&] {
                        fcl::ContinuousCollisionResultd result;
                        fcl::continuousCollide(torus.get(), here, X, strips.get(), X, here,
                                               fcl::ContinuousCollisionRequestd(), result);
                      }),
              kQuery);
  }
  const auto solid = kiosModel(mesh);
  EXPECT_LE(stackOf("markSolid", [&] { markSolid(*solid); }), kBuild);
  EXPECT_LE(
      stackOf(
          "penetration",
          [&] { penetration(*solid, here, *solid, Transform3d(Eigen::Translation3d(0.5, 0, 0))); }),
      kQuery);
  Linkage arm;
  Joint joint;
  joint.type = JointType::kRevolute;
  arm.addBody(arm.addLink(-1, joint), torus);
  arm.addBody(-1, strips, Transform3d(Eigen::Translation3d(1.9, 0, 0)));
  EXPECT_LE(stackOf("checkMotion",
                    [&] {
                      checkMotion(arm, Eigen::VectorXd::Constant(1, 0),
                                  Eigen::VectorXd::Constant(1, 3));
                    }),
            kQuery);
  SceneDistanced scene;
  for (int i = 0; i < 20; ++i) scene.add(torus, Transform3d(Eigen::Translation3d(2.5 * i, 0, 0)));
  EXPECT_LE(stackOf("scene", [&] { scene.closestPair(); }), kQuery);
}

TEST(Memory, HotQueriesOfPreparedMeshesAllocateLittle) {
  const auto a = kiosModel(scenes::bumpyTorus(5000)), b = kiosModel(scenes::bumpyTorus(3000));
  std::size_t most_of_distance = 0, most_of_verdict = 0;
  int distances_that_allocate = 0;
  const auto poses = scenes::randomPoses(400, 2, 3);
  for (const Transform3d& X : poses) {
    const Transform3d here = Transform3d::Identity();
    fcl::DistanceResultd result;
    const fcl::DistanceRequestd request;
    const std::size_t before = allocated;
    fcl::distance(a.get(), here, b.get(), X, request, result);
    const std::size_t after = allocated;
    fcl::CollisionResultd contacts;
    fcl::collide(a.get(), here, b.get(), X, fcl::CollisionRequestd(), contacts);
    most_of_distance = std::max(most_of_distance, after - before);
    most_of_verdict = std::max<std::size_t>(most_of_verdict, allocated - after);
    distances_that_allocate += after > before ? 1 : 0;
  }
  std::printf("a distance: %zu bytes at most, in %d of 400 any; a verdict: %zu bytes at most\n",
              most_of_distance, distances_that_allocate, most_of_verdict);
  EXPECT_LE(most_of_distance, 64 * 1024U);
  EXPECT_LE(distances_that_allocate, 40);
  EXPECT_LE(most_of_verdict, 1024U);  // the contact itself
}

}  // namespace
}  // namespace kios::testing
