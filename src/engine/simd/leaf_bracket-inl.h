// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
// Included once a target, within kernels.cpp.

HWY_BEFORE_NAMESPACE();
namespace kios::engine::HWY_NAMESPACE {

/// Two vertices, by their leaves.
struct VertexPair {
  Pair nodes;
  uint32_t a, b;
};

/// Two leaves that were looked at.
struct Bracketed {
  Pair nodes;
  Slab slab;            ///< the one that proves most
  float lower, upper;   ///< bounds of the distance
  VertexPair vertices;  ///< the nearest so far: the upper bound
};

/// Slabs between two sets of points, and pairs of the points: the best of each are kept.
template <class HullA, class HullB>
class Slabs {
 public:
  Slabs(const HullA& a, const HullB& b, float distance, Bracketed& out)
      : a_(a), b_(b), distance_(distance), out_(out) {
    out.lower = -std::numeric_limits<float>::infinity();
    out.upper = std::numeric_limits<float>::infinity();
  }

  /// Tries a direction. True if it proves the sets at least `distance` apart; out.slab is not set
  /// then.
  bool proves(const Direction& along) {
    return proves(along, a_.top(along.w), -b_.top(-1.0F * along.w));
  }

  /// Steps of Frank-Wolfe towards the nearest points of the hulls.
  bool steps(Vec3 v, int count) {
    for (int i = 0;; ++i) {
      const Direction along = directionOf(v);
      const Support of_a = a_.support(along.w), of_b = b_.support(-1.0F * along.w);
      if (proves(along, of_a.value, -of_b.value)) return true;
      const Vec3 between = b_.at(of_b.index) - a_.at(of_a.index);
      const float square = dot(between, between);
      if (square < out_.upper) {
        out_.upper = square;
        out_.vertices.a = of_a.index;
        out_.vertices.b = of_b.index;
      }
      if (i == count) return false;
      const Vec3 z = between - v;
      const float zz = dot(z, z), vz = dot(v, z);
      if (!(vz < 0 && zz > 0)) return false;  // v is as short as it gets
      v = v + std::min(1.0F, -vz / zz) * z;
    }
  }

 private:
  bool proves(const Direction& along, float top_a, float bottom_b) {
    const float gap = bottom_b - top_a;
    if (provesApart(gap, along, distance_)) return true;
    const float lower = gap / along.length;
    if (lower > out_.lower) {
      out_.lower = lower;
      out_.slab.along = along;
      out_.slab.top_a = top_a;
      out_.slab.bottom_b = bottom_b;
    }
    return false;
  }

  const HullA& a_;
  const HullB& b_;
  const float distance_;
  Bracketed& out_;
};

/// What pairs of leaves that follow each other share: often the leaf of b, and often the direction
/// that proves them apart.
struct LastLeaves {
  MovedLeaf b;
  Direction along = {{1, 0, 0}, 1};  ///< of the last slab that didn't
};

/// Brackets the distance of two leaves, or proves them at least prune_at apart: by the last
/// direction, then the line of centres and steps of Frank-Wolfe.
HWY_NOINLINE void bracketLeaves(const Search& search, const Leaf& leaf_a, const Leaf& leaf_b,
                                LastLeaves& last, Bracketed& out) {
  const LeafView a(search.a, leaf_a);
  const FramePair& frames = search.frames;
  const float distance = search.evaluator.prune_at + frames.pad;
  if (last.b.leaf != &leaf_b) last.b.move(LeafView(search.b, leaf_b), frames.a_from_b);
  betweenHulls(a.vertices, last.b.vertices, [&](const auto& hull_a, const auto& hull_b) {
    Slabs slabs(hull_a, hull_b, distance, out);
    out.slab.apart = slabs.proves(last.along) ||
                     slabs.steps(last.b.centroid - vec3(leaf_a.centroid), kFrankWolfeSteps);
  });
  if (out.slab.apart) return;
  last.along = out.slab.along;
  out.vertices.nodes = out.nodes;
  out.lower -= frames.pad;
  out.upper = std::sqrt(out.upper) + frames.pad;
}

}  // namespace kios::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
