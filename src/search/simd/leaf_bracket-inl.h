// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
// Included once a target, by the kernels.

HWY_BEFORE_NAMESPACE();
namespace kios::engine::HWY_NAMESPACE {

/// Two vertices, by their leaves.
struct VertexPair {
  NodePair nodes;
  uint32_t a, b;
};

/// Two leaves that were looked at.
struct Bracketed {
  NodePair nodes;
  Slab slab;            ///< the one that proves most
  float lower, upper;   ///< bounds of the distance
  VertexPair vertices;  ///< the nearest so far: the upper bound
};

/// The corners of a triangle.
struct Corners {
  explicit Corners(const Points& points) : v{points.at(0), points.at(1), points.at(2)} {}

  /// Returns the way from p to the nearest point of the triangle, or to the nearest of its edges
  /// where the triangle is too thin to tell.
  ///
  /// It leads to a combination of the corners with weights that add up to 1 but for 2 u, so its
  /// length is an upper bound to the pad: with edges up to 2 S long, weights, products and sums
  /// cost 12 u S, the points 9 u S, square and root 3 u S (u and S as in float_frame.h).
  [[gnu::hot]] HWY_NOINLINE Vec3 from(Vec3 p) const {
    const Vec3 e[3] = {v[1] - v[0], v[2] - v[1], v[0] - v[2]};
    Vec3 best = {};
    float least = kInfinityFloat;
    const auto offer = [&](Vec3 way) {
      const float square = dot(way, way);
      best = square < least ? way : best;
      least = std::min(square, least);
    };
    float squares[3];
    for (int k = 0; k < 3; ++k) {
      squares[k] = std::max(dot(e[k], e[k]), std::numeric_limits<float>::min());
      const Vec3 q = v[k] - p;
      offer(q + std::min(std::max(-dot(q, e[k]) / squares[k], 0.0F), 1.0F) * e[k]);
    }
    const Vec3 w = p - v[0], f = -1.0F * e[2];
    const float along = dot(f, e[0]) / squares[0];
    const Vec3 h = f - along * e[0];
    const float height = dot(h, h);
    if (!(height > 0x1p-20F * squares[2])) return best;
    const float t = dot(w, h) / height, s = dot(w, e[0]) / squares[0] - t * along;
    if (s >= 0 && t >= 0 && s + t <= 1) offer(s * e[0] + t * f - w);
    return best;
  }

  Vec3 v[3];
};

/// Keeps the best slab between two sets of points, and the best pair of the points:
///
///      .  . |              | .
///     a    .|   -> along   |.    b
///        .  |              |  . .
///         top_a        bottom_b       |p - q| >= bottom_b - top_a for all p of a, q of b
template <class HullA, class HullB>
class Slabs {
 public:
  Slabs(const HullA& a, const HullB& b, float distance, Bracketed& out)
      : a_(a), b_(b), distance_(distance), out_(out) {
    out.lower = -kInfinityFloat;
    out.upper = kInfinityFloat;
  }

  /// Tries a direction. True if it proves the sets at least `distance` apart; out.slab is not set
  /// then.
  HWY_INLINE bool proves(const Direction& along) {
    return proves(along, a_.top(along.w), -b_.top(-1.0F * along.w));
  }

  /// Tries directions across the points of a and of b.
  HWY_INLINE bool provesAcrossA(const Across& a) {
    return proves(a.along, a.top, -b_.top(-1.0F * a.along.w));
  }
  HWY_INLINE bool provesAcrossB(const Across& b) {
    return proves(b.along, a_.top(b.along.w), b.bottom);
  }

