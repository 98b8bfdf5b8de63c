// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <memory>
#include <string>
#include <vector>

#include "competitor.h"
#include "options.h"
#include "report.h"
#include "scenes/oracle.h"

namespace kios::bench {

/// Measures all competitors on one pair of meshes. Time is this thread's CPU time where the system
/// has it, so that other programs disturb it least.
class Contest {
 public:
  /// Builds the models: options.repeats times interleaved for the build rows, once to keep.
  Contest(const scenes::Mesh& a, const scenes::Mesh& b, const Options& options);

  /// Times the build of both models.
  std::vector<Row> buildRows(const std::string& scenario) const;

  /// Answers the query at every frame, options.repeats times. In a repeat the competitors take
  /// turns at blocks of frames, each block with another one first. Answers of all competitors are
  /// then compared with the oracle, and tests are counted in a pass that is not timed.
  std::vector<Row> queryRows(const std::string& scenario, Query query,
                             const std::vector<scenes::Frame>& frames);

  const scenes::MeshOracle& oracle() const { return oracle_; }

 private:
  struct Entrant {
    std::unique_ptr<Competitor> competitor;
    std::vector<double> build_us;  // both models, by repeat
  };

  void measureBuilds(const scenes::Mesh& a, const scenes::Mesh& b);
  Row rowOf(const Entrant& entrant, const std::string& scenario, Query query) const;

  Options options_;
  double extent_;
  std::size_t triangles_;
  scenes::MeshOracle oracle_;
  std::vector<Entrant> entrants_;
};

/// `count` of the frames, evenly spaced from the first; all of them for count = 0 or too many.
std::vector<scenes::Frame> evenlyChosen(const std::vector<scenes::Frame>& frames, int count);

}  // namespace kios::bench
