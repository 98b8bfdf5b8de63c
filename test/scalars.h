// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

/// Declares a suite of TYPED_TESTs, which run for double and float as TypeParam.
#define KIOS_SCALAR_SUITE(Suite)                          \
  template <typename S>                                   \
  class Suite : public ::testing::Test {};                \
  using Suite##Scalars = ::testing::Types<double, float>; \
  TYPED_TEST_SUITE(Suite, Suite##Scalars)
