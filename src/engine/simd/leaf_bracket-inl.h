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
  Slab slab;            ///< the one that proves most; no points are set
  float lower, upper;   ///< bounds of the distance
  VertexPair vertices;  ///< the nearest so far: the upper bound
};

/// Slabs between two sets of points, and pairs of the points.
template <class HullA, class HullB>
class Slabs {
 public:
  Slabs(const HullA& a, const HullB& b, float distance, Bracketed& out)
      : a_(a), b_(b), distance_(distance), out_(out) {
    out.lower = -std::numeric_limits<float>::infinity();
    out.upper = std::numeric_limits<float>::infinity();
  }

  /// Tries a direction. True if it proves the sets at least `distance` apart.
  bool proves(const Direction& along, float top_a, float bottom_b) {
    const float gap = bottom_b - top_a, lower = gap / along.length;
    if (lower > out_.lower) {
      out_.lower = lower;
      out_.slab.along = along;
      out_.slab.top_a = top_a;
      out_.slab.bottom_b = bottom_b;
    }
    return gap > 0 && gap >= distance_ * along.length;
  }
  bool proves(const Direction& along) {
    return proves(along, a_.top(along.w), -b_.top(-1.0F * along.w));
  }
  /// The mean normal of one of the sets, turned to point from a to b.
  bool provesByNormalOfA(const Across& across, Vec3 between) {
    if (dot(across.along.w, between) >= 0) {
      return proves(across.along, across.top, -b_.top(-1.0F * across.along.w));
    }
    return proves(-across.along, -across.bottom, -b_.top(across.along.w));
  }
  bool provesByNormalOfB(const Across& across, Vec3 between) {
    if (dot(across.along.w, between) >= 0) {
      return proves(across.along, a_.top(across.along.w), across.bottom);
    }
    return proves(-across.along, a_.top(-1.0F * across.along.w), -across.top);
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
  const HullA& a_;
  const HullB& b_;
  const float distance_;
  Bracketed& out_;
};

/// Brackets the distance of two leaves, or proves them at least `distance` apart: `hint` is tried
/// first, then the line of centres, both mean normals, steps of Frank-Wolfe.
HWY_NOINLINE void bracketLeaves(const Search& search, const Leaf& leaf_a, const Leaf& leaf_b,
                                const Direction& hint, Bracketed& out) {
  const LeafView a(search.a, leaf_a), b(search.b, leaf_b);
  const FramePair& frames = search.frames;
  const FloatPose& X = frames.a_from_b;
  const float distance = search.evaluator.prune_at + frames.pad;
  VertexRows moved_b;
  const Points vertices_b = moveVertices(b, X, moved_b);
  const auto between_hulls = [&](const auto& hull_a, const auto& hull_b) {
    Slabs slabs(hull_a, hull_b, distance, out);
    const Vec3 between = moved(X, vec3(leaf_b.centroid)) - vec3(leaf_a.centroid);
    const Across across_a = acrossA(leaf_a), across_b = acrossB(leaf_b, X);
    out.slab.apart = slabs.proves(hint) || slabs.provesByNormalOfA(across_a, between) ||
                     slabs.provesByNormalOfB(across_b, between) ||
                     slabs.steps(between, kFrankWolfeSteps);
  };
  const Lanes *const rows_a = a.vertices.rows, *const rows_b = vertices_b.rows;
  if (HWY_LIKELY(a.vertices.chunks == 2 && vertices_b.chunks == 2)) {
    between_hulls(Hull<2>(rows_a), Hull<2>(rows_b));
  } else if (a.vertices.chunks == 2) {
    between_hulls(Hull<2>(rows_a), Hull<3>(rows_b));
  } else if (vertices_b.chunks == 2) {
    between_hulls(Hull<3>(rows_a), Hull<2>(rows_b));
  } else {
    between_hulls(Hull<3>(rows_a), Hull<3>(rows_b));
  }
  if (out.slab.apart) return;
  out.vertices.nodes = out.nodes;
  out.lower -= frames.pad;
  out.upper = std::sqrt(out.upper) + frames.pad;
}

}  // namespace kios::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
