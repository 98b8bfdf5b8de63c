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
constexpr hn::Rebind<uint16_t, D> du16;
HWY_INLINE size_t step() { return hn::Lanes(d); }

HWY_INLINE V load(const Lanes& lanes, size_t at) { return hn::Load(d, lanes.v + at); }
HWY_INLINE V dot(V ax, V ay, V az, V bx, V by, V bz) {
  return hn::Add(hn::Add(hn::Mul(ax, bx), hn::Mul(ay, by)), hn::Mul(az, bz));
}
HWY_INLINE V square(V x, V y, V z) { return dot(x, y, z, x, y, z); }

/// Rows of a node in another frame: rows that are differences are only rotated.
struct alignas(64) MovedNode {
  float x[kLanes], y[kLanes], z[kLanes];
  float r[kLanes];
};

HWY_INLINE void move(const Node& node, const FloatPose& X, float pad, MovedNode& out) {
  alignas(32) static constexpr float kPoint[kLanes] = {1, 1, 0, 1, 0, 0, 0, 0};
  for (size_t l = 0; l < kLanes; l += step()) {
    const float* const rows = reinterpret_cast<const float*>(&node) + l;
    const V px = hn::LoadU(d, rows), py = hn::LoadU(d, rows + kSphereRows),
            pz = hn::LoadU(d, rows + 2 * kSphereRows);
    const V point = hn::Load(d, kPoint + l);
    const auto row = [&](int i) {
      const V rotated =
          dot(hn::Set(d, X.R[i][0]), hn::Set(d, X.R[i][1]), hn::Set(d, X.R[i][2]), px, py, pz);
      return hn::Add(rotated, hn::Mul(point, hn::Set(d, X.t[i])));
    };
    hn::Store(row(0), d, out.x + l);
    hn::Store(row(1), d, out.y + l);
    hn::Store(row(2), d, out.z + l);
  }
  out.r[kCentral] = node.r[kCentral] + pad;
  out.r[kMiddle2] = node.r[kMiddle2] + pad;
  out.r[kHalf2] = node.r[kHalf2];
  out.r[kMiddle1] = node.r[kMiddle1] + pad;
  out.r[kHalf1] = node.r[kHalf1];
}

struct Spheres {
  V x, y, z, r;
};

/// The bound over a pair of spheres.
HWY_INLINE V separation(const Spheres& a, const Spheres& b) {
  const V length = hn::Sqrt(square(hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)));
  return hn::Sub(length, hn::Add(a.r, b.r));
}

/// Lower bounds of the distances of a block's children to X, lanes from `l`: of the 25 sphere pairs
/// the nine of both S0 and, for each axis, the cap whose centre lies on the far side. Any choice is
/// valid.
HWY_INLINE V lowerBounds(const Block& block, size_t l, const MovedNode& X) {
  const auto row = [&](int i) {
    return Spheres{load(block.x[i], l), load(block.y[i], l), load(block.z[i], l),
                   load(block.r[i], l)};
  };
  const auto moved = [&](int i) {
    return Spheres{hn::Set(d, X.x[i]), hn::Set(d, X.y[i]), hn::Set(d, X.z[i]), hn::Set(d, X.r[i])};
  };
  const V sign = hn::SignBit(d);
  const Spheres c0 = row(kCentral), x0 = moved(kCentral);
  const V wx = hn::Sub(c0.x, x0.x), wy = hn::Sub(c0.y, x0.y), wz = hn::Sub(c0.z, x0.z);
  // The child's cap with (cap - middle) . w > 0, X's with < 0.
  const auto farCap = [&](const Spheres& middle, const Spheres& half, V flip) {
    const V s = hn::And(hn::Xor(dot(half.x, half.y, half.z, wx, wy, wz), flip), sign);
    return Spheres{hn::Add(middle.x, hn::Xor(half.x, s)), hn::Add(middle.y, hn::Xor(half.y, s)),
                   hn::Add(middle.z, hn::Xor(half.z, s)), hn::Add(middle.r, hn::Xor(half.r, s))};
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
