// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>

#include "scene/body.h"
#include "scene/pair_memory.h"
#include "search/mesh_pair.h"
#include "volume/rounding.h"

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
template <typename S>
class BodyPair {
 public:
  BodyPair(int id_a, const Body<S>& a, int id_b, const Body<S>& b, PairMemory<S>& memory);

  /// Holds the answer of the narrow phase.
  struct Answer {
    bool within = false;  ///< `distance` is at most the limit; else the pair is farther than that
    S distance = 0;
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
  /// Returns true if the narrow phase would compute exactly the proof's distance.
  bool stoodStill() const { return proof_ && proof_->exact && still(); }
  /// The narrow phase computes at least this, wherever the bodies are.
  double lowerBound() const { return meshes() ? 0 : -kInfinity; }

 private:
  /// Returns true if the bodies have the relative pose of the last proof.
  bool still() const;
  /// Gathers bounds, the cheapest first, until one exceeds `limit`.
  PairBound cachedLowerBound(double limit) const;
  /// An answer holds until something is seen to have changed.
  bool lasting() const { return a_.watched() && b_.watched(); }
  bool meshes() const { return a_.model && b_.model; }
  /// Returns the frame of two meshes, made at its first use.
  const MeshPair& frame() const;
  /// Bounds the error of computed distances about d against exact ones in the common frame.
  double roundingOf(double d) const;
  /// Returns true if the bodies are solids and one, whose surface is apart from the other's, lies
  /// in it.
  bool contained(SearchCounts& counts) const;
  Answer ask(double limit, bool exact, SearchCounts& counts);
  Answer searchMeshes(double limit, SearchCounts& counts);
  Answer decideMeshes(double limit, SearchCounts& counts);
  void remember(double apart, bool exact, const Answer& answer);

  const int id_a_, id_b_;
  const Body<S>&a_, &b_;
  PairMemory<S>& memory_;
  const Proof<S>* proof_;
  mutable std::optional<MeshPair> frame_;
};

/// Counts a pair that `source` proves to be too far.
void countSkipped(PairBound::Source source, SceneCounts& counts);

/// Finds the points that realise a pair's distance, in the world.
template <typename S>
void nearestPoints(const Body<S>& a, const Body<S>& b, ScenePair<S>& pair);

}  // namespace kios::scene
