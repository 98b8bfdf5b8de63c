// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
// Included once a target, by the kernels.

HWY_BEFORE_NAMESPACE();
namespace kios::engine::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Products and sums are never fused, so that all targets give bitwise the same floats.
using D = hn::CappedTag<float, kLanes>;
using V = hn::Vec<D>;
using DU = hn::Rebind<uint32_t, D>;
constexpr D d;
constexpr DU du;
HWY_INLINE size_t step() { return hn::Lanes(d); }

HWY_INLINE V load(const Lanes& lanes, size_t at) { return hn::Load(d, lanes.v + at); }
HWY_INLINE V set(float v) { return hn::Set(d, v); }
HWY_INLINE V positive(V v) { return hn::Max(v, hn::Zero(d)); }
HWY_INLINE V dot(V ax, V ay, V az, V bx, V by, V bz) {
  return hn::Add(hn::Add(hn::Mul(ax, bx), hn::Mul(ay, by)), hn::Mul(az, bz));
}
HWY_INLINE V square(V x, V y, V z) { return dot(x, y, z, x, y, z); }

struct V3 {
  // The compiler's own constructors would not be of the instruction set that V's are.
  HWY_INLINE V3() {}
  HWY_INLINE V3(V x, V y, V z) : x(x), y(y), z(z) {}

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

/// Points in another frame, and differences of points.
HWY_INLINE V3 rotated(const FloatPose& X, const V3& v) {
  const auto row = [&](int i) { return dot({set(X.R[i][0]), set(X.R[i][1]), set(X.R[i][2])}, v); };
  return {row(0), row(1), row(2)};
}
HWY_INLINE V3 moved(const FloatPose& X, const V3& p) {
  return rotated(X, p) + V3(set(X.t[0]), set(X.t[1]), set(X.t[2]));
}
/// Lanes from l on of points, rows x, y, z.
HWY_INLINE V3 rowsAt(const Lanes* rows, size_t l) {
  return {load(rows[0], l), load(rows[1], l), load(rows[2], l)};
}

HWY_INLINE void storeAt(const V3& v, size_t l, Lanes& x, Lanes& y, Lanes& z) {
  hn::Store(v.x, d, x.v + l);
  hn::Store(v.y, d, y.v + l);
  hn::Store(v.z, d, z.v + l);
}

/// Rows of a node in another frame: rows that are differences are only rotated.
struct alignas(64) MovedNode {
  float x[kLanes], y[kLanes], z[kLanes];
  float r[kLanes];
};

HWY_INLINE void move(const Node& node, const FloatPose& X, float pad, MovedNode& out) {
  alignas(32) static constexpr float kPoint[kLanes] = {1, 1, 0, 1, 0, 0, 0, 0};
  for (size_t l = 0; l < kLanes; l += step()) {
    const float* const rows = reinterpret_cast<const float*>(&node) + l;
    const V3 turned = rotated(X, {hn::LoadU(d, rows), hn::LoadU(d, rows + kSphereRows),
                                  hn::LoadU(d, rows + 2 * kSphereRows)});
    const V point = hn::Load(d, kPoint + l);
    hn::Store(hn::Add(turned.x, hn::Mul(point, set(X.t[0]))), d, out.x + l);
    hn::Store(hn::Add(turned.y, hn::Mul(point, set(X.t[1]))), d, out.y + l);
    hn::Store(hn::Add(turned.z, hn::Mul(point, set(X.t[2]))), d, out.z + l);
  }
  out.r[kCentral] = node.r[kCentral] + pad;
  out.r[kMiddle2] = node.r[kMiddle2] + pad;
  out.r[kHalf2] = node.r[kHalf2];
  out.r[kMiddle1] = node.r[kMiddle1] + pad;
  out.r[kHalf1] = node.r[kHalf1];
}

struct Spheres {
  V3 center;
  V r;
};

HWY_INLINE Spheres spheresAt(const Block& block, int row, size_t l) {
  return {{load(block.x[row], l), load(block.y[row], l), load(block.z[row], l)},
          load(block.r[row], l)};
}

/// Caps of a pair: the minus one where the sign bit of `side` is set.
HWY_INLINE Spheres capOf(const Spheres& middle, const Spheres& half, V side) {
  const V s = hn::And(side, hn::SignBit(d));
  const V3 &m = middle.center, &h = half.center;
  return {
      {hn::Add(m.x, hn::Xor(h.x, s)), hn::Add(m.y, hn::Xor(h.y, s)), hn::Add(m.z, hn::Xor(h.z, s))},
      hn::Add(middle.r, hn::Xor(half.r, s))};
}

/// The bound over a pair of spheres.
HWY_INLINE V separation(const Spheres& a, const Spheres& b) {
  const V3 way = a.center - b.center;
  return hn::Sub(hn::Sqrt(dot(way, way)), hn::Add(a.r, b.r));
}

/// Lower bounds of the distances of a block's children to X, lanes from `l`: of the 25 sphere pairs
/// the nine of both S0 and, for each axis, the cap whose centre lies on the far side. Any choice is
/// valid.
HWY_INLINE V lowerBounds(const Block& block, size_t l, const MovedNode& X) {
  const auto row = [&](int i) { return spheresAt(block, i, l); };
  const auto moved = [&](int i) {
    return Spheres{{set(X.x[i]), set(X.y[i]), set(X.z[i])}, set(X.r[i])};
  };
  const V sign = hn::SignBit(d);
  const Spheres c0 = row(kCentral), x0 = moved(kCentral);
  const V3 w = c0.center - x0.center;
  // The child's cap with (cap - middle) . w > 0, X's with < 0.
  const auto farCap = [&](const Spheres& middle, const Spheres& half, V flip) {
    return capOf(middle, half, hn::Xor(dot(half.center, w), flip));
  };
  const Spheres c2 = farCap(row(kMiddle2), row(kHalf2), hn::Zero(d));
  const Spheres c1 = farCap(row(kMiddle1), row(kHalf1), hn::Zero(d));
  const Spheres x2 = farCap(moved(kMiddle2), moved(kHalf2), sign);
  const Spheres x1 = farCap(moved(kMiddle1), moved(kHalf1), sign);
  V best = separation(c0, x0);
  best = hn::Max(best, hn::Max(separation(c0, x2), separation(c0, x1)));
  best = hn::Max(best, hn::Max(separation(c2, x0), separation(c1, x0)));
  best = hn::Max(best, hn::Max(separation(c2, x2), separation(c2, x1)));
  return hn::Max(best, hn::Max(separation(c1, x2), separation(c1, x1)));
}

}  // namespace kios::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
