// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Memory runs out at each allocation in turn: every call works, throws std::bad_alloc or returns
// FCL's code, and the models that it was given answer as before. The address sanitizer sees what is
// leaked or freed twice.

#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <functional>
#include <new>
#include <thread>

#include "fcl/mesh_cases.h"
#include "model/deform.h"

namespace {

std::atomic<long> live{0};       // allocations that are not freed
std::atomic<long> countdown{0};  // the allocation that counts it to 0 fails; 0 or less: none does

bool fails() { return countdown.load() > 0 && countdown.fetch_sub(1) == 1; }

void* allocate(std::size_t size) noexcept {
  if (fails()) return nullptr;
  void* const memory = std::malloc(size > 0 ? size : 1);
  if (memory) ++live;
  return memory;
}

void* allocate(std::size_t size, std::align_val_t alignment) noexcept {
  if (fails()) return nullptr;
  const auto unit = static_cast<std::size_t>(alignment);
  void* const memory = std::aligned_alloc(unit, (size + unit) / unit * unit);
  if (memory) ++live;
  return memory;
}

void release(void* memory) noexcept {
  if (!memory) return;
  --live;
  std::free(memory);
}

void* orThrow(void* memory) {
  if (!memory) throw std::bad_alloc();
  return memory;
}

}  // namespace

void* operator new(std::size_t n) { return orThrow(allocate(n)); }
void* operator new[](std::size_t n) { return orThrow(allocate(n)); }
void* operator new(std::size_t n, const std::nothrow_t&) noexcept { return allocate(n); }
void* operator new[](std::size_t n, const std::nothrow_t&) noexcept { return allocate(n); }
void* operator new(std::size_t n, std::align_val_t a) { return orThrow(allocate(n, a)); }
void* operator new[](std::size_t n, std::align_val_t a) { return orThrow(allocate(n, a)); }
void operator delete(void* p) noexcept { release(p); }
void operator delete[](void* p) noexcept { release(p); }
void operator delete(void* p, std::size_t) noexcept { release(p); }
void operator delete[](void* p, std::size_t) noexcept { release(p); }
void operator delete(void* p, std::align_val_t) noexcept { release(p); }
void operator delete[](void* p, std::align_val_t) noexcept { release(p); }
void operator delete(void* p, std::size_t, std::align_val_t) noexcept { release(p); }
void operator delete[](void* p, std::size_t, std::align_val_t) noexcept { release(p); }

namespace kios::testing {
namespace {

struct Outcome {
  bool done, failed;
};

/// Runs `work` whose n-th allocation fails. It returns false where it met one of FCL's codes.
template <typename Work>
Outcome run(int n, const Work& work) {
  bool done = false;
  countdown = n;
  try {
    done = work();
  } catch (const std::bad_alloc&) {
  }
  return {done, countdown.exchange(0) <= 0};
}

/// Runs `work` with n = 1, 2, 3 ... until it has memory enough. After each failure, `check`.
/// Returns how often it failed. Unless it may keep memory, none is left of a failure.
template <typename Work, typename Check>
int exhaust(const Work& work, const Check& check, bool keeps_memory = false) {
  for (int n = 1;; ++n) {
    const long before = live;
    const auto [done, failed] = run(n, work);
    if (!done) {
      EXPECT_TRUE(failed) << "refused, with memory";
      EXPECT_TRUE(live <= before || keeps_memory)
          << "allocation " << n << " failed, and something was leaked";
      check();
    }
    if (!failed || ::testing::Test::HasFailure()) return n - 1;
  }
}

class Memory : public ::testing::Test {
 protected:
  void expectRight(const Modeld& model, const std::vector<Vector3d>& vertices) const {
    const auto fresh = modelAlone({vertices, mesh_.triangles});
    EXPECT_EQ(distance(model), distance(*fresh));
    EXPECT_EQ(contacts(model), contacts(*fresh));
  }
  double distance(const Modeld& model) const {
    fcl::DistanceResultd result;
    return fcl::distance(&model, far_.X_WA, other_.get(), far_.X_WB, fcl::DistanceRequestd(),
                         result);
  }
  Pairs contacts(const Modeld& model) const {
    fcl::CollisionResultd result;
    fcl::collide(&model, near_.X_WA, other_.get(), near_.X_WB, fcl::CollisionRequestd(kAllContacts),
                 result);
    return contactPairs(result);
  }

