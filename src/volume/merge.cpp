// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <cstring>

#include "fcl_kios/volume.h"
#include "volume/assemble.h"
#include "volume/balls.h"
#include "volume/lanes.h"
#include "volume/rounding.h"

namespace kios {
namespace {

using lanes::broadcast;
using lanes::Float4;

/// A total order of representations (0 and -0 differ), so that a + b and b + a are computed alike.
template <typename S>
bool before(const kIOS<S>& a, const kIOS<S>& b) {
  if (a.radius0 != b.radius0) return a.radius0 < b.radius0;
  const auto order = [](const auto& x, const auto& y) {
    return std::memcmp(static_cast<const void*>(&x), static_cast<const void*>(&y), sizeof(x));
  };
  for (const int by : {order(a.center0, b.center0), order(a.cap_x, b.cap_x),
                       order(a.cap_y, b.cap_y), order(a.cap_z, b.cap_z), order(a.cap_r, b.cap_r),
                       order(a.exponent, b.exponent), order(a.num_spheres, b.num_spheres)}) {
    if (by != 0) return by < 0;
  }
  return false;
}

/// The spheres of one operand around the merged centre, in the merged node's units, as floats. The
/// content lies within |c_i - p| + r_i + pad of any p, whatever i: in floats (u = 2^-24) that sum
/// is off by u |w| (S0's centre w as a float), u (|w| + |o|) (a cap's at w + o), 4.5 u |c_i - p|
/// and u (|c_i - p| + r_i), together below 8 u (|w| + |o| + r_i + |p|).
class Content {
 public:
  template <typename S>
  Content(const kIOS<S>& v, const fcl::Vector3<S>& center, int exponent) {
    const double unit0 = scaled(1.0, -exponent / 2);  // in two steps: 2^-exponent may overflow
    const double unit1 = scaled(1.0, -exponent - (-exponent / 2));
    for (int c = 0; c < 3; ++c) {
      w_[c] = (double{v.center0[c]} - double{center[c]}) * unit0 * unit1;
    }
    r0_ = double{v.radius0} * unit0 * unit1;
    weight_ = roundUpFloat(r0_);
    const float w[3] = {roundedTo<float>(w_[0]), roundedTo<float>(w_[1]), roundedTo<float>(w_[2])};
    reach_ = std::abs(w[0]) + std::abs(w[1]) + std::abs(w[2]) + weight_;
    caps_[0] = caps_[1] = caps_[2] = broadcast(0);
    caps_[3] = broadcast(weight_);  // as S0
    if (v.k() > 1) {                // a point has an exponent of its own
      const auto unit = roundedTo<float>(scaled(1.0, v.exponent - exponent));
      caps_[0] = lanes::load(v.cap_x) * unit;
      caps_[1] = lanes::load(v.cap_y) * unit;
      caps_[2] = lanes::load(v.cap_z) * unit;
      caps_[3] = lanes::load(v.cap_r) * unit;
      reach_ += v.reach * unit;
    }
    balls_[0] = {broadcast(w[0]), broadcast(w[1]), broadcast(w[2]), broadcast(weight_)};
    for (int c = 0; c < 3; ++c) at_[c] = caps_[c] + w[c];
    for (int i = 0; i < 4; ++i) {
      balls_[i + 1] = {broadcast(at_[0][i]), broadcast(at_[1][i]), broadcast(at_[2][i]),
                       broadcast(caps_[3][i])};
    }
  }

  float weight() const { return weight_; }

  /// Rounding of radii from points whose coordinates are at most so large.
  Float4 pad(Float4 reach) const { return (reach + reach_) * 0x1p-20F + 0x1p-90F; }

  /// The content lies within this distance of the origin.
  double radius() const {
    const double by_center = norm(w_[0], w_[1], w_[2]) + r0_;
    const Float4 by_caps = lanes::sqrt(at_[0] * at_[0] + at_[1] * at_[1] + at_[2] * at_[2]) +
                           caps_[3] + pad(broadcast(0));
    return std::min(by_center, double{lanes::horizontalMin(by_caps)});
  }
  /// The content lies within these distances of four points, but for the pad.
  Float4 radiusFrom(Float4 x, Float4 y, Float4 z) const {
    Float4 least = broadcast(kInfinityFloat);
    for (const LaneBall& s : balls_) {
      const Float4 dx = x - s.x, dy = y - s.y, dz = z - s.z;
      least = lanes::min(least, lanes::sqrt(dx * dx + dy * dy + dz * dz) + s.r);
    }
    return least;
  }
  /// The content lies about below these heights along four directions.
  Float4 heightAlong(Float4 x, Float4 y, Float4 z) const {
    Float4 least = broadcast(kInfinityFloat);
    for (const LaneBall& s : balls_) least = lanes::min(least, x * s.x + y * s.y + z * s.z + s.r);
    return least;
  }
  /// From the minus to the plus cap of pair 0 or 1, zero if there is none.
  Eigen::Vector3f axis(int pair) const {
    const int plus = 2 * pair, minus = plus + 1;
    return {caps_[0][plus] - caps_[0][minus], caps_[1][plus] - caps_[1][minus],
            caps_[2][plus] - caps_[2][minus]};
  }

