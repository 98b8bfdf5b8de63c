// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

namespace kios::bench {

/// One measurement. What is unknown or has no meaning for the query is absent here, null in JSON.
struct Row {
  std::string scenario;
  std::string query;
  std::string bv;
  std::size_t triangles = 0;  // of all meshes
  std::size_t frames = 0;
  std::optional<double> rel_err;    // asked for
  std::optional<double> abs_err;    // asked for, in the scene's unit of length
  std::optional<double> threshold;  // 'threshold': a distance, or its ratio to the exact distance
  // Per frame, over all pairs of the frame; of all models for builds.
  double median_us = 0;
  double min_us = 0;
  std::optional<double> ratio_to_fcl_obbrss;  // above 1: faster than FCL's OBBRSS
  std::optional<double> max_abs_error;        // against the oracle
  std::optional<double> max_rel_error;
  std::optional<double> mean_abs_error;
  std::optional<double> mean_rel_error;  // over frames without contact
  std::optional<double> bracket_width;   // mean of distance - proven lower bound
  std::optional<double> budget;          // expansions that a query may make
  std::optional<std::size_t> wrong_verdicts;
  std::optional<double> bv_tests;  // per frame
  std::optional<double> leaf_tests;
  std::optional<double> bytes_per_triangle;
  std::optional<double> build_us_per_triangle;
  std::optional<double> mean_spheres;      // k of a node's k-IOS
  std::optional<double> floats_per_bv;     // as the k-IOS paper counts
  std::optional<double> tightness;         // mean of bound / true distance of the contents
  std::optional<double> ratio_to_ssv;      // as ratio_to_fcl_obbrss, to FCL's RSS in its own nodes
  std::optional<double> max_ratio_to_ssv;  // the largest of all frames
  std::optional<std::size_t> skipped_pairs;
  std::optional<std::size_t> total_pairs;  // of all frames, where a frame has several
  std::optional<double> narrow_queries;    // per frame, of the pairs of a scene
  std::optional<std::size_t> prepared_models;
  std::optional<std::string> simd_target;
  std::uint64_t seed = 0;
  // Of the larger mesh, the scale of its errors; in the table only. 1 for pairs of triangles, whose
  // errors are relative to the extent of each pair.
  double extent = 0;
};

/// Moves the rows to the end of `all`.
void append(std::vector<Row> rows, std::vector<Row>& all);

/// The row as one line of JSON. Numbers that are not finite become null.
std::string toJson(const Row& row);

/// Receives rows as they are measured: an aligned table on stdout and, if a file is named, one JSON
/// object a line.
class Report {
 public:
  /// Throws std::runtime_error if the file cannot be written.
  explicit Report(const std::optional<std::filesystem::path>& json_file);

  /// Adds the rows of one scene, with the table's heading above them.
  void add(const std::vector<Row>& rows);

  /// The same for a scenario that prints a table of its own.
  void addUnprinted(const std::vector<Row>& rows);

  const std::vector<Row>& rows() const { return rows_; }

 private:
  std::vector<Row> rows_;
  std::ofstream json_;
};

}  // namespace kios::bench
