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

std::string cell(const std::optional<double>& value, const char* format) {
  if (!value || !std::isfinite(*value)) return "-";
  char text[32];
  std::snprintf(text, sizeof text, format, *value);
  return text;
}

std::optional<double> asDouble(const std::optional<std::size_t>& count) {
  if (!count) return std::nullopt;
  return static_cast<double>(*count);
}

// The error relative to the scene's extent.
std::optional<double> scaledError(const Row& row) {
  if (!row.max_abs_error || row.extent <= 0) return std::nullopt;
  return *row.max_abs_error / row.extent;
}

// The time of one of several queries of a frame.
std::optional<double> pairMicroseconds(const Row& row) {
  if (!row.total_pairs) return std::nullopt;
  return row.median_us * static_cast<double>(row.frames) / static_cast<double>(*row.total_pairs);
}

constexpr char kLine[] = "%-25s %-9s %-17s %10s %10s %8s %9s %9s %9s %10s %6s %8s %9s\n";

void printHeading() {
  std::printf(kLine, "scenario", "query", "bv", "median_us", "min_us", "us/pair", "x OBBRSS",
              "BV tests", "leaves", "err/extent", "wrong", "B/tri", "build/tri");
}

void print(const Row& row) {
  std::printf(kLine, row.scenario.c_str(), row.query.c_str(), row.bv.c_str(),
              cell(row.median_us, "%.3f").c_str(), cell(row.min_us, "%.3f").c_str(),
              cell(pairMicroseconds(row), "%.3f").c_str(),
              cell(row.ratio_to_fcl_obbrss, "%.2f").c_str(), cell(row.bv_tests, "%.1f").c_str(),
              cell(row.leaf_tests, "%.1f").c_str(), cell(scaledError(row), "%.1e").c_str(),
              cell(asDouble(row.wrong_verdicts), "%.0f").c_str(),
              cell(row.bytes_per_triangle, "%.0f").c_str(),
              cell(row.build_us_per_triangle, "%.3f").c_str());
}

}  // namespace

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
      {"rel_err", orNull(row.rel_err)},
      {"abs_err", orNull(row.abs_err)},
      {"threshold", orNull(row.threshold)},
      {"median_us", finite(row.median_us)},
      {"min_us", finite(row.min_us)},
      {"ratio_to_fcl_obbrss", orNull(row.ratio_to_fcl_obbrss)},
      {"max_abs_error", orNull(row.max_abs_error)},
      {"max_rel_error", orNull(row.max_rel_error)},
      {"mean_abs_error", orNull(row.mean_abs_error)},
      {"mean_rel_error", orNull(row.mean_rel_error)},
      {"bracket_width", orNull(row.bracket_width)},
      {"budget", orNull(row.budget)},
      {"wrong_verdicts", orNull(row.wrong_verdicts)},
      {"bv_tests", orNull(row.bv_tests)},
      {"leaf_tests", orNull(row.leaf_tests)},
      {"bytes_per_triangle", orNull(row.bytes_per_triangle)},
      {"build_us_per_triangle", orNull(row.build_us_per_triangle)},
      {"mean_spheres", orNull(row.mean_spheres)},
      {"floats_per_bv", orNull(row.floats_per_bv)},
      {"tightness", orNull(row.tightness)},
      {"ratio_to_ssv", orNull(row.ratio_to_ssv)},
      {"max_ratio_to_ssv", orNull(row.max_ratio_to_ssv)},
      {"skipped_pairs", orNull(row.skipped_pairs)},
      {"total_pairs", orNull(row.total_pairs)},
      {"narrow_queries", orNull(row.narrow_queries)},
      {"prepared_models", orNull(row.prepared_models)},
      {"simd_target", orNull(row.simd_target)},
      {"seed", row.seed},
  };
  return json.dump();
}

Report::Report(const std::optional<std::filesystem::path>& json_file) {
  if (!json_file) return;
  json_.open(*json_file);
  if (!json_) throw std::runtime_error(json_file->string() + ": cannot be written");
}

void Report::add(const std::vector<Row>& rows) {
  printHeading();
  for (const Row& row : rows) print(row);
  std::printf("\n");
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
