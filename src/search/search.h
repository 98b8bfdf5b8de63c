// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <limits>

#include "fcl_kios/detail/counts.h"
#include "search/float_frame.h"
#include "tree/tree.h"
#include "volume/rounding.h"

// The types that the SIMD traversals share with the exact stage.

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
class RefineCallback {
 public:
  /// Evaluates a candidate, which may lower the bounds below. Returns true to end the search.
  virtual bool evaluate(const Candidate& candidate) = 0;
  /// Tells that some pair is at most so far apart. It will turn up as a candidate, if that is
  /// nearer than candidate_limit.
  virtual void addUpperBound(float upper_bound) = 0;

  float cull_distance = kInfinityFloat;    ///< node and leaf pairs at least so far
                                           ///< apart don't matter
  float candidate_limit = kInfinityFloat;  ///< feature pairs at most so far apart
                                           ///< are candidates

  /// Bounds in double may prove what floats leave open: asked for until more of them have failed
  /// than proven anything, as bodies that hover are apart each time, those that touch almost never.
  /// Without them contacts of hovering bodies take 1.4 times as long.
  bool triesDouble() const { return double_balance_ >= 0; }
  /// Counts what a bound in double came to. Returns whether it proved anything.
  bool triedDouble(bool apart) {
    double_balance_ += apart ? 1 : -1;
    return apart;
  }

 protected:
  ~RefineCallback() = default;

 private:
  int double_balance_ = 0;
};

/// Where the leaf of one tree is much larger than a node of the other, its triangles take its
/// place, one by one: they are named like nodes, by this bit, the leaf's index << 3 and the lane.
constexpr std::uint32_t kTriangleNode = 1U << 31;
constexpr bool isTriangle(std::uint32_t node) { return (node & kTriangleNode) != 0; }
constexpr std::uint32_t leafOfTriangle(std::uint32_t node) { return (node & ~kTriangleNode) >> 3; }
constexpr std::uint32_t laneOfTriangle(std::uint32_t node) { return node & (kLanes - 1U); }

/// Hears of everything that a search leaves out, for tests.
class Audit {
 public:
  /// The contents of two nodes were proven at least `bound` apart, and so left out. Either may be a
  /// triangle of a leaf.
  virtual void pruned(std::uint32_t node_a, std::uint32_t node_b, float bound) = 0;

 protected:
  ~Audit() = default;
};

/// When a search that brackets the distance may end, and what it proved.
struct Bracket {
  float near_enough = -kInfinityFloat;  ///< a pair so near ends it
  long long max_expansions = std::numeric_limits<long long>::max();
  /// All that was not evaluated is at least so far apart.
  float proven = -kInfinityFloat;
  bool out_of_budget = false;

  bool hasBudget() const { return max_expansions < std::numeric_limits<long long>::max(); }
};

struct CellSearch;
struct PointSearch;
struct RaySearch;
struct SolidSearch;

struct Search {
  const Tree& a;
  const Tree& b;
  const TreePose& pose;
  const FloatFrame& frames;
  RefineCallback& evaluator;
  SearchCounts& counts;
  Audit* audit = nullptr;
  Bracket* bracket = nullptr;  ///< of Kernels::bracket
};

/// The traversals of one instruction set.
struct Kernels {
  const char* target;
  /// Every feature pair that may be nearer than evaluator.candidate_limit, and every edge and face
  /// that may cross, is evaluated.
  void (*distance)(const Search& search);
  /// Feature pairs that may be nearer than evaluator.cull_distance are evaluated, and one of the
  /// nearest whose distance was added; may end early, and tells what was proven.
  void (*bracket)(const Search& search);
  /// Every edge and face that may touch is evaluated.
  void (*contact)(const Search& search);
  /// Every pair of triangles that may touch is evaluated.
  void (*contacts)(const Search& search);
  /// Every triangle that the ray may meet is evaluated, those ahead first.
  void (*ray)(const RaySearch& search);
  /// Every cell of an octree and triangle that may touch are evaluated.
  void (*cells)(const CellSearch& search);
  /// Every triangle that may be nearer to the solid than evaluator.cull_distance is evaluated.
  void (*solid)(const SolidSearch& search);
  /// Every triangle that may be nearer to the point than evaluator.cull_distance is evaluated.
  void (*point)(const PointSearch& search);
};

/// The best instruction set of this machine, or that which the environment variable
/// FCL_KIOS_SIMD names.
const Kernels& kernels();

}  // namespace kios::engine
