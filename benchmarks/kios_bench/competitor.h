// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <cstddef>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "scenes/mesh.h"
#include "scenes/motions.h"

namespace kios::bench {

/// kThreshold: a distance query with a bound on entry, as FCL's broadphase asks: is anything
/// nearer? kPrepare: the build and the first query, with whatever a model leaves to that.
/// kRefit: the same for a model whose vertices moved.
enum class Query { kDistance, kCollide, kThreshold, kBuild, kPrepare, kRefit };

constexpr Query kAllQueries[] = {Query::kDistance, Query::kCollide, Query::kThreshold,
                                 Query::kBuild,    Query::kPrepare, Query::kRefit};

/// What FCL's endReplaceModel() does with the tree.
enum class Refit { kRebuild, kTopDown, kBottomUp };

/// The name of the query in tables and JSON.
const char* name(Query query);

/// What to ask: a query on two meshes of a scene, by their indices, at their poses.
struct Question {
  std::size_t a = 0;
  std::size_t b = 1;
  scenes::Frame poses;
  /// For kThreshold: DistanceResult::min_distance on entry.
  double threshold = std::numeric_limits<double>::infinity();
};

/// Tests of bounding volumes and of triangle pairs, summed over frames.
struct TestCounts {
  long long bv_tests = 0;
  long long leaf_tests = 0;
};

/// One bounding volume with the meshes of a scene, queried as a user would: through fcl::distance
/// and fcl::collide on collision objects that exist once and are moved for every question.
class Competitor {
 public:
  virtual ~Competitor() = default;

  virtual const char* name() const = 0;

  /// Whether FCL answers this query for meshes of this volume without rebuilding them.
  virtual bool serves(Query query) const = 0;

  /// Builds all models and drops them: what a `build` row times.
  virtual void build(const std::vector<scenes::Mesh>& meshes) = 0;

  /// Builds all models, asks one distance and drops them: what a `prepare` row times.
  virtual void prepare(const std::vector<scenes::Mesh>& meshes, const Question& question) = 0;

  /// Builds all models and keeps them for the queries below.
  virtual void load(const std::vector<scenes::Mesh>& meshes) = 0;

  /// Moves the vertices of the loaded models to those of meshes of the same triangles, and asks one
  /// distance.
  virtual void refit(const std::vector<scenes::Mesh>& meshes, Refit how,
                     const Question& question) = 0;

  /// Answers questions[begin, end) into answers[begin, end) with a fresh request and result each:
  /// the distance, never above the threshold of a kThreshold query, or 1 for contact and 0 for
  /// none.
  virtual void answer(Query query, const std::vector<Question>& questions, std::size_t begin,
                      std::size_t end, std::vector<double>& answers) = 0;

  /// Counts of FCL's recursion over the volume's own traversal node, cold at each question.
  virtual TestCounts count(Query query, const std::vector<Question>& questions) const = 0;

  /// Bytes of all models: nodes, primitive indices, vertices and triangles.
  virtual std::size_t bytes() const = 0;

  /// The SIMD target that answers, where the volume has more than one.
  virtual std::optional<std::string> simdTarget() const = 0;
};

/// Every bounding volume under its name of the JSON rows; throws std::invalid_argument for others.
std::unique_ptr<Competitor> makeCompetitor(const std::string& name);

/// Names that makeCompetitor knows, ours first.
std::vector<std::string> competitorNames();

/// Those that run where none is named.
std::vector<std::string> defaultCompetitorNames();

/// Ours. In a file of its own, as that file sees the overloads of fcl::distance and fcl::collide:
/// the rows of FCL's volumes must not pay for their dispatch.
std::unique_ptr<Competitor> makeKiosCompetitor();

/// Our volume without the engine: FCL's recursion over FCL's binary tree, by our traversal nodes,
/// with the tuned fit, and with the paper's Method II as published.
std::unique_ptr<Competitor> makeKiosTreeCompetitor();
std::unique_ptr<Competitor> makeMethodTwoCompetitor();

}  // namespace kios::bench