  const Mesh mesh_ = scenes::bumpyTorus(300);
  const std::shared_ptr<Modeld> other_ = kiosModel(scenes::bumpyTorus(140));
  const Frame near_ = {Transform3d::Identity(), Transform3d(fcl::Translation3d(0.3, 0.2, 0.1))};
  const Frame far_ = {Transform3d::Identity(), Transform3d(fcl::Translation3d(4, 3, 2))};
};

TEST_F(Memory, MakeModelThrows) {
  const auto foreign = scenes::buildModel<fcl::OBBRSSd>(mesh_);
  EXPECT_GT(exhaust([&] { return makeModel(mesh_.vertices, mesh_.triangles) != nullptr; }, [] {}),
            10);
  EXPECT_GT(exhaust([&] { return toKIOS(*foreign) != nullptr; }, [] {}), 10);
}

/// Builds a model again until it is built: FCL's calls may be repeated where one of them failed.
TEST_F(Memory, BuildIsRepeated) {
  for (const bool one_by_one : {false, true}) {
    for (const int hint : {0, 1000}) {
      Modeld model;
      const auto build = [&] {
        while (true) {
          const int status = model.beginModel(hint, hint);
          if (status == fcl::BVH_ERR_MODEL_OUT_OF_MEMORY) return false;
          if (status == fcl::BVH_OK) break;
        }
        if (one_by_one) {
          for (std::size_t i = 0; i < 40; ++i) {
            const auto c = corners(mesh_, static_cast<std::intptr_t>(i));
            if (model.addTriangle(c[0], c[1], c[2]) != fcl::BVH_OK) return false;
          }
        }
        return model.addSubModel(mesh_.vertices, mesh_.triangles) == fcl::BVH_OK &&
               model.endModel() == fcl::BVH_OK;
      };
      int failures = 0;
      for (int n = 1;; ++n, ++failures) {
        const auto [built, failed] = run(n, build);
        ASSERT_TRUE(built || failed);
        if (!failed) break;
        if (built) continue;
        EXPECT_THROW(validate(model), std::invalid_argument);
      }
      EXPECT_GT(failures, 5);
      validate(model);
    }
  }
}

TEST_F(Memory, EndModelIsRepeated) {
  int failures = 0;
  for (int n = 1;; ++n, ++failures) {
    Modeld model;
    ASSERT_EQ(model.beginModel(), fcl::BVH_OK);
    ASSERT_EQ(model.addSubModel(mesh_.vertices, mesh_.triangles), fcl::BVH_OK);
    const auto [built, failed] = run(n, [&] { return model.endModel() == fcl::BVH_OK; });
    if (!failed) break;
    if (!built) {
      ASSERT_EQ(model.endModel(), fcl::BVH_OK);
    }
    expectRight(model, mesh_.vertices);
  }
  EXPECT_GT(failures, 5);
}

TEST_F(Memory, Queries) {
  using Query = std::function<void(const Modeld&)>;
  const Query queries[] = {
      [](const Modeld& model) { prepare(model); },
      [this](const Modeld& model) { distance(model); },
      [this](const Modeld& model) { contacts(model); },
      [this](const Modeld& model) {
        closerThan(model, far_.X_WA, *other_, far_.X_WB, 0.5);
        kios::distanceBracket(model, near_.X_WA, *other_, near_.X_WB);
      },
      [](const Modeld& model) {
        Rayd ray;
        ray.origin = Vector3d(0, 0, 5);
        ray.direction = Vector3d(0.2, 0, -1);
        firstHit(model, Transform3d::Identity(), ray);
        allHits(model, Transform3d::Identity(), ray);
      },
      [this](const Modeld& model) {
        const fcl::Boxd box(1, 2, 3);
        fcl::DistanceResultd result;
        fcl::distance(&model, far_.X_WA, &box, far_.X_WB, fcl::DistanceRequestd(true), result);
        fcl::CollisionResultd found;
        fcl::collide(&box, near_.X_WA, &model, near_.X_WB, fcl::CollisionRequestd(100, true),
                     found);
      },
      [this](const Modeld& model) {
        fcl::ContinuousCollisionResultd result;
        fcl::continuousCollide(&model, far_.X_WA, near_.X_WA, other_.get(), far_.X_WB, near_.X_WB,
                               fcl::ContinuousCollisionRequestd(), result);
      }};
  int failed = 0;
  for (const Query& query : queries) {
    const long idle = live;  // without the model, and what it may have prepared before a failure
    std::shared_ptr<Modeld> model = kiosModel(mesh_);
    const int failures = exhaust(
        [&] {
          query(*model);
          return true;
        },
        [&] {
          expectRight(*model, mesh_.vertices);
          model.reset();
          EXPECT_EQ(live, idle) << "something was leaked";
          model = kiosModel(mesh_);
        },
        /*keeps_memory=*/true);
    failed += failures;
  }
  EXPECT_GT(failed, 10);
}

TEST_F(Memory, RefitsAreRepeated) {
  const auto moved = swayed(mesh_, 0.7);
  for (const bool is_update : {false, true}) {
    for (const bool refit : {true, false}) {
      for (const bool bottomup : {true, false}) {
        for (int n = 1;; ++n) {
          const auto model = kiosModel(mesh_);
          prepare(*model);
          const auto [done, failed] = run(n, [&] {
            if (is_update) {
              return model->beginUpdateModel() == fcl::BVH_OK &&
                     model->updateSubModel(moved) == fcl::BVH_OK &&
                     model->endUpdateModel(refit, bottomup) == fcl::BVH_OK;
            }
            return model->beginReplaceModel() == fcl::BVH_OK &&
                   model->replaceSubModel(moved) == fcl::BVH_OK &&
                   model->endReplaceModel(refit, bottomup) == fcl::BVH_OK;
          });
          if (!failed) break;
          if (!done && model->build_state == fcl::BVH_BUILD_STATE_PROCESSED) {
            expectRight(*model, mesh_.vertices);  // nothing was begun
            continue;
          }
          if (!done) {
            const int status = is_update ? model->endUpdateModel(refit, bottomup)
                                         : model->endReplaceModel(refit, bottomup);
            ASSERT_EQ(status, fcl::BVH_OK);
          }
          expectRight(*model, moved);
        }
      }
    }
  }
}

// A model of which memory ran out while it was made right is refused, or right.
TEST_F(Memory, Invalidate) {
  std::shared_ptr<Modeld> model;
  const auto written = [&] {
    model = kiosModel(mesh_);
    const auto moved = swayed(mesh_, 0.7);
    std::copy(moved.begin(), moved.end(), model->vertices);
  };
  written();
  exhaust(
      [&] {
        verticesChanged(*model);
        return true;
      },
      [&] {
        if (model->build_state != fcl::BVH_BUILD_STATE_PROCESSED) {
          EXPECT_THROW(distance(*model), std::invalid_argument);
        }
        written();
      },
      /*keeps_memory=*/true);
  expectRight(*model, swayed(mesh_, 0.7));
}

TEST_F(Memory, Scenes) {
  const auto model = kiosModel(mesh_);
  const double expected = distance(*model);
  const auto scene = [&] {
    SceneDistance<double> objects;
    objects.add(model, far_.X_WA);
    const int mover = objects.add(other_, near_.X_WB);
    objects.add(std::make_shared<fcl::Sphered>(0.1), Transform3d(fcl::Translation3d(20, 0, 0)));
    objects.closestPair();
    objects.move(mover, far_.X_WB);
    objects.pairsWithin(0.1);
    return objects.closestPair()->distance == expected;
  };
  EXPECT_GT(exhaust(scene, [&] { expectRight(*model, mesh_.vertices); }), 10);
}

// A scene in which memory ran out is as good as before.
TEST_F(Memory, ScenesGoOn) {
  const auto model = kiosModel(mesh_);
  const double expected = distance(*model);
  const auto sphere = std::make_shared<fcl::Sphered>(0.1);
  for (int n = 1;; ++n) {
    SceneDistance<double> objects;
    objects.add(model, far_.X_WA);
    const int mover = objects.add(other_, near_.X_WB);
    const bool failed = run(n, [&] {
                          objects.closestPair();
                          objects.add(sphere, Transform3d(fcl::Translation3d(20, 0, 0)));
                          objects.move(mover, far_.X_WB);
                          objects.pairsWithin(20);
                          objects.clearances();
                          return true;
                        }).failed;
    objects.move(mover, far_.X_WB);
    const std::size_t count = objects.size();
    const auto closest = objects.closestPair();
    ASSERT_TRUE(closest.has_value()) << n;
    EXPECT_EQ(closest->distance, expected) << n;
    EXPECT_EQ(objects.clearances().size(), count * (count - 1) / 2) << n;
    EXPECT_EQ(objects.pairsWithin(100).size(), count * (count - 1) / 2) << n;
    if (failed) continue;
    EXPECT_EQ(count, 3U);
    EXPECT_GT(n, 10);
    break;
  }
}

// Nothing is left of a thread that built, refitted and asked when it ends.
TEST_F(Memory, ThreadsLeaveNothing) {
  const auto work = [this] {
    const auto model = kiosModel(mesh_);
    update(*model, swayed(mesh_, 1), true, true);
    distance(*model);
    kIOSd bv;
    kios::fit(mesh_.vertices.data(), static_cast<int>(mesh_.vertices.size()), bv);
  };
  std::thread(work).join();
  const long before = live;
  for (int i = 0; i < 10; ++i) std::thread(work).join();
  EXPECT_EQ(live, before);
}

}  // namespace
}  // namespace kios::testing
