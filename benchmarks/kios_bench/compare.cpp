// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "compare.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <string>
#include <utility>

#include "least.h"
#include "library.h"

namespace kios::bench {
namespace {

struct Pair {
  const Row *before, *now;
  double ratio;

  /// Noise seldom makes both the median and the minimum slower.
  double best() const { return std::max(ratio, before->times.min_us / now->times.min_us); }
  bool changed() const {
    return (now->changes && now->changes->answers > 0) ||
           now->errors.wrong.value_or(0) > before->errors.wrong.value_or(0);
  }
};

std::vector<Pair> pairsOf(const std::vector<Row>& rows) {
  std::map<std::pair<std::string, std::string>, const Row*> before;
  for (const Row& row : rows) {
    if (isBefore(row.bv)) before[{row.bv, words(row)}] = &row;
  }
  std::vector<Pair> pairs;
  for (const Row& row : rows) {
    const auto found = before.find({row.bv + kBefore, words(row)});
    if (found == before.end() || !isRealWork(row)) continue;
    const std::vector<double>&theirs = found->second->times.repeats_us,
          &ours = row.times.repeats_us;
    std::vector<double> ratios;
    for (std::size_t i = 0; i < std::min(theirs.size(), ours.size()); ++i) {
      ratios.push_back(theirs[i] / ours[i]);
    }
    if (!ratios.empty()) pairs.push_back({found->second, &row, median(ratios)});
  }
  return pairs;
}

constexpr char kLine[] = "%-48s %10s %10s %6s %6s  %7s %7s  %15s %15s %13s  %s\n";

void printHeading() {
  std::printf(kLine, "row", "before us", "now us", "ratio", "of min", "before", "x OBBR.", "tests",
              "leaves", "exact", "changed");
}

std::string both(const Maybe& before, const Maybe& now) {
  return now ? cell(before, "%.5g") + ">" + cell(now, "%.5g") : "-";
}

void print(const Pair& pair) {
  const Row &before = *pair.before, &now = *pair.now;
  std::string changed = "-";
  if (now.changes) {
    changed =
        std::to_string(now.changes->answers) + " (bits " + std::to_string(now.changes->bits) + ")";
  }
  if (const auto wrong = now.errors.wrong.value_or(0); wrong > 0) {
    changed += ", wrong " + std::to_string(wrong);
  }
  const std::string name = words(now) + (now.bv == kOurs ? "" : " " + now.bv);
  std::printf(kLine, name.c_str(), cell(before.times.median_us, "%.3f").c_str(),
              cell(now.times.median_us, "%.3f").c_str(), cell(pair.ratio, "%.3f").c_str(),
              cell(before.times.min_us / now.times.min_us, "%.3f").c_str(),
              cell(before.times.ratio_to_fcl_obbrss, "%.2f").c_str(),
              cell(now.times.ratio_to_fcl_obbrss, "%.2f").c_str(),
              both(before.tests.bvs, now.tests.bvs).c_str(),
              both(before.tests.leaves, now.tests.leaves).c_str(),
              both(before.tests.exact, now.tests.exact).c_str(), changed.c_str());
}

}  // namespace

void printCompared(const std::vector<Row>& rows) {
  const std::vector<Pair> pairs = pairsOf(rows);
  if (pairs.empty()) return;
  printHeading();
  for (const Pair& pair : pairs) print(pair);
  std::printf("\n");
}

int summarize(const std::vector<Row>& rows, std::size_t shown) {
  std::vector<Pair> pairs = pairsOf(rows);
  std::stable_sort(pairs.begin(), pairs.end(),
                   [](const Pair& a, const Pair& b) { return a.best() < b.best(); });
  double logarithms = 0;
  int failed = 0, changed = 0;
  for (const Pair& pair : pairs) {
    logarithms += std::log(pair.ratio);
    changed += pair.changed() ? 1 : 0;
    failed += pair.best() < kLeastRatio || pair.changed() ? 1 : 0;
  }
  std::printf("the least of %zu ratios; their mean is %.3f, below %.1f or changed are %d:\n",
              pairs.size(), std::exp(logarithms / static_cast<double>(pairs.size())), kLeastRatio,
              failed);
  printHeading();
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    if (i < shown || pairs[i].changed()) print(pairs[i]);
  }
  return failed;
}

}  // namespace kios::bench
