// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "scenario.h"
#include "triangle_contest.h"

namespace kios::bench {
namespace {

using Scores = std::array<TriangleScore, kTriangleKernels>;

struct Line {
  const char* name;
  Scores scores;
};

std::vector<Row> rowsOf(const Line& line, std::size_t pairs, const Options& options) {
  Row row;
  row.scenario = std::string("stability/") + line.name;
  row.triangles = 2;
  row.frames = pairs;
  row.seed = options.seed;
  row.extent = 1;
  std::vector<Row> rows;
  for (std::size_t query = 0; query < 2; ++query) {
    for (std::size_t k = 0; k < kTriangleKernels; ++k) {
      const auto& [max_error, zeros, nonzeros, verdicts, distance_ns, intersection_ns] =
          line.scores[k];
      row.bv = kTriangleKernelNames[k];
      row.query = query == 0 ? "distance" : "collide";
      row.times = {1e-3 * (query == 0 ? distance_ns : intersection_ns), std::nan(""), {}};
      row.errors = {};
      if (query == 0) row.errors.max_abs = max_error;
      row.errors.wrong = query == 0 ? zeros + nonzeros : verdicts;
      rows.push_back(row);
    }
  }
  return rows;
}

std::string both(std::size_t ours, std::size_t fcl) {
  return std::to_string(ours) + "/" + std::to_string(fcl);
}

void printHeading() {
  std::printf(
      "err/L: worst error of the distance by the diagonal L of each pair's bounding box.\n"
      "zeros, others: distances of 0 and not 0 that are wrong. verdicts: intersection tests that\n"
      "are wrong. ns: a call, and ours by FCL's. Each pair of columns: kios and FCL.\n");
  std::printf("%-28s %8s %8s %9s %9s %9s | %7s %7s %5s | %7s %7s %5s\n", "class", "err/L", "FCL",
              "zeros", "others", "verdicts", "dist ns", "FCL", "ratio", "test ns", "FCL", "ratio");
}

void print(const char* name, const Scores& scores) {
  const TriangleScore &ours = scores[kOurs], &fcl = scores[kFcl];
  std::printf("%-28s %8.1e %8.1e %9s %9s %9s | %7.0f %7.0f %5.2f | %7.0f %7.0f %5.2f\n", name,
              ours.max_error, fcl.max_error, both(ours.wrong_zeros, fcl.wrong_zeros).c_str(),
              both(ours.wrong_nonzeros, fcl.wrong_nonzeros).c_str(),
              both(ours.wrong_verdicts, fcl.wrong_verdicts).c_str(), ours.distance_ns,
              fcl.distance_ns, ours.distance_ns / fcl.distance_ns, ours.intersection_ns,
              fcl.intersection_ns, ours.intersection_ns / fcl.intersection_ns);
  std::fflush(stdout);
}

// Worst errors, sums of the wrong, means of the times.
Line totalOf(const std::vector<Line>& lines) {
  Line total = {"all", {}};
  const auto count = static_cast<double>(lines.size());
  for (const Line& line : lines) {
    for (std::size_t k = 0; k < kTriangleKernels; ++k) {
      const TriangleScore& from = line.scores[k];
      TriangleScore& to = total.scores[k];
      to.max_error = std::max(to.max_error, from.max_error);
      to.wrong_zeros += from.wrong_zeros;
      to.wrong_nonzeros += from.wrong_nonzeros;
      to.wrong_verdicts += from.wrong_verdicts;
      to.distance_ns += from.distance_ns / count;
      to.intersection_ns += from.intersection_ns / count;
    }
  }
  return total;
}

// Writes the results that do not depend on the machine.
void writeMarkdown(const std::filesystem::path& path, const std::vector<Line>& lines,
                   std::size_t pairs, std::uint64_t seed) {
  std::ofstream file(path);
  if (!file) throw std::runtime_error(path.string() + ": cannot be written");
  file << "<!-- Written by: kios_bench stability --frames " << pairs << " --seed " << seed
       << " --markdown docs/stability.md -->\n"
       << "# Worst errors of triangle distance and intersection\n\n"
       << "Each class holds " << pairs << " seeded pairs of triangles of doubles "
       << "(benchmarks/scenes/triangle_classes.h), judged by exact rational arithmetic. "
       << "Ours are `kios::triangleDistance` and `kios::trianglesIntersect`; FCL's are "
       << "`TriangleDistance::triDistance` and `Intersect::intersect_Triangle`.\n\n"
       << "- **error**: worst |distance - exact| by L, the diagonal of the pair's bounding box; "
       << "the bound is 16 eps = 3.6e-15.\n"
       << "- **wrong 0**, **wrong > 0**: distances of 0 where the triangles are apart, and others "
       << "where they intersect.\n"
       << "- **wrong verdict**: answers of the intersection test.\n\n"
       << "| class | error | FCL | wrong 0 | FCL | wrong > 0 | FCL | wrong verdict | FCL |\n"
       << "|---|--:|--:|--:|--:|--:|--:|--:|--:|\n";
  for (const Line& line : lines) {
    const TriangleScore &ours = line.scores[kOurs], &fcl = line.scores[kFcl];
    char errors[64];
    std::snprintf(errors, sizeof errors, "%.1e | %.1e", ours.max_error, fcl.max_error);
    file << "| " << line.name << " | " << errors << " | " << ours.wrong_zeros << " | "
         << fcl.wrong_zeros << " | " << ours.wrong_nonzeros << " | " << fcl.wrong_nonzeros << " | "
         << ours.wrong_verdicts << " | " << fcl.wrong_verdicts << " |\n";
  }
}

}  // namespace

void runStability(const Options& options, Report& report) {
  const int pairs = options.frames > 0 ? options.frames : (options.quick ? 40 : 2000);
  std::vector<Line> lines;
  printHeading();
  for (std::size_t c = 0; c < scenes::triangleClasses().size(); ++c) {
    const auto generated = scenes::trianglePairs(c, pairs, options.seed);
    lines.push_back({scenes::triangleClasses()[c].name, scoreKernels(generated, options.repeats)});
    print(lines.back().name, lines.back().scores);
    report.addUnprinted(rowsOf(lines.back(), generated.size(), options));
  }
  lines.push_back(totalOf(lines));
  print(lines.back().name, lines.back().scores);
  if (options.markdown) writeMarkdown(*options.markdown, lines, pairs, options.seed);
}

}  // namespace kios::bench
