// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// usage: at_exit [late]. Models are built, refitted and asked in the destructors of statics and of
// thread_local objects, which run when all that was made after them is gone. "late": nothing of the
// library is used before.

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <thread>

#include "fcl_kios/fcl_kios.h"
#include "fcl_kios/paper.h"
#include "scenes/shapes.h"

namespace {

using fcl::Vector3d;

void require(bool holds, const char* what) {
  if (holds) return;
  std::printf("wrong: %s\n", what);
  std::fflush(stdout);
  std::_Exit(1);
}

double distanceTo(const kios::Modeld& a, const kios::Modeld& b) {
  fcl::Transform3d X = fcl::Transform3d::Identity();
  X.translation() = Vector3d(0.25, 0.125, 2);
  fcl::DistanceRequestd request;
  fcl::DistanceResultd result;
  const double d = fcl::distance(&a, fcl::Transform3d::Identity(), &b, X, request, result);
  fcl::CollisionRequestd contacts(10);
  fcl::CollisionResultd found;
  require(fcl::collide(&a, fcl::Transform3d::Identity(), &b, X, contacts, found) == 0, "a contact");
  require(fcl::collide(&a, fcl::Transform3d::Identity(), &a, fcl::Transform3d::Identity(), contacts,
                       found) > 0,
          "no contact");
  return d;
}

/// Checks that distances are equal, in whatever way a model came to its shape.
void useAll(int n) {
  const kios::scenes::Mesh sheet = kios::scenes::sheet(1, 1, n, n, 0);
  const auto& triangles = sheet.triangles;
  const auto& flat = sheet.vertices;
  const auto bent = kios::scenes::sheet(1, 1, n, n, 0.3).vertices;
  const auto other = kios::makeModel(flat, triangles);
  const double expected = distanceTo(*kios::makeModel(bent, triangles), *other);
  require(expected > 1 && expected < 2, "distance");
  for (const bool refit : {true, false}) {
    for (const bool bottomup : {true, false}) {
      const auto model = kios::makeModel(flat, triangles);
      model->beginReplaceModel();
      model->replaceSubModel(bent);
      require(model->endReplaceModel(refit, bottomup) == fcl::BVH_OK, "endReplaceModel");
      require(distanceTo(*model, *other) == expected, "distance after replacing");
      model->beginUpdateModel();
      model->updateSubModel(flat);
      model->endUpdateModel(refit, bottomup);
      model->beginUpdateModel();
      model->updateSubModel(bent);
      require(model->endUpdateModel(refit, bottomup) == fcl::BVH_OK, "endUpdateModel");
      require(distanceTo(*model, *other) == expected, "distance after updating");
      require(distanceTo(kios::Modeld(*model), *other) == expected, "distance of a copy");
    }
  }
  std::vector<fcl::Vector3f> floats;
  for (const Vector3d& p : bent) floats.push_back(p.cast<float>());
  require(kios::makeModel(floats, triangles)->getNumBVs() == 4 * n * n - 1, "model of floats");
  kios::kIOSd bv;
  kios::fit(bent.data(), static_cast<int>(bent.size()), bv, kios::FitMethod::kMethodI);
  require(bv.contain(bent.front()) && bv.contain(bent.back()), "fit");
  kios::SceneDistance<double> scene;
  scene.add(other, fcl::Transform3d::Identity());
  scene.add(std::make_shared<fcl::Sphered>(0.5), fcl::Transform3d(fcl::Translation3d(0, 0, 3)));
  require(scene.closestPair()->distance > 1, "scene");
  kios::Rayd ray;
  ray.origin = Vector3d(0.3, 0.4, 5);
  ray.direction = Vector3d(0, 0, -1);
  require(kios::firstHit(*other, fcl::Transform3d::Identity(), ray).has_value(), "ray");
}

int destroyed = 0;

/// Uses the library where it is destroyed.
struct User {
  const char* where;
  int expected_before;
  explicit User(const char* at, int before) : where(at), expected_before(before) {}
  ~User() {
    useAll(12);
    useAll(30);
    std::printf("used in the destructor of %s\n", where);
    std::fflush(stdout);
    require(destroyed++ == expected_before, "order");
  }
};

User in_static("a static object", 4);

void inThread(bool late, int before) {
  thread_local User in_thread("a thread_local object", before);
  (void)in_thread;
  if (!late) useAll(12);
}

}  // namespace

int main(int argc, char** argv) {
  const bool late = argc > 1 && std::string(argv[1]) == "late";
  std::thread(inThread, late, 0).join();
  std::thread(inThread, late, 1).join();
  static User in_main("a static object of main()", 3);
  inThread(late, 2);
  return 0;
}
