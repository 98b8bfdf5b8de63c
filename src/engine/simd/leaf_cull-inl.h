// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
// Included once a target, within kernels.cpp.

HWY_BEFORE_NAMESPACE();
namespace kios::engine::HWY_NAMESPACE {

constexpr int kFrankWolfeSteps = 2;
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

/// Moves chunks of rows x, y, z (every `stride` lanes of one) to another frame.
HWY_INLINE void moveRows(const Lanes* from, const FloatPose& X, bool points, Lanes* to) {
  for (size_t l = 0; l < kLanes; l += step()) {
    const V x = load(from[0], l), y = load(from[1], l), z = load(from[2], l);
    for (int i = 0; i < 3; ++i) {
      const V r = dot(hn::Set(d, X.R[i][0]), hn::Set(d, X.R[i][1]), hn::Set(d, X.R[i][2]), x, y, z);
      hn::Store(points ? hn::Add(r, hn::Set(d, X.t[i])) : r, d, to[i].v + l);
    }
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
  int index;
};
HWY_INLINE Support support(const Points& points, Vec3 w) {
  const V wx = hn::Set(d, w.x), wy = hn::Set(d, w.y), wz = hn::Set(d, w.z);
  V dots[kMaxChunks * kLanes / hn::MaxLanes(d)];
  int n = 0;
  V best = hn::Set(d, -std::numeric_limits<float>::infinity());
  for (int c = 0; c < points.chunks; ++c) {
    const Lanes* const chunk = points.rows + 3 * c;
    for (size_t l = 0; l < kLanes; l += step(), ++n) {
      dots[n] = dot(load(chunk[0], l), load(chunk[1], l), load(chunk[2], l), wx, wy, wz);
      best = hn::Max(best, dots[n]);
    }
  }
  best = hn::MaxOfLanes(d, best);
  for (int i = 0; i < n; ++i) {
    const uint32_t at = bitsOf(hn::Eq(dots[i], best));
    if (at != 0) {
      return {hn::GetLane(best), i * static_cast<int>(step()) +
                                     static_cast<int>(hwy::Num0BitsBelowLS1Bit_Nonzero32(at))};
    }
  }
  return {hn::GetLane(best), 0};  // NaN
}

HWY_INLINE float supportValue(const Points& points, Vec3 w) {
  const V wx = hn::Set(d, w.x), wy = hn::Set(d, w.y), wz = hn::Set(d, w.z);
  V best = hn::Set(d, -std::numeric_limits<float>::infinity());
  for (int c = 0; c < points.chunks; ++c) {
    const Lanes* const chunk = points.rows + 3 * c;
    for (size_t l = 0; l < kLanes; l += step()) {
      best =
          hn::Max(best, dot(load(chunk[0], l), load(chunk[1], l), load(chunk[2], l), wx, wy, wz));
    }
  }
  return hn::GetLane(hn::MaxOfLanes(d, best));
}

/// What is known of two sets of points a and b. Unset where they are apart.
struct Slab {
  bool apart;             ///< proven at least the distance apart that was asked for
  Vec3 w;                 ///< a direction from a to b
  float top_a, bottom_b;  ///< max w . a, min w . b
  Vec3 point_a, point_b;  ///< where they are attained
};

/// Looks for a slab that proves the sets at least `distance` apart (pad included): for any w,
/// (min w . b - max w . a) / |w| bounds the distance. Tries the line of centres, both mean normals
/// and Frank-Wolfe steps towards the nearest points of the hulls.
HWY_INLINE Slab separate(const Points& a, const Points& b, Vec3 between, Vec3 normal_a,
                         Vec3 normal_b, float distance) {
  const float square = distance * distance;
  const auto proves = [&](float gap, Vec3 w) { return gap > 0 && gap * gap >= square * dot(w, w); };
  Slab slab;
  const auto proved = [&](Vec3 w) {
    return proves(-supportValue(b, -1.0F * w) - supportValue(a, w), w);
  };
  slab.apart = proved(between) ||
               proved(dot(normal_a, between) > 0 ? normal_a : -1.0F * normal_a) ||
               proved(dot(normal_b, between) > 0 ? normal_b : -1.0F * normal_b);
  if (slab.apart) return slab;
  slab.w = between;
  for (int i = 0;; ++i) {
    const Support of_a = support(a, slab.w), of_b = support(b, -1.0F * slab.w);
    slab.top_a = of_a.value;
    slab.bottom_b = -of_b.value;
    slab.point_a = a.at(of_a.index);
    slab.point_b = b.at(of_b.index);
    slab.apart = i > 0 && proves(slab.bottom_b - slab.top_a, slab.w);
    if (slab.apart || i == kFrankWolfeSteps) return slab;
    const Vec3 z = slab.point_b - slab.point_a - slab.w;
    const float zz = dot(z, z), wz = dot(slab.w, z);
    if (!(wz < 0 && zz > 0)) return slab;  // w is as short as it gets
    slab.w = slab.w + std::min(1.0F, -wz / zz) * z;
  }
}

}  // namespace kios::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