 private:
  /// A sphere in all lanes.
  struct LaneBall {
    Float4 x, y, z, r;
  };

  double w_[3], r0_;
  Float4 caps_[4];     ///< x, y, z from S0's centre, and radii: a cap a lane
  Float4 at_[3];       ///< their centres
  LaneBall balls_[5];  ///< S0, caps
  float weight_, reach_;
};

/// Common direction of two axes (either may be zero), the one of the larger node weighing more.
Eigen::Vector3f blend(const Content& a, const Content& b, int pair) {
  const Eigen::Vector3f of_a = a.axis(pair), of_b = b.axis(pair);
  const float square_a = of_a.squaredNorm(), square_b = of_b.squaredNorm();
  const float scale_a = square_a > 0 ? a.weight() / std::sqrt(square_a) : 0.0F;
  const float scale_b = square_b > 0 ? b.weight() / std::sqrt(square_b) : 0.0F;
  return scale_a * of_a + (of_a.dot(of_b) < 0 ? -scale_b : scale_b) * of_b;
}

}  // namespace

template <typename S>
kIOS<S> kIOS<S>::operator+(const kIOS& other) const {
  if (k() == 0) return other;
  if (other.k() == 0) return *this;
  const bool swap = before(other, *this);
  const kIOS &a = swap ? other : *this, &b = swap ? *this : other;

  // S0: the ball around both S0, or the larger one (b's) if it contains the other.
  double w[3];
  for (int c = 0; c < 3; ++c) w[c] = double{b.center0[c]} - double{a.center0[c]};
  const double ra = a.radius0, rb = b.radius0;
  const double largest = std::max({std::abs(w[0]), std::abs(w[1]), std::abs(w[2]), rb});
  kIOS merged = b;
  if (largest == 0) return merged;
  int exponent = largest >= 0x1p-28 && largest <= 0x1p28 ? 0 : exponentOf(largest);
  const double d = norm(scaled(w[0], -exponent), scaled(w[1], -exponent), scaled(w[2], -exponent));
  const double sa = scaled(ra, -exponent), sb = scaled(rb, -exponent);
  if (d + sa > sb) {
    const double t = (d + sb - sa) / (2 * d);
    for (int c = 0; c < 3; ++c) {
      merged.center0[c] = roundedTo<S>(double{a.center0[c]} + t * w[c]);
    }
  }
  Content from_a(a, merged.center0, exponent), from_b(b, merged.center0, exponent);
  // Sums of a length with four roundings and a radius with one, in double: below 16 u.
  const double scaled_r0 = std::max(from_a.radius(), from_b.radius()) * (1 + 16 * kUlpDouble);
  merged.radius0 = roundUp<S>(std::nextafter(scaled(scaled_r0 + 0x1p-900, exponent), kInfinity));
  merged.exponent = static_cast<std::int16_t>(capExponent(merged.radius0));
  if (merged.exponent != exponent) {
    exponent = merged.exponent;
    from_a = Content(a, merged.center0, exponent);
    from_b = Content(b, merged.center0, exponent);
  }

  // Caps along the operands' common axes, at the fit's half opening angle of 30 degrees.
  const float least_length = 1e-3F * std::max(from_a.weight(), from_b.weight());
  Eigen::Vector3f axes[2];
  int k = 1;
  for (int pair = 0; pair < 2; ++pair) {
    Eigen::Vector3f n = blend(from_a, from_b, pair);
    if (pair == 1) n -= axes[0].dot(n) * axes[0];
    const float length = n.norm();
    if (!(length > least_length)) break;
    axes[pair] = n / length;
    k += 2;
  }
  if (k > 1) {
    if (k == 3) axes[1].setZero();
    // A lane a cap: the directions of the sides that they bound.
    const Float4 sign = {-1, 1, -1, 1};
    const auto lanesOf = [&](int c) {
      return Float4{axes[0][c], axes[0][c], axes[1][c], axes[1][c]} * sign;
    };
    const Float4 fx = lanesOf(0), fy = lanesOf(1), fz = lanesOf(2);
    const Float4 height =
        lanes::max(from_a.heightAlong(fx, fy, fz), from_b.heightAlong(fx, fy, fz));
    const auto r0 = roundedTo<float>(scaled(double{merged.radius0}, -exponent));
    const Float4 offset = lanes::max(kCot30 * r0 - height, broadcast(0));
    const Float4 x = -fx * offset, y = -fy * offset, z = -fz * offset;
    const Float4 radius = lanes::max(from_a.radiusFrom(x, y, z) + from_a.pad(offset * 1.8F),
                                     from_b.radiusFrom(x, y, z) + from_b.pad(offset * 1.8F));
    lanes::store(merged.cap_x, x);
    lanes::store(merged.cap_y, y);
    lanes::store(merged.cap_z, z);
    lanes::store(merged.cap_r, radius);
  }
  completeCaps(merged, k);
  return merged;
}

template kIOS<double> kIOS<double>::operator+(const kIOS<double>&) const;
template kIOS<float> kIOS<float>::operator+(const kIOS<float>&) const;

}  // namespace kios
