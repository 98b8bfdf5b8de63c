// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "scenes/pqp_data.h"
#include "scenes/ur5_data.h"

namespace kios::bench {

/// Holds the options of the command line.
struct Options {
  std::string part;  // of a scenario whose parts run one by one; empty: all
  std::optional<std::filesystem::path> data;  // folder of the benchmark data
  std::vector<std::string> bvs;               // competitors, in the order of rows
  int frames = 0;                             // per scene; 0 = the scenario's own number
  int repeats = 5;
  int oracle_frames = 300;    // frames judged by the oracle, evenly chosen; 0 = all
  int max_triangles = 80000;  // of meshes of several sizes
  std::uint64_t seed = 1;
  std::optional<std::filesystem::path> robot;  // folder of meshes, for 'robots'
  bool quick = false;  // few frames and small meshes: a smoke test, not a measurement
};

/// Returns whether the command line asks for this part of the scenario, or for all.
inline bool wanted(const Options& options, const std::string& part) {
  return options.part.empty() || options.part == part;
}

/// Returns those of the sizes of meshes, in ascending order, that the command line allows.
inline std::vector<int> allowed(const Options& options, std::vector<int> sizes) {
  const int most = options.quick ? 1000 : options.max_triangles;
  sizes.erase(std::upper_bound(sizes.begin(), sizes.end(), most), sizes.end());
  return sizes;
}

/// Returns the data folder that the command line names, else the one that is found.
inline std::optional<std::filesystem::path> findData(const Options& options) {
  return options.data ? options.data : scenes::findData();
}

/// Returns the UR5 where its data is there.
inline std::optional<scenes::Robot> findUr5(const Options& options) {
  const auto data = findData(options);
  if (!data || !scenes::holdsUr5(*data)) return std::nullopt;
  return scenes::loadUr5(*data);
}

}  // namespace kios::bench
