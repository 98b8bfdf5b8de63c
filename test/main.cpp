// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
//
// usage: ROOM_tests [--only NAME] [GoogleTest's options]
// Runs all tests of a room, or those of NAME_test.cpp.

#include <gtest/gtest.h>

#include <cstdio>
#include <string>
#include <vector>

namespace {

bool endsWith(const std::string& text, const std::string& end) {
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

/// Returns the filter of GoogleTest that selects the tests of a file; empty if there are none.
std::string filterOf(const std::string& file) {
  std::string filter;
  const auto& all = *::testing::UnitTest::GetInstance();
  for (int i = 0; i < all.total_test_suite_count(); ++i) {
    const auto& suite = *all.GetTestSuite(i);
    for (int k = 0; k < suite.total_test_count(); ++k) {
      const auto& test = *suite.GetTestInfo(k);
      if (!endsWith(std::string("/") + test.file(), "/" + file)) continue;
      filter += std::string(suite.name()) + "." + test.name() + ":";
    }
  }
  return filter;
}

}  // namespace

int main(int argc, char** argv) {
  ::testing::InitGoogleTest(&argc, argv);
  if (argc == 1) return RUN_ALL_TESTS();
  if (argc != 3 || std::string(argv[1]) != "--only") {
    std::fprintf(stderr, "usage: %s [--only NAME] [GoogleTest's options]\n", argv[0]);
    return 2;
  }
  const std::string filter = filterOf(std::string(argv[2]) + "_test.cpp");
  if (filter.empty()) {
    std::fprintf(stderr, "%s: %s_test.cpp has no tests here\n", argv[0], argv[2]);
    return 2;
  }
  // A filter of GoogleTest's, also the one that it gives itself in a death test, says more.
  if (::testing::GTEST_FLAG(filter) == "*") ::testing::GTEST_FLAG(filter) = filter;
  return RUN_ALL_TESTS();
}
