// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tree/build_budget.h"

#include <cstddef>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

namespace kios::engine {
namespace {

TEST(BuildBudget, GrowsWithTheTriangles) {
  const BuildBudget budget;
  EXPECT_EQ(budget.remaining(0), 32);
  EXPECT_EQ(budget.remaining(1000), 4032);
  EXPECT_EQ(budget.remaining(std::size_t{1} << 40), 1 << 28) << "FCL's nodes count in ints";
}

TEST(BuildBudget, WhatIsChargedIsGone) {
  BuildBudget budget;
  budget.charge(4000);
  EXPECT_EQ(budget.remaining(1000), 32);
  EXPECT_EQ(budget.remaining(2000), 4032);
  budget.charge(100);
  EXPECT_EQ(budget.remaining(1000), 0) << "never negative";
}

TEST(BuildBudget, ExhaustedNothingRemains) {
  BuildBudget budget;
  budget.exhaust();
  EXPECT_EQ(budget.remaining(1000), 0);
  EXPECT_EQ(budget.remaining(std::size_t{1} << 40), 0);
}

TEST(BuildBudget, IsSpentAnewForTheNextTree) {
  BuildBudget budget;
  EXPECT_FALSE(budget.isSpent(12));
  budget.charge(80);
  EXPECT_TRUE(budget.isSpent(12));
  EXPECT_FALSE(budget.isSpent(13));
  budget.exhaust();
  EXPECT_FALSE(budget.isSpent(12));
  budget.charge(80);
  EXPECT_TRUE(budget.isSpent(12));
  EXPECT_EQ(budget.remaining(1000), 0) << "larger models get their next tree at once";
}

TEST(BuildBudget, ThreadsChargeOneBudget) {
  BuildBudget budget;
  std::vector<std::thread> threads;
  for (int i = 0; i < 4; ++i) {
    threads.emplace_back([&budget] {
      for (int k = 0; k < 1000; ++k) budget.charge(1);
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(budget.remaining(1000), 32);
}

}  // namespace
}  // namespace kios::engine
