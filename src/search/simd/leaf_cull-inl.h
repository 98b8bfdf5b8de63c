// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
// Included once a target, by the kernels.

HWY_BEFORE_NAMESPACE();
namespace kios::engine::HWY_NAMESPACE {

constexpr int kMaxChunks = kMaxLeafFeatures / kLanes;

struct Vec3 {
  float x, y, z;
};
HWY_INLINE Vec3 operator+(Vec3 a, Vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
HWY_INLINE Vec3 operator-(Vec3 a, Vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
HWY_INLINE Vec3 operator*(float s, Vec3 a) { return {s * a.x, s * a.y, s * a.z}; }
HWY_INLINE float dot(Vec3 a, Vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
HWY_INLINE Vec3 vec3(const float* v) { return {v[0], v[1], v[2]}; }
HWY_INLINE Vec3 rotated(const FloatPose& X, Vec3 v) {
  return {dot(vec3(X.R[0]), v), dot(vec3(X.R[1]), v), dot(vec3(X.R[2]), v)};
}
HWY_INLINE Vec3 moved(const FloatPose& X, Vec3 v) { return rotated(X, v) + vec3(X.t); }

HWY_INLINE V3 inAllLanes(Vec3 v) { return {set(v.x), set(v.y), set(v.z)}; }
/// The first `count` lanes, all if there are more, as bits.
HWY_INLINE uint32_t firstLanes(int count) { return count >= kLanes ? 0xFFU : (1U << count) - 1; }

/// Moves a chunk of points, rows x, y, z, to another frame.
HWY_INLINE void moveRows(const Lanes* from, const FloatPose& X, Lanes* to) {
  for (size_t l = 0; l < kLanes; l += step()) {
    storeAt(moved(X, rowsAt(from, l)), l, to[0], to[1], to[2]);
  }
}

/// Points in chunks of x, y, z rows.
struct Points {
  const Lanes* rows;
  int chunks;

  Vec3 at(int i) const {
    const Lanes* const chunk = rows + 3 * (i / kLanes);
    return {chunk[0].v[i % kLanes], chunk[1].v[i % kLanes], chunk[2].v[i % kLanes]};
  }
};

/// The largest of w . p over the points, and which.
struct Support {
  float value;
  uint32_t index;
};

/// `kChunks` chunks of points in vectors.
template <int kChunks>
class Hull {
 public:
  HWY_INLINE explicit Hull(const Lanes* rows) : rows_(rows) {
    for (int i = 0; i < kVectors; ++i) {
      points_[i] = rowsAt(rows + 3 * (i * kStep / kLanes), static_cast<size_t>(i * kStep % kLanes));
    }
  }

  HWY_INLINE float top(Vec3 w) const {
    V dots[kVectors];
    return hn::GetLane(topOf(w, dots));
  }

  HWY_INLINE Support support(Vec3 w) const {
    V dots[kVectors];
    const V best = topOf(w, dots);
    uint32_t at = 1U << (kVectors * kStep - 1);  // for NaN
    for (int i = 0; i < kVectors; ++i) at |= bitsOf(hn::Eq(dots[i], best)) << (i * kStep);
    return {hn::GetLane(best), firstOf(at)};
  }

  Vec3 at(uint32_t i) const { return Points{rows_, kChunks}.at(static_cast<int>(i)); }

 private:
  static constexpr int kStep = static_cast<int>(hn::MaxLanes(d));
  static constexpr int kVectors = kChunks * kLanes / kStep;

  HWY_INLINE V topOf(Vec3 w, V* dots) const {
    const V3 along = inAllLanes(w);
    for (int i = 0; i < kVectors; ++i) dots[i] = dot(points_[i], along);
    V best = dots[0];
    for (int i = 1; i < kVectors; ++i) best = hn::Max(best, dots[i]);
    return hn::MaxOfLanes(d, best);
  }

  const Lanes* rows_;
  V3 points_[kVectors];
};

/// A direction along which points are compared, made by directionOf() alone. Its square lies in
/// [2^-60, 2^84], so that neither squares nor products with coordinates vanish where it matters,
/// also where the processor flushes subnormal numbers to 0.
struct Direction {
  Vec3 w;
  float length;

  Direction operator-() const { return {-1.0F * w, length}; }
};

/// v scaled by a power of two to a largest coordinate in [1, 2); if it is subnormal or 0 another
/// direction, as any direction gives a valid slab.
inline HWY_NOINLINE Direction rescaled(Vec3 v) {
  const float largest = std::max(std::max(std::abs(v.x), std::abs(v.y)), std::abs(v.z));
  if (!(largest >= std::numeric_limits<float>::min())) return {{1, 0, 0}, 1};
  const Vec3 w = std::ldexp(1.0F, -std::ilogb(largest)) * v;
  return {w, std::sqrt(dot(w, w))};
}

/// The direction of v, of any length up to 2^42 (what frames allow).
HWY_INLINE Direction directionOf(Vec3 v) {
  constexpr float kLeastSquare = 0x1p-60F;
  const float square = dot(v, v);
  if (HWY_LIKELY(square >= kLeastSquare)) return {v, std::sqrt(square)};
  return rescaled(v);
}

/// The result of a search for a slab between two sets of points a and b. If `apart` is set, the
/// other members are not.
struct Slab {
  bool apart;             ///< proven at least the distance apart that was asked for
  Direction along;        ///< from a to b
  float top_a, bottom_b;  ///< max w . a, min w . b
};

/// A direction across a leaf, and where its points lie along it.
struct Across {
  Across turnedTo(Vec3 way) const {
    return dot(along.w, way) > 0 ? *this : Across{-along, -top, -bottom};
  }

  Direction along;
  float bottom, top;
};

/// Whether a gap along a direction proves two sets at least `distance` apart (pad included): for
/// any w, (min w . b - max w . a) / |w| bounds the distance.
HWY_INLINE bool provesApart(float gap, const Direction& along, float distance) {
  return (gap > 0) & (gap >= distance * along.length);  // no branch that can't be predicted
}

}  // namespace kios::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
