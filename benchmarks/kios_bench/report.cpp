// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#include "report.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <stdexcept>

#include <fcl_kios/model.h>
#include <nlohmann/json.hpp>

#include "library.h"

namespace kios::bench {
namespace {

using Json = nlohmann::ordered_json;

Maybe number(const MaybeCount& count) {
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

// Pairs of which the narrow phase wasn't asked.
Maybe skippedPairs(const Row& row) {
  if (!row.pairs.total || !row.pairs.narrow_queries) return std::nullopt;
  return static_cast<double>(*row.pairs.total) -
         *row.pairs.narrow_queries * static_cast<double>(row.frames);
}

/// A number of a row, in JSON, in tables, or both.
struct Field {
  const char* json;     ///< nullptr: in tables alone
  const char* heading;  ///< nullptr: in JSON alone
  const char* format;   ///< printf's
  Maybe (*of)(const Row& row);
  bool is_count = false;
};

constexpr Field kFields[] = {
    {"rel_err", "rel_err", "%g", [](const Row& row) { return row.asked.rel_err; }},
    {"abs_err", "abs_err", "%g", [](const Row& row) { return row.asked.abs_err; }},
    {"threshold", "at", "%g", [](const Row& row) { return row.asked.threshold; }},
    {"budget", "budget", "%g", [](const Row& row) { return row.asked.budget; }},
    {"median_us", "median_us", "%.3f", [](const Row& row) { return Maybe(row.times.median_us); }},
    {"min_us", "min_us", "%.3f", [](const Row& row) { return Maybe(row.times.min_us); }},
    {"mean_us", "mean_us", "%.3f", [](const Row& row) { return row.plans.mean_us; }},
    {nullptr, "us/pair", "%.3f", pairMicroseconds},
    {"ratio_to_fcl_obbrss", "x OBBRSS", "%.2f",
     [](const Row& row) { return row.times.ratio_to_fcl_obbrss; }},
    {"bv_tests", "BV tests", "%.1f", [](const Row& row) { return row.tests.bvs; }},
    {"leaf_tests", "leaves", "%.1f", [](const Row& row) { return row.tests.leaves; }},
    {nullptr, "err/extent", "%.1e", scaledError},
    {"max_abs_error", nullptr, nullptr, [](const Row& row) { return row.errors.max_abs; }},
    {"max_rel_error", nullptr, nullptr, [](const Row& row) { return row.errors.max_rel; }},
    {"mean_rel_error", "mean rel", "%.2e", [](const Row& row) { return row.errors.mean_rel; }},
    {"bracket_width", "width", "%.2e", [](const Row& row) { return row.errors.bracket_width; }},
    {"bracket_ratio", "up/low", "%.3f", [](const Row& row) { return row.errors.bracket_ratio; }},
    {"max_bracket_ratio", "at most", "%.2f",
     [](const Row& row) { return row.errors.max_bracket_ratio; }},
    {"wrong_verdicts", "wrong", "%.0f", [](const Row& row) { return number(row.errors.wrong); },
     true},
    {"undecided", "open", "%.0f", [](const Row& row) { return number(row.errors.undecided); },
     true},
    {"bytes_per_triangle", "B/tri", "%.0f",
     [](const Row& row) { return row.volumes.bytes_per_triangle; }},
    {"peak_bytes_per_triangle", "peak/tri", "%.0f",
     [](const Row& row) { return row.volumes.peak_bytes_per_triangle; }},
    {"build_us_per_triangle", "build/tri", "%.3f",
     [](const Row& row) { return row.volumes.build_us_per_triangle; }},
    {"mean_spheres", "k", "%.2f", [](const Row& row) { return row.volumes.mean_spheres; }},
    {"floats_per_bv", "floats", "%.2f", [](const Row& row) { return row.volumes.floats_per_bv; }},
    {"tightness", "tightness", "%.3f", [](const Row& row) { return row.volumes.tightness; }},
    {"bodies", "bodies", "%.0f", [](const Row& row) { return number(row.bodies); }, true},
    {"skipped_pairs", nullptr, nullptr, skippedPairs, true},
    {"total_pairs", nullptr, nullptr, [](const Row& row) { return number(row.pairs.total); }, true},
    {"narrow_queries", "searches", "%.2f", [](const Row& row) { return row.pairs.narrow_queries; }},
    {"solved", "solved", "%.0f", [](const Row& row) { return number(row.plans.solved); }, true},
    {"in_contact", "in contact", "%.0f",
     [](const Row& row) { return number(row.plans.in_contact); }, true},
};

/// A column of a table, its heading first.
using Column = std::vector<std::string>;

/// Rows that tell nothing leave a column out; none asks for an error of 0.
bool isShown(const Column& column) {
  return std::any_of(column.begin() + 1, column.end(), [&column](const std::string& text) {
    return text != "-" && (text != "0" || column[0] == "wrong" || column[0] == "at");
  });
}

}  // namespace

Row Row::of(const Competitor& competitor, const Competitor* reference) const {
  Row row = *this;
  row.bv = competitor.name;
  row.times = timesOf(competitor, frames, reference);
  return row;
}

Row baseRow(const std::string& scenario, const std::string& query, std::size_t frames,
            const std::vector<scenes::Mesh>& meshes) {
  Row row;
  row.scenario = scenario;
  row.query = query;
  row.frames = frames;
  for (const scenes::Mesh& mesh : meshes) {
    row.triangles += mesh.triangles.size();
    row.largest_mesh = std::max(row.largest_mesh, mesh.triangles.size());
    row.extent = std::max(row.extent, scenes::extent(mesh));
  }
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

std::string toJson(const Row& row, std::uint64_t seed) {
  Json json = {{"scenario", row.scenario},
               {"query", row.query},
               {"bv", row.bv},
               {"triangles", row.triangles},
               {"frames", row.frames}};
  for (const Field& field : kFields) {
    if (!field.json) continue;
    const Maybe value = field.of(row);
    const bool known = value && std::isfinite(*value);
    json[field.json] = !known           ? Json(nullptr)
                       : field.is_count ? Json(static_cast<std::size_t>(*value))
                                        : Json(*value);
  }
  json["simd_target"] = row.bv == kOurs ? Json(simdTarget()) : Json(nullptr);
  json["seed"] = seed;
  return json.dump();
}

void printTable(const std::vector<Row>& rows) {
  std::vector<Column> columns = {{"scenario"}, {"query"}, {"bv"}};
  for (const Row& row : rows) {
    columns[0].push_back(row.scenario);
    columns[1].push_back(row.query);
    columns[2].push_back(row.bv);
  }
  for (const Field& field : kFields) {
    if (!field.heading) continue;
    Column column = {field.heading};
    for (const Row& row : rows) column.push_back(cell(field.of(row), field.format));
    if (isShown(column)) columns.push_back(std::move(column));
  }
  for (std::size_t line = 0; line <= rows.size(); ++line) {
    for (std::size_t c = 0; c < columns.size(); ++c) {
      std::size_t width = 0;
      for (const std::string& text : columns[c]) width = std::max(width, text.size());
      const int digits = static_cast<int>(width);
      std::printf("%s%*s", c == 0 ? "" : "  ", c < 3 ? -digits : digits, columns[c][line].c_str());
    }
    std::printf("\n");
  }
  std::printf("\n");
}

Report::Report(const std::optional<std::filesystem::path>& json_file, std::uint64_t seed,
               Print print)
    : seed_(seed), print_(print) {
  if (!json_file) return;
  json_.open(*json_file);
  if (!json_) throw std::runtime_error(json_file->string() + ": cannot be written");
}

void Report::add(const std::vector<Row>& rows) {
  print_(rows);
  std::fflush(stdout);
  for (const Row& row : rows) {
    if (json_.is_open()) json_ << toJson(row, seed_) << '\n';
    rows_.push_back(row);
  }
  json_.flush();
}

}  // namespace kios::bench
