// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Fits and queries of volumes, and of covers, raise no floating-point flags.
#include "fcl_kios/clearance.h"
#include "floating_point_flags.h"
#include "query/query_cases.h"
#include "scalars.h"

namespace kios::testing {
namespace {

KIOS_SCALAR_SUITE(VolumeTraps);

TYPED_TEST(VolumeTraps, FitsAndQueries) {
  using S = TypeParam;
  Flags flags;
  std::vector<kIOS<S>> volumes;
  for (const auto& [name, mesh] : allMeshes<S>()) {
    const MeshIn<S> shape(mesh);
    const int size = static_cast<int>(shape.vertices.size());
    for (const int n : {1, 2, 3, 6, size}) {
      if (n > size) continue;
      for (const FitMethod method : {FitMethod::kTuned, FitMethod::kMethodI,
                                     FitMethod::kMethodIAtAngle, FitMethod::kMethodII}) {
        for (const SphereCount count :
             {SphereCount::kByRatio, SphereCount::kAll, SphereCount::kByGain}) {
          FitOptions options(method);
          options.count = count;
          kIOS<S> volume;
          flags.during(name + ": fit", [&] { fit(shape.vertices.data(), n, volume, options); });
          if (n < 4 || count == SphereCount::kAll) volumes.push_back(volume);
        }
      }
    }
  }
  const auto poses = scenes::randomPoses(8, 1.5, 3);
  for (std::size_t i = 0; i < volumes.size(); ++i) {
    const kIOS<S>&a = volumes[i], &b = volumes[(7 * i + 3) % volumes.size()];
    const fcl::Transform3<S> X =
        i % 4 == 0 ? fcl::Transform3<S>::Identity() : poses[i % 8].template cast<S>();
    const RelativePose<S> X_AB(fcl::Transform3<S>::Identity(), X);
    flags.during("overlap, distance, +", [&] {
      overlap<S>(X.linear(), X.translation(), a, b);
      distance<S>(X.linear(), X.translation(), a, b);
      a.distance(a);
      (a + b).size();
    });
    flags.during("exactDistance", [&] { exactDistance<S>(a, b, X_AB); });
    flags.during("exactDistance to itself", [&] { exactDistance<S>(a, a); });
    flags.during("nearestPoint", [&] {
      nearestPoint<S>(a, a.center());
      nearestPoint<S>(a, b.center());
    });
  }
}

TYPED_TEST(VolumeTraps, Covers) {
  using S = TypeParam;
  Flags flags;
  for (const auto& [name, mesh] : unitMeshes()) {
    const auto model = modelOf<S>(mesh);
    for (const int level : {0, 2, 4}) {
      const Cover<S> cover(*model, level);
      auto poses = scenes::randomPoses(4, 2.5, 3);
      poses.push_back(fcl::Transform3d::Identity());
      for (const fcl::Transform3d& X : poses) {
        const RelativePose<S> X_AB(fcl::Transform3<S>::Identity(), X.cast<S>());
        flags.during(name + ": minimumClearance", [&] { minimumClearance<S>(cover, cover, X_AB); });
        flags.during(name + ": smoothClearance",
                     [&] { smoothClearance<S>(cover, cover, X_AB, 20); });
      }
    }
  }
}

}  // namespace
}  // namespace kios::testing
