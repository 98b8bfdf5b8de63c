// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "mesh_set.h"
#include "options.h"
#include "scenes/arms.h"
#include "scenes/oracle.h"
#include "scenes/pqp_data.h"
#include "shape_oracle.h"

namespace kios::bench {

/// A set of rows asks the questions of all frames in turn, as many for each frame.
struct Task {
  std::string scenario;
  Query query = Query::kDistance;
  std::vector<Question> questions;
  std::size_t frames = 0;
  bool cold = false;  // before every frame the processor has done something else
  /// Before every frame, where cold, this many bytes are written; 0: other code runs, over 4 MB.
  std::size_t streamed_bytes = 0;
};

/// Returns the task of a scene with the meshes 0 and 1.
Task pairTask(const std::string& scenario, Query query, const std::vector<scenes::Frame>& frames);

using Geometries = std::vector<std::shared_ptr<fcl::CollisionGeometryd>>;

/// Measures the volumes of options.bvs on the meshes of a scene. Time is this thread's CPU time
/// where the system has it, so that other programs disturb it least.
class Contest {
 public:
  /// Builds the models: options.repeats times interleaved for the build rows, once to keep.
  /// Geometries that are no meshes are the bodies after these, and second in every question.
  Contest(std::vector<scenes::Mesh> meshes, const Options& options, Geometries others = {});

  /// Returns times the build of all models.
  std::vector<Row> buildRows(const std::string& scenario) const;

  /// Times refits of all models from where their vertices were before (meshes of the same
  /// triangles), each with one distance query. Leaves the models as the last refit left them: what
  /// queryRows() asks next, it asks of those.
  std::vector<Row> refitRows(const std::string& scenario, const std::vector<scenes::Mesh>& before,
                             Refit how, const Question& question);

  /// Asks all questions, options.repeats times. In a repeat the volumes take turns at blocks of
  /// questions, each block with another one first; if task.cold, at frames. All answers are then
  /// compared with the oracle, and tests are counted in a pass that is not timed.
  std::vector<Row> queryRows(const Task& task);

  /// Returns the oracle of two of the meshes, made when first asked for.
  const scenes::MeshOracle& oracle(std::size_t a = 0, std::size_t b = 1);

 private:
  /// A competitor for each volume that serves the query: make(its name, its set).
  template <typename Make>
  std::vector<Competitor> serving(Query query, Make make) const;
  /// The oracles' answers, each found once.
  double truthOf(Query query, const Question& question);
  std::size_t largestOf(const std::vector<Question>& questions) const;
  double findTruth(Query query, const Question& question);
  /// Returns the competitors' rows, with what is known of all models and no answers.
  std::vector<Row> rowsOf(const std::string& scenario, Query query, std::size_t frames,
                          const std::vector<Competitor>& competitors,
                          const Competitor* reference) const;

  Options options_;
  std::vector<scenes::Mesh> meshes_;
  Geometries others_;
  std::map<std::pair<std::size_t, std::size_t>, scenes::MeshOracle> oracles_;
  std::map<std::pair<std::size_t, std::size_t>, ShapeOracle> shape_oracles_;
  std::map<std::vector<double>, double> truths_;
  std::map<std::string, std::unique_ptr<MeshSet>> sets_;
  std::vector<Competitor> builds_;
};

/// Returns FCL's distance of two copies of a mesh, to find poses by: it is fast at any size, and
/// what it gets wrong moves a pose a little.
scenes::DistanceFunction obbrssDistance(const scenes::Mesh& mesh);

/// Returns `count` of the frames, evenly spaced from the first; all of them for count = 0 or too
/// many.
std::vector<scenes::Frame> evenlyChosen(const std::vector<scenes::Frame>& frames, int count);

/// Returns the frames thinned evenly to options.frames, or to a few for options.quick.
std::vector<scenes::Frame> chosenFrames(const std::vector<scenes::Frame>& frames,
                                        const Options& options);

/// Returns the questions about each link of a robot, whose base is the world, and each of another
/// of its kind at X_W2, frame by frame, evenly chosen from a motion of 400 frames or more.
std::vector<Question> robotQuestions(const scenes::Robot& robot, const fcl::Transform3d& X_W2,
                                     int frames, std::uint64_t seed);

/// Made by the program in place of the PQP data: 1200 frames of tori that fall onto each other, and
/// of a blob and a torus that spin apart.
scenes::MovingPair generatedFalling();
scenes::MovingPair generatedSpinning();

}  // namespace kios::bench
