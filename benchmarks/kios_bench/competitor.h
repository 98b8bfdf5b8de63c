// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "scenes/mesh.h"
#include "scenes/motions.h"

namespace kios::bench {

enum class Query { kDistance, kCollide, kBuild };

/// The name of the query in tables and JSON.
const char* name(Query query);

/// Tests of bounding volumes and of triangle pairs, summed over frames.
struct TestCounts {
  long long bv_tests = 0;
  long long leaf_tests = 0;
};

/// One bounding volume with a pair of meshes, queried as a user would: through fcl::distance and
/// fcl::collide on collision objects that exist once and are moved for every frame.
class Competitor {
 public:
  virtual ~Competitor() = default;

  virtual const char* name() const = 0;

  /// Whether FCL answers this query for meshes of this volume without rebuilding them.
  virtual bool serves(Query query) const = 0;

  /// Builds both models and drops them: what a `build` row times.
  virtual void build(const scenes::Mesh& a, const scenes::Mesh& b) = 0;

  /// Builds both models and keeps them for the queries below.
  virtual void load(const scenes::Mesh& a, const scenes::Mesh& b) = 0;

  /// Answers frames[begin, end) into answers[begin, end) with a fresh request and result each: the
  /// distance, or 1 for contact and 0 for none.
  virtual void answer(Query query, const std::vector<scenes::Frame>& frames, std::size_t begin,
                      std::size_t end, std::vector<double>& answers) = 0;

  /// Counts of FCL's recursion over the volume's own traversal node, cold at each frame.
  virtual TestCounts count(Query query, const std::vector<scenes::Frame>& frames) const = 0;

  /// Bytes of both models: nodes, primitive indices, vertices and triangles.
  virtual std::size_t bytes() const = 0;

  /// The SIMD target that answers, where the volume has more than one.
  virtual std::optional<std::string> simdTarget() const = 0;
};

/// Every bounding volume under its name of the JSON rows; throws std::invalid_argument for others.
std::unique_ptr<Competitor> makeCompetitor(const std::string& name);

/// Names that makeCompetitor knows, ours first.
std::vector<std::string> competitorNames();

/// Ours. In a file of its own, as that file sees the overloads of fcl::distance and fcl::collide:
/// the rows of FCL's volumes must not pay for their dispatch.
std::unique_ptr<Competitor> makeKiosCompetitor();

}  // namespace kios::bench
