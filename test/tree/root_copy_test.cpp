// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tree/root_copy.h"

#include <algorithm>
#include <atomic>

#include <gtest/gtest.h>

#include "together.h"

namespace kios::engine {
namespace {

/// A root whose every number says of which state it is.
TreeRoot rootOf(std::uint64_t stamp) {
  TreeRoot root;
  const auto number = static_cast<float>(stamp);
  for (float* row : {root.root_box.x, root.root_box.y, root.root_box.z, root.root_box.half}) {
    std::fill_n(row, 4, number);
  }
  std::fill_n(root.origin, 3, static_cast<double>(stamp));
  root.reach = number;
  return root;
}

bool isOf(std::uint64_t stamp, const TreeRoot& root) {
  const TreeRoot expected = rootOf(stamp);
  const auto same = [](const float* a, const float* b) { return std::equal(a, a + 4, b); };
  const Box &a = root.root_box, &b = expected.root_box;
  return same(a.x, b.x) && same(a.y, b.y) && same(a.z, b.z) && same(a.half, b.half) &&
         std::equal(root.origin, root.origin + 3, expected.origin) && root.reach == expected.reach;
}

TEST(RootCopy, HoldsTheLastState) {
  RootCopy copy;
  TreeRoot root;
  EXPECT_FALSE(copy.read(1, root));
  copy.write(1, rootOf(1));
  EXPECT_TRUE(copy.read(1, root));
  EXPECT_TRUE(isOf(1, root));
  copy.write(2, rootOf(2));
  EXPECT_FALSE(copy.read(1, root));
  EXPECT_TRUE(copy.read(2, root));
  EXPECT_TRUE(isOf(2, root));
}

// Readers ask for states that are being written, before and after.
TEST(RootCopy, NoReaderSeesPartsOfTwoStates) {
  constexpr std::uint64_t kStates = 200000;
  RootCopy copy;
  std::atomic<std::uint64_t> begun{0};
  std::atomic<long long> seen{0}, torn{0};
  testing::together(4, [&](int thread) {
    if (thread == 0) {
      for (std::uint64_t stamp = 1; stamp <= kStates; ++stamp) {
        begun.store(stamp, std::memory_order_relaxed);
        copy.write(stamp, rootOf(stamp));
      }
      return;
    }
    for (std::uint64_t last = 0; last < kStates;) {
      last = begun.load(std::memory_order_relaxed);
      for (std::uint64_t stamp = last > 2 ? last - 2 : 1; stamp <= last + 1; ++stamp) {
        TreeRoot root;
        if (!copy.read(stamp, root)) continue;
        ++seen;
        torn += isOf(stamp, root) ? 0 : 1;
      }
    }
  });
  EXPECT_GT(seen, 0);
  EXPECT_EQ(torn, 0);
}

}  // namespace
}  // namespace kios::engine
