// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include "race.h"
#include "scenes/mesh.h"

namespace kios::bench {

using Maybe = std::optional<double>;
using MaybeCount = std::optional<std::size_t>;

/// A query was allowed this much, or compared with this threshold.
struct Asked {
  Maybe rel_err;
  Maybe abs_err;    ///< in the scene's unit of length
  Maybe threshold;  ///< 'threshold': a distance, or its ratio to the exact distance
  Maybe budget;     ///< expansions that it may make
};

/// Answers against the oracle's.
struct Errors {
  Maybe max_abs, max_rel;
  Maybe mean_rel;                          ///< over frames without contact
  Maybe bracket_width;                     ///< mean of distance - proven lower bound
  Maybe bracket_ratio, max_bracket_ratio;  ///< of upper / lower bound: median, largest
  MaybeCount wrong;                        ///< verdicts
  MaybeCount undecided;                    ///< left open, and said so
};

/// Tests of bounding volumes, of triangle pairs (ours: of leaves), and pairs evaluated in double,
/// of a frame.
struct Tests {
  Maybe bvs = {}, leaves = {}, exact = {};
};

/// Holds properties of the models and their volumes.
struct Volumes {
  Maybe bytes_per_triangle, build_us_per_triangle;
  Maybe peak_bytes_per_triangle;  ///< while they are built
  Maybe mean_spheres;             ///< k of a node's k-IOS
  Maybe floats_per_bv;            ///< as the k-IOS paper counts
  Maybe tightness;                ///< mean of bound / true distance of the contents
};

/// Holds pairs of a scene.
struct Pairs {
  MaybeCount total;      ///< of all frames, where a frame has several
  Maybe narrow_queries;  ///< of a frame
};

/// Counts planning problems, whose times are those of a plan: median, the budget where it ran out.
struct Plans {
  MaybeCount solved;
  MaybeCount in_contact;  ///< problems whose start or goal is in contact, that nobody was asked
  Maybe mean_us;
};

/// Counts answers that aren't those of the library before.
struct Changes {
  std::size_t bits = 0, answers = 0;  ///< not bit for bit; beyond rounding
};

/// Holds one measurement. A scenario sets the parts that it knows; what it leaves is null in JSON.
struct Row {
  std::string scenario, query, bv;
  std::size_t triangles = 0;     ///< of all meshes
  std::size_t largest_mesh = 0;  ///< triangles of the largest one asked about; 0: unsaid
  std::size_t frames = 0;
  MaybeCount bodies;  ///< of an assembly
  /// Is that of the larger mesh, the scale of its errors; in the table only. 1 for pairs of
  /// triangles, whose errors are relative to the extent of each pair.
  double extent = 0;
  Times times;  ///< of a frame, over all of its pairs; of all models for builds
  Asked asked;
  Errors errors;
  Tests tests;
  Volumes volumes;
  Pairs pairs;
  Plans plans;
  std::optional<Changes> changes;  ///< not in JSON

  /// Returns a copy for a competitor, with its times.
  Row of(const Competitor& competitor, const Competitor* reference = nullptr) const;
};

/// Returns what all rows of a query have in common.
Row baseRow(const std::string& scenario, const std::string& query, std::size_t frames,
            const std::vector<scenes::Mesh>& meshes = {});

/// Moves the rows to the end of `all`.
void append(std::vector<Row> rows, std::vector<Row>& all);

/// Returns a number as the tables print it, by printf's format; `-` if it is unknown or not finite.
std::string cell(const Maybe& value, const char* format);

/// Returns a time for readers: in us, or in ms where those have five digits.
std::string timeText(double us);

/// Returns the row as one line of JSON. Numbers that are unknown or not finite are null.
std::string toJson(const Row& row, std::uint64_t seed);

/// Prints rows as an aligned table, without columns that tell nothing of them.
void printTable(const std::vector<Row>& rows);

/// Receives rows as they are measured: prints those of a scene and, if a file is named, writes one
/// JSON object a line.
class Report {
 public:
  using Print = void (*)(const std::vector<Row>& rows);

  /// Throws std::runtime_error if the file cannot be written.
  Report(const std::optional<std::filesystem::path>& json_file, std::uint64_t seed,
         Print print = printTable);

  /// Adds the rows of one scene and prints them.
  void add(const std::vector<Row>& rows);

  const std::vector<Row>& rows() const { return rows_; }

 private:
  std::uint64_t seed_;
  Print print_;
  std::vector<Row> rows_;
  std::ofstream json_;
};

}  // namespace kios::bench
