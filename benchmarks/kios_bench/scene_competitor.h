// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "scenes/robots.h"

namespace kios::bench {

/// The nearest admissible pair; all that are nearer than a margin, with their distances; just which
/// these are; the distance of each.
enum class SceneQuery { kClosest, kWithin, kVerdicts, kClearances };

struct SceneAnswer {
  int a, b;
  double distance;
};

/// A way to ask for the distances of a scene's bodies, frame by frame.
class SceneCompetitor {
 public:
  virtual ~SceneCompetitor() = default;

  virtual const char* name() const = 0;
  virtual bool serves(SceneQuery query) const = 0;
  /// Builds models and objects; bodies are at the poses of frame 0. The scene must outlive this.
  virtual void load(const scenes::BodyScene& scene) = 0;
  /// Forgets what it learnt from frames before.
  virtual void forget() {}
  /// Moves the bodies to a frame's poses and asks. Pairs with distance 0 may be given in any order;
  /// of equally near pairs any may be the closest.
  virtual std::vector<SceneAnswer> answer(SceneQuery query, int frame, double margin) = 0;
  /// Pairs for which the last answer() asked the narrow phase.
  virtual long long queried() const = 0;
  virtual std::size_t bytes() const = 0;
  /// Models that hold something prepared, where there is such a thing.
  virtual std::optional<std::size_t> preparedModels() const { return std::nullopt; }
  virtual std::optional<std::string> simdTarget() const { return std::nullopt; }
};

/// FCL's OBBRSS: every pair with a result of its own; every pair with the best so far, or the
/// margin, as bound on entry; and FCL's dynamic AABB tree.
std::unique_ptr<SceneCompetitor> makeFclPairs();
std::unique_ptr<SceneCompetitor> makeFclBoundedPairs();
std::unique_ptr<SceneCompetitor> makeFclManager();
/// Ours: every pair by fcl::distance, as FCL's if bounded, and SceneDistance.
std::unique_ptr<SceneCompetitor> makeKiosPairs(bool bounded);
std::unique_ptr<SceneCompetitor> makeKiosScene();

}  // namespace kios::bench
