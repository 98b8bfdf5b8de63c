// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "least.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>

namespace kios::bench {
namespace {

// Boxes along the axes of the model are built in a pass over the vertices, and bound turned or near
// content badly: who asks for those doesn't compare their builds.
bool isRival(const Row& row) {
  return row.bv.rfind("fcl_", 0) == 0 && (row.query != "build" || row.bv != "fcl_aabb");
}

bool isTimed(const Row& row) {
  return std::isfinite(row.times.median_us) && row.times.median_us > 0;
}

}  // namespace

std::string words(const Row& row) {
  std::string words = row.scenario + " " + row.query;
  const auto add = [&words](const char* name, const Maybe& value) {
    if (!value || (*value == 0 && std::string(name) != "threshold")) return;
    char digits[32];
    std::snprintf(digits, sizeof digits, " %s %g", name, *value);
    words += digits;
  };
  add("threshold", row.asked.threshold);
  add("rel_err", row.asked.rel_err);
  add("abs_err", row.asked.abs_err);
  add("budget", row.asked.budget);
  return words;
}

bool isRealWork(const Row& row) {
  constexpr std::size_t kFew = 64;
  return row.largest_mesh == 0 || row.largest_mesh >= kFew;
}

double leastRatio(const Row& row) {
  constexpr char kCold[] = "/cold";
  const std::size_t at = row.scenario.rfind(kCold);
  const bool cold = at != std::string::npos && at + sizeof kCold - 1 == row.scenario.size();
  return cold && row.query == "collide" ? 0.8 : 1;
}

std::vector<Standing> byRatio(const std::vector<Row>& rows) {
  std::map<std::string, const Row*> best;
  for (const Row& row : rows) {
    if (!isRival(row) || !isTimed(row)) continue;
    const Row*& fastest = best[words(row)];
    if (!fastest || row.times.median_us < fastest->times.median_us) fastest = &row;
  }
  std::vector<Standing> standings;
  for (const Row& row : rows) {
    if (row.bv != "kios" || !isTimed(row) || !isRealWork(row)) continue;
    const auto found = best.find(words(row));
    if (found == best.end()) continue;
    standings.push_back(
        {row, found->second->bv, found->second->times.median_us / row.times.median_us});
  }
  std::stable_sort(standings.begin(), standings.end(),
                   [](const Standing& a, const Standing& b) { return a.ratio < b.ratio; });
  return standings;
}

int countSlower(const std::vector<Standing>& standings) {
  return static_cast<int>(std::count_if(
      standings.begin(), standings.end(),
      [](const Standing& standing) { return standing.ratio < leastRatio(standing.ours); }));
}

void printLeast(const std::vector<Standing>& standings, std::size_t count) {
  count = std::min(count, standings.size());
  std::printf("the %zu least of %zu ratios of the fastest other's time to ours:\n", count,
              standings.size());
  for (std::size_t i = 0; i < count; ++i) {
    const Standing& standing = standings[i];
    const Row& ours = standing.ours;
    std::printf("%8.3f  %s: %.3f us, %s %.3f us\n", standing.ratio, words(ours).c_str(),
                ours.times.median_us, standing.best.c_str(), standing.ratio * ours.times.median_us);
  }
}

}  // namespace kios::bench
