// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "report.h"

namespace kios::bench {

/// Holds a row of ours beside the fastest of FCL's of the same scenario, query and setting.
struct Standing {
  Row ours;
  std::string best;  ///< `bv` of the fastest other
  double ratio = 0;  ///< its median time by ours: below 1, ours is slower
};

/// Returns what rows have in common that answer the same: scenario, query, and what was asked.
std::string words(const Row& row);

/// Returns whether the row is work that programs do: a mesh of 64 triangles or more takes part. No
/// code exists for others, which need only be right.
bool isRealWork(const Row& row);

/// Returns the ratio below which a row fails: 1, and 0.8 for a first contact with cold caches, most
/// of whose time is that of reading code.
double leastRatio(const Row& row);

/// Returns all rows of real work called `kios` that have a row of FCL's volumes beside them, by
/// their ratios, least first. AABB is no rival in building.
std::vector<Standing> byRatio(const std::vector<Row>& rows);

/// Returns how many are below leastRatio().
int countSlower(const std::vector<Standing>& standings);

/// Prints a line for each of the first `count`.
void printLeast(const std::vector<Standing>& standings, std::size_t count);

}  // namespace kios::bench
