// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "library.h"

#include "continuous_way.h"
#include "crowd.h"
#include "mesh_set_of.h"
#include "motion_set.h"
#include "scene_set.h"

extern "C" const kios::bench::Library kios_bench_library = {
    []() -> std::unique_ptr<kios::bench::MeshSet> {
      return std::make_unique<kios::bench::KiosSet>(nullptr);
    },
    [] { return kios::bench::makeKiosTree(nullptr); },
    []() -> std::unique_ptr<kios::bench::Crowd> {
      return std::make_unique<kios::bench::CrowdOf<kios::kIOSd, kios::bench::KiosCalls>>();
    },
    kios::bench::makeKiosScene,
    kios::bench::makeCertified,
    kios::bench::kiosWay};
