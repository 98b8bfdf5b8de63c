// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <string>

#include "scenes/random.h"
#include "volume/simd_targets.h"
//
#include <hwy/targets.h>  // NOLINT(llvm-include-order)

// Bounds of boxes and triangles in floats, asked on every instruction set.

namespace kios::testing {

class OnTargets : public ::testing::TestWithParam<std::int64_t> {
 protected:
  void SetUp() override { hwy::SetSupportedTargetsForTest(GetParam()); }
  void TearDown() override { hwy::SetSupportedTargetsForTest(0); }
};

inline std::string nameOfTarget(const ::testing::TestParamInfo<std::int64_t>& info) {
  return hwy::TargetName(info.param);
}

inline double anySize(scenes::Random& random, double least, double most) {
  return std::exp(random.uniform(std::log(least), std::log(most)));
}

}  // namespace kios::testing
