// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>

#include "scene/body.h"
#include "scene/pair_memory.h"
#include "search/mesh_pair.h"

namespace kios::scene {

/// Holds a bound of a pair's distance that is known without a search.
struct PairBound {
  enum class Source { kNothing, kStill, kRoots };
  /// Says that the narrow phase would compute at least that; below 0 for root volumes that overlap,
  /// deeper ones first.
  double bound;
  Source source;  ///< of the bound
  bool exact;     ///< it would compute just the proof's distance
};

/// A pair of bodies in a scene query: bounds that spare the narrow phase, and the narrow phase.
class BodyPair {
 public:
  BodyPair(int id_a, const Body& a, int id_b, const Body& b, PairMemory& memory)
      : id_a_(id_a),
        id_b_(id_b),
        a_(a),
        b_(b),
        memory_(memory),
        proof_(lasting() ? memory.find(id_a, a, id_b, b) : nullptr) {}

  /// Holds the answer of the narrow phase.
  struct Answer {
    bool within = false;  ///< `distance` is at most the limit; else the pair is farther than that
    double distance = 0;
    std::intptr_t triangle_a = -1, triangle_b = -1;
  };
  /// Decides without a search whether the pair is within the limit, if what is known allows that,
  /// and counts the pair then. Else `known` is a lower bound.
  std::optional<Answer> decide(double limit, PairBound& known, SceneCounts& counts) const;
  /// Asks the narrow phase for the distance if that is at most `limit`; of two meshes, if `exact`
  /// is false, for any that is at most that.
  Answer search(double limit, bool exact, SceneCounts& counts);
  /// Decides, and searches if need be.
  Answer answer(double limit, bool exact, SceneCounts& counts);

  /// Returns the proof's answer, which has to be exact.
  Answer proven(double limit) const;

  /// Returns what the narrow phase computes at most, as the triangles of the last proof tell it.
  double ceiling() const;
  /// The narrow phase computes at least this, wherever the bodies are.
  double lowerBound() const { return meshes() ? 0 : -kInfinity; }

 private:
  /// Returns true if the bodies have the relative pose of the last proof.
  bool still() const;
  /// Gathers bounds, the cheapest first, until one exceeds `limit`.
  PairBound cachedLowerBound(double limit) const;
  /// An answer holds until something is seen to have changed.
  bool lasting() const { return a_.watched && b_.watched; }
  bool meshes() const { return a_.mesh && b_.mesh; }
  /// Returns the frame of two meshes, made at its first use.
  const MeshPair& frame() const;
  /// Bounds the error of answers about d against exact distances in the common frame.
  double roundingOf(double d) const;
  Answer ask(double limit, bool exact, SearchCounts& counts);
  Answer searchMeshes(double limit, bool exact, SearchCounts& counts);
  void remember(double apart, bool exact, const Answer& answer);

  const int id_a_, id_b_;
  const Body &a_, &b_;
  PairMemory& memory_;
  const Proof* proof_;
  mutable std::optional<MeshPair> frame_;
};

/// Counts a pair that `source` proves to be too far.
void countSkipped(PairBound::Source source, SceneCounts& counts);

/// Finds the points that realise a pair's distance, in the world.
void nearestPoints(const Body& a, const Body& b, ScenePaird& pair);

}  // namespace kios::scene
