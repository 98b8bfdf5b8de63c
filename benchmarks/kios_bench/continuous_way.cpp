// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "continuous_way.h"

#include <fcl_kios/fcl_kios.h>

namespace kios::bench {

Way kiosWay(const std::string& name, const scenes::Mesh& mesh_a, const scenes::Mesh& mesh_b) {
  constexpr double kTimeError = 1e-4;
  const auto a = scenes::buildModel<kIOSd>(mesh_a), b = scenes::buildModel<kIOSd>(mesh_b);
  return {name, kTimeError, true, [a, b](const Motions& motions, Tests* work) {
            const fcl::ContinuousCollisionRequestd request(10, kTimeError);
            fcl::ContinuousCollisionResultd result;
            ContinuousCounts counts;
            firstContact(*a, motions.a.get(), *b, motions.b.get(), request, result, &counts);
            if (work) {
              work->bvs = work->bvs.value_or(0) + static_cast<double>(counts.volume_tests);
              work->leaves = work->leaves.value_or(0) + static_cast<double>(counts.leaf_tests);
            }
            return result;
          }};
}

}  // namespace kios::bench
