// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <memory>
#include <string>
#include <vector>

#include "options.h"
#include "report.h"
#include "scene_competitor.h"

namespace kios::bench {

struct SceneEntrant {
  std::unique_ptr<SceneCompetitor> competitor;
  /// Answers only each so many-th frame, where it takes too long; ratios compare just those.
  int stride = 1;
};

struct SceneTask {
  std::string scenario;
  SceneQuery query = SceneQuery::kClosest;
  double margin = 0;
};

/// Measures competitors on the frames of a scene, interleaved in blocks of frames, each repeat from
/// a cold start. The first entrant sets the truth: answers of all others are compared with its, the
/// distances, and whether a pair is nearer than the margin. Ratios are to the entrant called
/// fcl_obbrss, or else fcl_manager.
class SceneContest {
 public:
  SceneContest(const scenes::BodyScene& scene, std::vector<SceneEntrant> entrants,
               const Options& options);
  std::vector<Row> rows(const SceneTask& task);

 private:
  const scenes::BodyScene& scene_;
  std::vector<SceneEntrant> entrants_;
  Options options_;
  std::size_t triangles_ = 0;
  double extent_ = 0;
};

}  // namespace kios::bench
