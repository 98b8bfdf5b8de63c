// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
// Included once a target, within kernels.cpp.

HWY_BEFORE_NAMESPACE();
namespace kios::engine::HWY_NAMESPACE {

using D4 = hn::CappedTag<float, 4>;
using V4 = hn::Vec<D4>;
constexpr D4 d4;

/// x ex + y ey + z ez, lanes from `l`.
HWY_INLINE V4 combine(float x, float y, float z, const Box& box, size_t l) {
  return hn::Add(hn::Add(hn::Mul(hn::Set(d4, x), hn::Load(d4, box.ex + l)),
                         hn::Mul(hn::Set(d4, y), hn::Load(d4, box.ey + l))),
                 hn::Mul(hn::Set(d4, z), hn::Load(d4, box.ez + l)));
}

/// A box in another frame.
HWY_INLINE void move(const Box& box, const FloatPose& X, Box& out) {
  float* const axes[3] = {out.ex, out.ey, out.ez};
  const float* const c = box.center;
  for (int i = 0; i < 3; ++i) {
    const float* const row = X.R[i];
    for (size_t l = 0; l < 4; l += hn::Lanes(d4)) {
      hn::Store(combine(row[0], row[1], row[2], box, l), d4, axes[i] + l);
    }
    out.center[i] = row[0] * c[0] + row[1] * c[1] + row[2] * c[2] + X.t[i];
  }
  std::copy_n(box.half, 4, out.half);
}

/// Squared distance that the slabs of `a` prove: over its axes, what lies between the two boxes.
HWY_INLINE float slabDistance(const Box& a, const Box& b, const float* t, float pad) {
  alignas(16) float square[4];
  for (size_t l = 0; l < 4; l += hn::Lanes(d4)) {
    V4 reach = hn::Add(hn::Load(d4, a.half + l), hn::Set(d4, pad));
    for (int j = 0; j < 3; ++j) {
      const V4 along = hn::Abs(combine(b.ex[j], b.ey[j], b.ez[j], a, l));
      reach = hn::Add(reach, hn::Mul(along, hn::Set(d4, b.half[j])));
    }
    const V4 apart = hn::Abs(combine(t[0], t[1], t[2], a, l));
    const V4 gap = hn::Max(hn::Sub(apart, reach), hn::Zero(d4));
    hn::Store(hn::Mul(gap, gap), d4, square + l);
  }
  return square[0] + square[1] + square[2];
}

/// Lower bound of the distance of the contents of two boxes in one frame, by the axes of either.
HWY_INLINE float boxDistance(const Box& a, const Box& b, float pad) {
  const float t[3] = {b.center[0] - a.center[0], b.center[1] - a.center[1],
                      b.center[2] - a.center[2]};
  return std::sqrt(std::max(slabDistance(a, b, t, pad), slabDistance(b, a, t, pad)));
}

}  // namespace kios::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
