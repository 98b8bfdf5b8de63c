// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <exception>
#include <iomanip>
#include <iostream>
#include <map>
#include <string>
#include <type_traits>
#include <vector>

#include "fcl_kios/fcl_kios.h"

// One set of checks for every volume. A failure over k-IOS fails the test; over FCL's volumes it is
// counted, and the table that a test program prints last shows it beside ours.

namespace kios::coverage {

struct Tally {
  long asked = 0, wrong = 0;
};

template <typename BV>
inline constexpr const char* kName = "?";
template <>
inline constexpr const char* kName<kIOSd> = "kIOSd";
template <>
inline constexpr const char* kName<kIOSf> = "kIOSf";
template <>
inline constexpr const char* kName<fcl::OBBRSSd> = "OBBRSSd";

template <typename BV>
inline constexpr bool kOurs = std::is_same_v<BV, kIOSd> || std::is_same_v<BV, kIOSf>;

class Table {
 public:
  static Table& get() {
    static Table table;
    return table;
  }
  Tally& at(const std::string& row, const std::string& volume) { return rows_[row][volume]; }
  bool empty() const { return rows_.empty(); }

  void print() const {
    const std::vector<std::string> volumes{kName<kIOSd>, kName<kIOSf>, kName<fcl::OBBRSSd>};
    std::cout << "\nwrong of asked" << std::string(32, ' ');
    for (const auto& volume : volumes) std::cout << std::setw(16) << volume;
    for (const auto& [row, tallies] : rows_) {
      std::cout << "\n" << std::left << std::setw(46) << row << std::right;
      for (const auto& volume : volumes) {
        const auto it = tallies.find(volume);
        std::cout << std::setw(16)
                  << (it == tallies.end() ? "-"
                                          : std::to_string(it->second.wrong) + " / " +
                                                std::to_string(it->second.asked));
      }
    }
    std::cout << "\n\n";
  }

 private:
  std::map<std::string, std::map<std::string, Tally>> rows_;
};

// Prints the table after the last test, in every program that includes this.
class Printer : public ::testing::Environment {
 public:
  void TearDown() override {
    if (!Table::get().empty()) Table::get().print();
  }
};
[[maybe_unused]] static const auto* const kPrinter =
    ::testing::AddGlobalTestEnvironment(new Printer);

/// Counts a check in its row; a wrong one over k-IOS fails the test.
template <typename BV>
void check(const std::string& row, bool right, const std::string& note = "") {
  Tally& tally = Table::get().at(row, kName<BV>);
  ++tally.asked;
  if (right) return;
  ++tally.wrong;
  if (kOurs<BV> && tally.wrong <= 5) {
    ADD_FAILURE() << row << " over " << kName<BV> << ": " << note;
  } else if (kOurs<BV>) {
    ADD_FAILURE();
  }
}

/// A defect of FCL's that this suite must see, or its checks prove nothing.
inline void expectSeen(const std::string& row) {
  const Tally& tally = Table::get().at(row, kName<fcl::OBBRSSd>);
  if (tally.asked == 0) GTEST_SKIP() << "the row was not run";
  EXPECT_GT(tally.wrong, 0) << row << ": is FCL mended?";
}

/// Ours, ours in float, and what FCL recommends.
using Volumes = ::testing::Types<kIOSd, kIOSf, fcl::OBBRSSd>;
using DoubleVolumes = ::testing::Types<kIOSd, fcl::OBBRSSd>;

/// What an answer may be off by for objects of extent `size` about the origin.
template <typename S>
double tolerance(double size) {
  return 128 * static_cast<double>(std::numeric_limits<S>::epsilon()) * size;
}

/// The mesh with vertices that S can hold.
template <typename S, typename Mesh>
Mesh rounded(Mesh mesh) {
  for (fcl::Vector3d& p : mesh.vertices) p = p.template cast<S>().template cast<double>();
  return mesh;
}

/// The pose with entries that S can hold.
template <typename S>
fcl::Transform3d rounded(const fcl::Transform3d& X) {
  return X.cast<S>().template cast<double>();
}

}  // namespace kios::coverage
