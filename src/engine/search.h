// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <limits>

#include "engine/frame_pair.h"
#include "engine/tree.h"
#include "fcl_kios/engine/counts.h"

// What the SIMD traversals share with the exact stage.

namespace kios::engine {

enum class PairKind : std::uint8_t {
  kEdgeEdge,
  kVertexFace,
  kFaceVertex,
  kEdgeFace,
  kFaceEdge,
  kFaces
};

/// Features of a and b, named in that order by `kind`, that float can't tell from the answer.
struct Candidate {
  PairKind kind;
  FeatureId a, b;
};

/// The exact side of a search.
class Judge {
 public:
  /// Evaluates a candidate, which may lower the bounds below. Returns true to end the search.
  virtual bool judge(const Candidate& candidate) = 0;
  /// Tells that some pair is at most so far apart: it will turn up as a candidate.
  virtual void offer(float upper_bound) = 0;

  float prune_at = std::numeric_limits<float>::infinity();  ///< node and leaf pairs at least so far
                                                            ///< apart don't matter
  float keep_to = std::numeric_limits<float>::infinity();   ///< feature pairs at most so far apart
                                                            ///< are candidates

 protected:
  ~Judge() = default;
};

/// Hears of everything that a search leaves out, for tests.
class Audit {
 public:
  /// The contents of two nodes were proven at least `bound` apart, and so left out.
  virtual void pruned(std::uint32_t node_a, std::uint32_t node_b, float bound) = 0;

 protected:
  ~Audit() = default;
};

struct Search {
  const Tree& a;
  const Tree& b;
  const FramePair& frames;
  Judge& judge;
  SearchCounts& counts;
  Audit* audit = nullptr;
};

/// The traversals of one instruction set.
struct Kernels {
  const char* target;
  /// Every feature pair that may be nearer than judge.keep_to, and every edge and face that may
  /// cross, is judged.
  void (*distance)(const Search& search);
  /// Every edge and face that may touch is judged.
  void (*contact)(const Search& search);
  /// Every pair of triangles that may touch is judged.
  void (*contacts)(const Search& search);
};

/// The best instruction set of this machine, or that which the environment variable
/// FCL_KIOS_SIMD names.
const Kernels& kernels();

}  // namespace kios::engine
