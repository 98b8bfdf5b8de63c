// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
// Included once a target, by the kernels.

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
        half{set(box.half[0]), set(box.half[1]), set(box.half[2])} {}

  static V3 column(const BoxBlock& block, int i, size_t l) {
    return {load(block.x[i], l), load(block.y[i], l), load(block.z[i], l)};
  }
  static V3 column(const Box& box, int i) { return {set(box.x[i]), set(box.y[i]), set(box.z[i])}; }

  V3 along(const V3& v) const { return {dot(e0, v), dot(e1, v), dot(e2, v)}; }

  /// From the centre to the point of the box that is nearest to centre + v, v given along the axes.
  V3 towards(const V3& v) const {
    const auto clamped = [](V at, V most) { return hn::Max(hn::Min(at, most), hn::Neg(most)); };
    return clamped(v.x, half.x) * e0 + clamped(v.y, half.y) * e1 + clamped(v.z, half.z) * e2;
  }

  V3 e0, e1, e2, center, half;
};

/// The slabs of two boxes' axes: the gaps between the boxes along each.
struct AxisGaps {
  V3 of_a, of_b;
};

/// Two boxes a lane, compared along directions. Lower bounds of the distances of their contents,
/// which say nothing where they aren't positive; float_frame.h derives the pads.
struct BoxPairs {
  BoxPairs(const BoxLanes& box_a, const BoxLanes& box_b, float pad)
      : a(box_a),
        b(box_b),
        padding(set(pad)),
        between(b.center - a.center),
        a_between(a.along(between)),
        b_between(b.along(between)),
        c{a.along(b.e0), a.along(b.e1), a.along(b.e2)},
        abs_c{abs(c[0]), abs(c[1]), abs(c[2])} {}

  static V gap(V apart, V own, V padding, V reach) {
    return hn::Sub(hn::Abs(apart), hn::Add(hn::Add(own, padding), reach));
  }

  AxisGaps alongAxes() const {
    const auto of_a = [&](V apart, V own, V c0, V c1, V c2) {
      return gap(apart, own, padding, dot({c0, c1, c2}, b.half));
    };
    const auto of_b = [&](V apart, V own, const V3& column) {
      return gap(apart, own, padding, dot(column, a.half));
    };
    return {{of_a(a_between.x, a.half.x, abs_c[0].x, abs_c[1].x, abs_c[2].x),
             of_a(a_between.y, a.half.y, abs_c[0].y, abs_c[1].y, abs_c[2].y),
             of_a(a_between.z, a.half.z, abs_c[0].z, abs_c[1].z, abs_c[2].z)},
            {of_b(b_between.x, b.half.x, abs_c[0]), of_b(b_between.y, b.half.y, abs_c[1]),
             of_b(b_between.z, b.half.z, abs_c[2])}};
  }

  /// The widest gap along a product of an axis of a and one of b. None of these directions is
  /// longer than 1, so that the gaps are bounds as they are.
  [[gnu::hot]] V acrossEdges() const {
    V widest = set(-kInfinityFloat);
    const V twice = hn::Add(padding, padding);
    const auto across = [&](V t1, V t2, V h1, V h2, V c1, V c2, V abs_c1, V abs_c2, V reach) {
      const V apart = hn::Sub(hn::Mul(t2, c1), hn::Mul(t1, c2));
      const V own = hn::Add(hn::Mul(h1, abs_c2), hn::Mul(h2, abs_c1));
      widest = hn::Max(widest, gap(apart, own, twice, reach));
    };
    const V3 &t = a_between, &h = a.half;
    const auto withAxis =
        [&](const V3& v, const V3& abs_v, V half1, V half2, const V3& abs1,
            const V3& abs2) {  // of b; the halves of its others, and their columns
          const V3 reach = half1 * abs2 + half2 * abs1;
          across(t.y, t.z, h.y, h.z, v.y, v.z, abs_v.y, abs_v.z, reach.x);
          across(t.z, t.x, h.z, h.x, v.z, v.x, abs_v.z, abs_v.x, reach.y);
          across(t.x, t.y, h.x, h.y, v.x, v.y, abs_v.x, abs_v.y, reach.z);
        };
    withAxis(c[0], abs_c[0], b.half.y, b.half.z, abs_c[1], abs_c[2]);
    withAxis(c[1], abs_c[1], b.half.z, b.half.x, abs_c[2], abs_c[0]);
    withAxis(c[2], abs_c[2], b.half.x, b.half.y, abs_c[0], abs_c[1]);
    return widest;
  }

  const BoxLanes &a, &b;
  const V padding;
  const V3 between, a_between, b_between;
  const V3 c[3], abs_c[3];  ///< b's axes along a's
};

/// In contact any positive gap decides: the widest along an axis, and only if that leaves a lane
/// that overlaps, along a product of axes.
HWY_INLINE V contactBounds(const BoxLanes& a, const BoxLanes& b, float pad) {
  const BoxPairs pairs(a, b, pad);
  const AxisGaps gaps = pairs.alongAxes();
  const auto widest = [](const V3& v) { return hn::Max(hn::Max(v.x, v.y), v.z); };
  const V by_axes = hn::Max(widest(gaps.of_a), widest(gaps.of_b));
  if (hn::AllTrue(d, hn::Gt(by_axes, hn::Zero(d)))) return by_axes;
  return hn::Max(by_axes, pairs.acrossEdges());
}

/// Over three axes, the gaps between the boxes. Then one more direction, as for any w the gap along
/// w divided by |w| is a bound: a line that joins points of both, found by projecting b's centre
/// onto the box of a and that point onto b's. It comes close to the distance of the boxes.
HWY_INLINE V distanceBounds(const BoxLanes& a, const BoxLanes& b, float pad) {
  const BoxPairs pairs(a, b, pad);
  const AxisGaps gaps = pairs.alongAxes();
  const auto squared = [](const V3& v) {
    const V zero = hn::Zero(d);
    return square(hn::Max(v.x, zero), hn::Max(v.y, zero), hn::Max(v.z, zero));
  };
  const V by_axes = hn::Sqrt(hn::Max(squared(gaps.of_a), squared(gaps.of_b)));
  const V3 to_a = a.towards(pairs.a_between) - pairs.between;  // from b's centre
  const V3 w = b.towards(b.along(to_a)) - to_a;
  const V reach = hn::Add(dot(abs(a.along(w)), a.half), dot(abs(b.along(w)), b.half));
  const V length2 = dot(w, w), least2 = set(0x1p-100F);
  const V length = hn::Sqrt(hn::Max(length2, least2));
  const V along_w = hn::Sub(hn::Div(hn::Sub(dot(w, pairs.between), reach), length), pairs.padding);
  // A shorter w joins boxes that are nearer than the pad, and its square may vanish.
  const auto usable = hn::Ge(length2, least2);
  return hn::Max(by_axes, hn::IfThenElseZero(usable, along_w));
}

}  // namespace kios::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
