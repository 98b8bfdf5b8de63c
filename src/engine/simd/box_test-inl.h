// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
// Included once a target, within kernels.cpp.

HWY_BEFORE_NAMESPACE();
namespace kios::engine::HWY_NAMESPACE {

/// A box in another frame.
HWY_INLINE void move(const Box& box, const FloatPose& X, Box& out) {
  constexpr hn::CappedTag<float, 4> d4;
  alignas(16) static constexpr float kPoint[kBoxColumns] = {0, 0, 0, 1};
  float* const rows[3] = {out.x, out.y, out.z};
  for (size_t l = 0; l < kBoxColumns; l += hn::Lanes(d4)) {
    const auto x = hn::Load(d4, box.x + l), y = hn::Load(d4, box.y + l),
               z = hn::Load(d4, box.z + l), point = hn::Load(d4, kPoint + l);
    for (int i = 0; i < 3; ++i) {
      const auto rotated =
          hn::Add(hn::Add(hn::Mul(hn::Set(d4, X.R[i][0]), x), hn::Mul(hn::Set(d4, X.R[i][1]), y)),
                  hn::Mul(hn::Set(d4, X.R[i][2]), z));
      hn::Store(hn::Add(rotated, hn::Mul(point, hn::Set(d4, X.t[i]))), d4, rows[i] + l);
    }
    hn::Store(hn::Load(d4, box.half + l), d4, out.half + l);
  }
}

struct V3 {
  V x, y, z;
};
HWY_INLINE V dot(const V3& a, const V3& b) { return dot(a.x, a.y, a.z, b.x, b.y, b.z); }

/// Lower bounds of the distances of the contents of a block's boxes to that of a box in their
/// frame, lanes from `l`: what the slabs of either's axes prove. Says nothing where it isn't
/// positive. In contact the widest gap alone counts, which costs less.
template <bool kContact>
HWY_INLINE V boxBounds(const BoxBlock& block, size_t l, const Box& box, float pad) {
  const auto column = [&](int i) {
    return V3{load(block.x[i], l), load(block.y[i], l), load(block.z[i], l)};
  };
  const auto other = [&](int i) {
    return V3{hn::Set(d, box.x[i]), hn::Set(d, box.y[i]), hn::Set(d, box.z[i])};
  };
  const V3 a0 = column(0), a1 = column(1), a2 = column(2), center = column(kCenter);
  const V3 b0 = other(0), b1 = other(1), b2 = other(2), other_center = other(kCenter);
  const V3 between = {hn::Sub(other_center.x, center.x), hn::Sub(other_center.y, center.y),
                      hn::Sub(other_center.z, center.z)};
  const auto cosine = [](const V3& a, const V3& b) { return hn::Abs(dot(a, b)); };
  const V c00 = cosine(a0, b0), c01 = cosine(a0, b1), c02 = cosine(a0, b2);
  const V c10 = cosine(a1, b0), c11 = cosine(a1, b1), c12 = cosine(a1, b2);
  const V c20 = cosine(a2, b0), c21 = cosine(a2, b1), c22 = cosine(a2, b2);
  const V3 half = {load(block.half[0], l), load(block.half[1], l), load(block.half[2], l)};
  const V3 other_half = {hn::Set(d, box.half[0]), hn::Set(d, box.half[1]), hn::Set(d, box.half[2])};
  /// What lies between the boxes along an axis of one of them.
  const auto gap = [&](const V3& axis, V own, const V3& cosines, const V3& halves) {
    const V reach = hn::Add(hn::Add(own, hn::Set(d, pad)), dot(cosines, halves));
    return hn::Sub(hn::Abs(dot(axis, between)), reach);
  };
  const V3 of_block = {gap(a0, half.x, {c00, c01, c02}, other_half),
                       gap(a1, half.y, {c10, c11, c12}, other_half),
                       gap(a2, half.z, {c20, c21, c22}, other_half)};
  const V3 of_other = {gap(b0, other_half.x, {c00, c10, c20}, half),
                       gap(b1, other_half.y, {c01, c11, c21}, half),
                       gap(b2, other_half.z, {c02, c12, c22}, half)};
  if constexpr (kContact) {
    const auto widest = [](const V3& v) { return hn::Max(hn::Max(v.x, v.y), v.z); };
    return hn::Max(widest(of_block), widest(of_other));
  }
  const auto squared = [](const V3& v) {
    const V zero = hn::Zero(d);
    return square(hn::Max(v.x, zero), hn::Max(v.y, zero), hn::Max(v.z, zero));
  };
  return hn::Sqrt(hn::Max(squared(of_block), squared(of_other)));
}

}  // namespace kios::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
