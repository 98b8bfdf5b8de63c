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

HWY_INLINE V3 abs(const V3& v) { return {hn::Abs(v.x), hn::Abs(v.y), hn::Abs(v.z)}; }
HWY_INLINE V3 operator+(const V3& a, const V3& b) {
  return {hn::Add(a.x, b.x), hn::Add(a.y, b.y), hn::Add(a.z, b.z)};
}
HWY_INLINE V3 operator-(const V3& a, const V3& b) {
  return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
}
HWY_INLINE V3 operator*(V s, const V3& a) {
  return {hn::Mul(s, a.x), hn::Mul(s, a.y), hn::Mul(s, a.z)};
}

/// Boxes in one frame, one a lane: axes, centre, half extents.
struct BoxLanes {
  BoxLanes(const BoxBlock& block, size_t l)
      : e0(column(block, 0, l)),
        e1(column(block, 1, l)),
        e2(column(block, 2, l)),
        center(column(block, kCenter, l)),
        half{load(block.half[0], l), load(block.half[1], l), load(block.half[2], l)} {}
  explicit BoxLanes(const Box& box)
      : e0(column(box, 0)),
        e1(column(box, 1)),
        e2(column(box, 2)),
        center(column(box, kCenter)),
        half{hn::Set(d, box.half[0]), hn::Set(d, box.half[1]), hn::Set(d, box.half[2])} {}

  static V3 column(const BoxBlock& block, int i, size_t l) {
    return {load(block.x[i], l), load(block.y[i], l), load(block.z[i], l)};
  }
  static V3 column(const Box& box, int i) {
    return {hn::Set(d, box.x[i]), hn::Set(d, box.y[i]), hn::Set(d, box.z[i])};
  }

  V3 along(const V3& v) const { return {dot(e0, v), dot(e1, v), dot(e2, v)}; }

  /// From the centre to the point of the box that is nearest to centre + v, v given along the axes.
  V3 towards(const V3& v) const {
    const auto clamped = [](V at, V most) { return hn::Max(hn::Min(at, most), hn::Neg(most)); };
    return clamped(v.x, half.x) * e0 + clamped(v.y, half.y) * e1 + clamped(v.z, half.z) * e2;
  }

  V3 e0, e1, e2, center, half;
};

/// Lower bounds of the distances of the contents of a block's boxes to that of a box in their
/// frame, lanes from `l`. They say nothing where they aren't positive. frame_pair.h derives the
/// pad.
///
/// The slabs of either's axes come first: over three axes, the gaps between the boxes. Then one
/// more direction, as for any w the gap along w divided by |w| is a bound: a line that joins points
/// of both, found by projecting b's centre onto the box of a and that point onto b's. It comes
/// close to the distance of the boxes. In contact any positive gap decides, and it suffices to look
/// for the widest along an axis.
template <bool kContact>
HWY_INLINE V boxBounds(const BoxBlock& block, size_t l, const Box& box, float pad) {
  const BoxLanes a(block, l), b(box);
  const V3 between = b.center - a.center;
  const V3 a_between = a.along(between), b_between = b.along(between);
  const V3 e0 = abs(a.along(b.e0)), e1 = abs(a.along(b.e1)), e2 = abs(a.along(b.e2));
  const V padding = hn::Set(d, pad);
  const auto gap = [&](V apart, V own, V reach) {
    return hn::Sub(hn::Abs(apart), hn::Add(hn::Add(own, padding), reach));
  };
  const V3 of_a = {gap(a_between.x, a.half.x, dot({e0.x, e1.x, e2.x}, b.half)),
                   gap(a_between.y, a.half.y, dot({e0.y, e1.y, e2.y}, b.half)),
                   gap(a_between.z, a.half.z, dot({e0.z, e1.z, e2.z}, b.half))};
  const V3 of_b = {gap(b_between.x, b.half.x, dot(e0, a.half)),
                   gap(b_between.y, b.half.y, dot(e1, a.half)),
                   gap(b_between.z, b.half.z, dot(e2, a.half))};
  if constexpr (kContact) {
    const auto widest = [](const V3& v) { return hn::Max(hn::Max(v.x, v.y), v.z); };
    return hn::Max(widest(of_a), widest(of_b));
  }
  const auto squared = [](const V3& v) {
    const V zero = hn::Zero(d);
    return square(hn::Max(v.x, zero), hn::Max(v.y, zero), hn::Max(v.z, zero));
  };
  const V by_axes = hn::Sqrt(hn::Max(squared(of_a), squared(of_b)));
  const V3 to_a = a.towards(a_between) - between;  // from b's centre
  const V3 w = b.towards(b.along(to_a)) - to_a;
  const V reach = hn::Add(dot(abs(a.along(w)), a.half), dot(abs(b.along(w)), b.half));
  const V length2 = dot(w, w);
  const V along_w = hn::Sub(hn::Div(hn::Sub(dot(w, between), reach), hn::Sqrt(length2)), padding);
  // A shorter w joins boxes that are nearer than the pad, and its square may vanish.
  const auto usable = hn::Ge(length2, hn::Set(d, 0x1p-100F));
  return hn::Max(by_axes, hn::IfThenElseZero(usable, along_w));
}

}  // namespace kios::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
