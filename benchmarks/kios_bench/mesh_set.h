// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include <fcl/geometry/collision_geometry.h>

#include "report.h"
#include "scenes/mesh.h"
#include "scenes/motions.h"

namespace kios::bench {

/// kCloserThan: whether two meshes are at most so far apart, by kios::closerThan, or for FCL by a
/// distance with that bound on entry, or by collide where it is 0. kContacts: how many there are.
/// kRefit: the refit of a model whose vertices moved, and a query.
enum class Query { kDistance, kCollide, kContacts, kCloserThan, kBuild, kRefit };

/// Returns the name of the query in tables and JSON.
const char* name(Query query);

/// FCL's endReplaceModel() does this with the tree.
enum class Refit { kRebuild, kTopDown, kBottomUp };

/// A query asks about two bodies of a set, named by their indices, at their poses.
struct Question {
  std::size_t a = 0;
  std::size_t b = 1;
  scenes::Frame poses;
  /// For kCloserThan.
  double threshold = std::numeric_limits<double>::infinity();
  /// For kContacts.
  std::size_t max_contacts = 1000000;
};

/// Holds meshes over one bounding volume, queried as a user would: through fcl::distance and
/// fcl::collide on collision objects that exist once and are moved for every question.
class MeshSet {
 public:
  virtual ~MeshSet() = default;

  /// Returns true if FCL answers this query for meshes of this volume without rebuilding them.
  virtual bool serves(Query query) const = 0;

  /// Builds all models and drops them; a `build` row times this.
  virtual void build(const std::vector<scenes::Mesh>& meshes) const = 0;

  /// Builds all models and keeps them for the queries below.
  virtual void load(const std::vector<scenes::Mesh>& meshes) = 0;

  /// Adds a body that is no mesh.
  virtual void add(const std::shared_ptr<fcl::CollisionGeometryd>& geometry) = 0;

  /// Moves the vertices of the loaded models to those of meshes of the same triangles.
  virtual void replace(const std::vector<scenes::Mesh>& meshes, Refit how) = 0;

  /// Answers questions[begin, end) into answers[begin, end) with a fresh request and result each:
  /// the distance, or the number of contacts, at most 1 for kCollide, or 1 for yes.
  virtual void answer(Query query, const std::vector<Question>& questions, std::size_t begin,
                      std::size_t end, std::vector<double>& answers) = 0;

  /// Counts of FCL's recursion over the volume's own traversal node, cold at each question, by the
  /// number of frames. All bodies are meshes.
  virtual Tests count(Query query, const std::vector<Question>& questions,
                      std::size_t frames) const = 0;

  /// Returns bytes of all models: nodes, primitive indices, vertices and triangles.
  virtual std::size_t bytes() const = 0;
};

/// Every bounding volume under its name of the JSON rows; throws std::invalid_argument for others.
std::unique_ptr<MeshSet> makeMeshSet(const std::string& name);

/// Coal's OBBRSS, by coal_set.cpp; makeMeshSet knows it where Coal was found.
inline constexpr char kCoal[] = "coal_obbrss";
std::unique_ptr<MeshSet> makeCoalSet();

/// Names that makeMeshSet knows, ours first.
std::vector<std::string> volumeNames();

/// Returns those that run where none is named.
std::vector<std::string> defaultVolumeNames();

}  // namespace kios::bench
