// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#include "report.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <stdexcept>

#include <nlohmann/json.hpp>

namespace kios::bench {
namespace {

using Json = nlohmann::ordered_json;

Json finite(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json orNull(const std::optional<double>& value) { return value ? finite(*value) : Json(nullptr); }

template <typename T>
Json orNull(const std::optional<T>& value) {
  return value ? Json(*value) : Json(nullptr);
}

Maybe asDouble(const MaybeCount& count) {
  if (!count) return std::nullopt;
  return static_cast<double>(*count);
}

// The error relative to the scene's extent.
Maybe scaledError(const Row& row) {
  if (!row.errors.max_abs || row.extent <= 0) return std::nullopt;
  return *row.errors.max_abs / row.extent;
}

// The time of one of several queries of a frame.
Maybe pairMicroseconds(const Row& row) {
  if (!row.pairs.total) return std::nullopt;
  return row.times.median_us * static_cast<double>(row.frames) /
         static_cast<double>(*row.pairs.total);
}

constexpr char kLine[] = "%-25s %-9s %-17s %10s %10s %8s %9s %9s %9s %10s %6s %8s %8s %9s\n";

void printHeading() {
  std::printf(kLine, "scenario", "query", "bv", "median_us", "min_us", "us/pair", "x OBBRSS",
              "BV tests", "leaves", "err/extent", "wrong", "B/tri", "peak/tri", "build/tri");
}

void print(const Row& row) {
  std::printf(kLine, row.scenario.c_str(), row.query.c_str(), row.bv.c_str(),
              cell(row.times.median_us, "%.3f").c_str(), cell(row.times.min_us, "%.3f").c_str(),
              cell(pairMicroseconds(row), "%.3f").c_str(),
              cell(row.times.ratio_to_fcl_obbrss, "%.2f").c_str(),
              cell(row.tests.bvs, "%.1f").c_str(), cell(row.tests.leaves, "%.1f").c_str(),
              cell(scaledError(row), "%.1e").c_str(),
              cell(asDouble(row.errors.wrong), "%.0f").c_str(),
              cell(row.volumes.bytes_per_triangle, "%.0f").c_str(),
              cell(row.volumes.peak_bytes_per_triangle, "%.0f").c_str(),
              cell(row.volumes.build_us_per_triangle, "%.3f").c_str());
}

}  // namespace

Row Row::of(const Competitor& competitor, const Competitor* reference) const {
  Row row = *this;
  row.bv = competitor.name;
  row.times = timesOf(competitor, frames, reference);
  return row;
}

std::string cell(const Maybe& value, const char* format) {
  if (!value || !std::isfinite(*value)) return "-";
  char text[32];
  std::snprintf(text, sizeof text, format, *value);
  return text;
}

std::string timeText(double us) {
  return us < 9999.5 ? cell(us, us < 999.5 ? "%.3g us" : "%.0f us") : cell(us / 1000, "%.4g ms");
}

void append(std::vector<Row> rows, std::vector<Row>& all) {
  std::move(rows.begin(), rows.end(), std::back_inserter(all));
}

std::string toJson(const Row& row) {
  const Json json = {
      {"scenario", row.scenario},
      {"query", row.query},
      {"bv", row.bv},
      {"triangles", row.triangles},
      {"frames", row.frames},
      {"rel_err", orNull(row.asked.rel_err)},
      {"abs_err", orNull(row.asked.abs_err)},
      {"threshold", orNull(row.asked.threshold)},
      {"median_us", finite(row.times.median_us)},
      {"min_us", finite(row.times.min_us)},
      {"ratio_to_fcl_obbrss", orNull(row.times.ratio_to_fcl_obbrss)},
      {"max_abs_error", orNull(row.errors.max_abs)},
      {"max_rel_error", orNull(row.errors.max_rel)},
      {"mean_abs_error", orNull(row.errors.mean_abs)},
      {"mean_rel_error", orNull(row.errors.mean_rel)},
      {"bracket_width", orNull(row.errors.bracket_width)},
      {"bracket_ratio", orNull(row.errors.bracket_ratio)},
      {"max_bracket_ratio", orNull(row.errors.max_bracket_ratio)},
      {"budget", orNull(row.asked.budget)},
      {"wrong_verdicts", orNull(row.errors.wrong)},
      {"bv_tests", orNull(row.tests.bvs)},
      {"leaf_tests", orNull(row.tests.leaves)},
      {"bytes_per_triangle", orNull(row.volumes.bytes_per_triangle)},
      {"peak_bytes_per_triangle", orNull(row.volumes.peak_bytes_per_triangle)},
      {"build_us_per_triangle", orNull(row.volumes.build_us_per_triangle)},
      {"mean_spheres", orNull(row.volumes.mean_spheres)},
      {"floats_per_bv", orNull(row.volumes.floats_per_bv)},
      {"tightness", orNull(row.volumes.tightness)},
      {"ratio_to_ssv", orNull(row.to_ssv.ratio)},
      {"max_ratio_to_ssv", orNull(row.to_ssv.max_ratio)},
      {"skipped_pairs", orNull(row.pairs.skipped)},
      {"total_pairs", orNull(row.pairs.total)},
      {"narrow_queries", orNull(row.pairs.narrow_queries)},
      {"solved", orNull(row.plans.solved)},
      {"in_contact", orNull(row.plans.in_contact)},
      {"mean_us", orNull(row.plans.mean_us)},
      {"edges_per_second", orNull(row.plans.edges_per_second)},
      {"simd_target", orNull(row.simd_target)},
      {"seed", row.seed},
  };
  return json.dump();
}

void printTable(const std::vector<Row>& rows) {
  printHeading();
  for (const Row& row : rows) print(row);
  std::printf("\n");
}

Report::Report(const std::optional<std::filesystem::path>& json_file, Print print) : print_(print) {
  if (!json_file) return;
  json_.open(*json_file);
  if (!json_) throw std::runtime_error(json_file->string() + ": cannot be written");
}

void Report::add(const std::vector<Row>& rows) {
  print_(rows);
  std::fflush(stdout);
  addUnprinted(rows);
}

void Report::addUnprinted(const std::vector<Row>& rows) {
  for (const Row& row : rows) {
    if (json_.is_open()) json_ << toJson(row) << '\n';
    rows_.push_back(row);
  }
  json_.flush();
}

}  // namespace kios::bench
