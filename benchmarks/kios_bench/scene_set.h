// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "report.h"
#include "scenes/robots.h"

namespace kios::bench {

/// Names the nearest admissible pair; all that are nearer than a margin, with their distances; just
/// which these are; the distance of each.
enum class SceneQuery { kClosest, kWithin, kVerdicts, kClearances };

struct SceneAnswer {
  int a, b;
  double distance;
};

/// A way to ask for the distances of a scene's bodies, frame by frame. The scene must outlive it.
class SceneSet {
 public:
  virtual ~SceneSet() = default;
  virtual bool serves(SceneQuery /*query*/) const { return true; }
  /// Forgets what it learnt from frames before.
  virtual void forget() {}
  /// Moves the bodies to a frame's poses and asks. Pairs with distance 0 may be given in any order;
  /// of equally near pairs any may be the closest.
  virtual std::vector<SceneAnswer> answer(SceneQuery query, int frame, double margin) = 0;
  /// Returns pairs for which the last answer() asked the narrow phase.
  virtual long long queried() const = 0;
};

/// By their names in rows. FCL's OBBRSS: `fcl_obbrss`, every pair with a result of its own;
/// `fcl_obbrss_bounded`, every pair with the best so far, or the margin, as bound on entry;
/// `fcl_manager`, its dynamic AABB tree. Ours: `kios_pairs` and `kios_bounded`, every pair as
/// FCL's.
std::unique_ptr<SceneSet> makeSceneSet(const std::string& name, const scenes::BodyScene& scene);

/// Ours by SceneDistance, `kios`.
std::unique_ptr<SceneSet> makeKiosScene(const scenes::BodyScene& scene);

}  // namespace kios::bench