  /// Steps of Frank-Wolfe towards the nearest points of the hulls.
  HWY_INLINE bool steps(Vec3 v, int count) {
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

  /// In place of steps(), where one of the sets is a triangle that may be much larger than the
  /// other, and the line of centres tells little: from the other's centre, and then from its vertex
  /// that is nearest along that, to the triangle's nearest point. By steps() alone
  /// world/terrain_1m has 0.83 of its speed.
  [[gnu::hot]] HWY_NOINLINE bool stepsAt(const Corners& triangle, bool of_a, Vec3 center) {
    const auto between = [&](Vec3 p) { return (of_a ? -1.0F : 1.0F) * triangle.from(p); };
    const Direction along = directionOf(between(center));
    const Support top_a = a_.support(along.w), bottom_b = b_.support(-1.0F * along.w);
    if (proves(along, top_a.value, -bottom_b.value)) return true;
    const Vec3 v = between(of_a ? b_.at(bottom_b.index) : a_.at(top_a.index));
    out_.upper = dot(v, v);
    out_.vertices.a = of_a ? 0 : top_a.index;
    out_.vertices.b = of_a ? bottom_b.index : 0;
    return proves(directionOf(v));
  }

 private:
  HWY_INLINE bool proves(const Direction& along, float top_a, float bottom_b) {
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
  /// The direction across a leaf proves most that bodies lie on each other, and in searches with a
  /// bound on entry most pairs with a leaf many times as wide as the other, as those of ground
  /// are. Without a bound it costs more than it tells.
  explicit LastLeaves(const Search& search) {
    const float cull_distance = search.evaluator.cull_distance;
    const bool contact = cull_distance == 0, bounded = cull_distance < kInfinityFloat;
    across_a = contact || (bounded && search.a.mean_leaf > tuning::kWideLeaf * search.b.mean_leaf);
    across_b = contact || (bounded && search.b.mean_leaf > tuning::kWideLeaf * search.a.mean_leaf);
  }

  bool across_a, across_b;  ///< whether to try the directions across the leaves
  MovedLeaf b;
  uint32_t node_of_b = ~0U;          ///< none
  Direction along = {{1, 0, 0}, 1};  ///< of the last slab that didn't
};

/// Brackets the distance of two leaves, either of which may be a triangle's, or proves them at
/// least cull_distance apart: by the last direction, across the leaves, and by steps of Frank-Wolfe
/// from the line of centres.
[[gnu::hot]] inline HWY_NOINLINE void bracketLeaves(const Search& search, const LeafView& a,
                                                    const LeafView& b, LastLeaves& last,
                                                    Bracketed& out) {
  const FloatFrame& frames = search.frames;
  const float distance = search.evaluator.cull_distance + frames.pad;
  if (last.node_of_b != out.nodes.b) {
    last.node_of_b = out.nodes.b;
    last.b.move(b, frames.a_from_b);
  }
  const Points& vertices_b = last.b.vertices;
  betweenHulls(a.vertices, vertices_b, [&](const auto& hull_a, const auto& hull_b) {
    Slabs slabs(hull_a, hull_b, distance, out);
    const Vec3 center_a = vec3(a.leaf.centroid), between = last.b.centroid - center_a;
    const auto bySteps = [&] {
      const bool of_a = isTriangle(out.nodes.a);
      if (HWY_LIKELY(!of_a && !isTriangle(out.nodes.b))) {
        return slabs.steps(between, tuning::kFrankWolfeSteps);
      }
      return slabs.stepsAt(Corners(of_a ? a.vertices : vertices_b), of_a,
                           of_a ? last.b.centroid : center_a);
    };
    out.slab.apart = slabs.proves(last.along) ||
                     (last.across_a && slabs.provesAcrossA(acrossA(a.leaf).turnedTo(between))) ||
                     (last.across_b &&
                      slabs.provesAcrossB(acrossB(b.leaf, frames.a_from_b).turnedTo(between))) ||
                     bySteps();
  });
  if (out.slab.apart) return;
  last.along = out.slab.along;
  out.vertices.nodes = out.nodes;
  out.lower -= frames.pad;
  out.upper = std::sqrt(out.upper) + frames.pad;
}

}  // namespace kios::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
