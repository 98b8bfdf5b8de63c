// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>

#include "bv/assemble.h"
#include "bv/balls.h"
#include "bv/rounding.h"
#include "fcl_kios/bv/kios.h"

namespace kios {
namespace {

using Vec = Eigen::Vector3d;

/// A total order of representations (0 and -0 differ), so that a + b and b + a are computed alike.
template <typename S>
bool before(const kIOS<S>& a, const kIOS<S>& b) {
  constexpr std::size_t kBytes = 4 * sizeof(S) + sizeof(a.cap_x) * 4 + sizeof(a.exponent) + 1;
  const auto bytes = [](const kIOS<S>& v) {
    std::array<unsigned char, kBytes> all;
    unsigned char* out = all.data();
    const auto append = [&out](const auto* field, std::size_t size) {
      std::memcpy(out, field, size);
      out += size;
    };
    append(v.center0.data(), 3 * sizeof(S));
    append(&v.radius0, sizeof(S));
    for (const float* cap : {v.cap_x, v.cap_y, v.cap_z, v.cap_r}) append(cap, sizeof(v.cap_x));
    append(&v.exponent, sizeof(v.exponent));
    append(&v.num_spheres, 1);
    return all;
  };
  return bytes(a) < bytes(b);
}

/// The spheres of one operand around the merged centre, in the merged node's units.
struct Content {
  Ball balls[5];
  int k;

  /// The content lies within this distance of p: every sphere gives a bound.
  double radiusFrom(double x, double y, double z) const {
    double least = std::numeric_limits<double>::infinity();
    for (int i = 0; i < k; ++i) {
      const Ball& s = balls[i];
      least = std::min(least, norm(s.x - x, s.y - y, s.z - z) + s.r);
    }
    return least;
  }
  /// The content lies below this height along the unit vector n.
  double heightAlong(const Vec& n) const {
    double least = std::numeric_limits<double>::infinity();
    for (int i = 0; i < k; ++i) {
      const Ball& s = balls[i];
      least = std::min(least, n[0] * s.x + n[1] * s.y + n[2] * s.z + s.r);
    }
    return least;
  }
  /// The direction of cap pair 0 or 1, zero if there is none.
  Vec axis(int pair) const {
    if (k < 3 + 2 * pair) return Vec::Zero();
    const Ball &p = balls[1 + 2 * pair], &m = balls[2 + 2 * pair];
    const Vec d(p.x - m.x, p.y - m.y, p.z - m.z);
    const double length = d.norm();
    return length > 0 ? Vec(d / length) : Vec::Zero();
  }
};

template <typename S>
Content contentAround(const kIOS<S>& v, const fcl::Vector3<S>& center, int exponent) {
  Content content;
  std::array<double, 3> w;
  for (int c = 0; c < 3; ++c) {
    w[c] = scaled(double{v.center0[c]} - double{center[c]}, -exponent);
  }
  content.k = toBalls(v, w, exponent, content.balls);
  return content;
}

/// Common direction of two axes (either may be zero), the one of the larger node weighing more.
Vec blend(const Vec& a, double weight_a, const Vec& b, double weight_b) {
  const Vec sum = weight_a * a + (a.dot(b) < 0 ? -weight_b : weight_b) * b;
  return sum;
}

// Every sphere's radius is max over the two contents of radiusFrom(stored centre): the sum of a
// length with 4 roundings and a radius with 1, and the origin's rounding of 2 u |w|: < 16 u of it.
double grown(double radius) { return radius * (1 + 16 * kUlpDouble) + 0x1p-900; }

}  // namespace

template <typename S>
kIOS<S> kIOS<S>::operator+(const kIOS& other) const {
  if (k() == 0) return other;
  if (other.k() == 0) return *this;
  const kIOS& a = before(other, *this) ? other : *this;
  const kIOS& b = before(other, *this) ? *this : other;

  // S0: the ball around both S0, or the larger one if it contains the other.
  Vec w;
  for (int c = 0; c < 3; ++c) w[c] = double{b.center0[c]} - double{a.center0[c]};
  const double ra = a.radius0, rb = b.radius0;
  const double largest = std::max({w.cwiseAbs().maxCoeff(), ra, rb});
  kIOS merged = a;
  if (largest == 0) {
    merged.stamp = nextStamp();
    return merged;
  }
  const int e0 = std::ilogb(largest);
  const double d = Vec(scaled(w[0], -e0), scaled(w[1], -e0), scaled(w[2], -e0)).norm();
  const double sa = scaled(ra, -e0), sb = scaled(rb, -e0);
  if (d + sa <= sb) {
    merged.center0 = b.center0;
  } else if (d + sb > sa) {
    const double t = (d + sb - sa) / (2 * d);
    for (int c = 0; c < 3; ++c) {
      merged.center0[c] = static_cast<S>(double{a.center0[c]} + t * w[c]);
    }
  }
  Content content[2] = {contentAround(a, merged.center0, e0), contentAround(b, merged.center0, e0)};
  const double scaled_r0 =
      grown(std::max(content[0].radiusFrom(0, 0, 0), content[1].radiusFrom(0, 0, 0)));
  merged.radius0 =
      roundUp<S>(std::nextafter(scaled(scaled_r0, e0), std::numeric_limits<double>::infinity()));
  merged.exponent = static_cast<std::int16_t>(capExponent(merged.radius0));
  content[0] = contentAround(a, merged.center0, merged.exponent);
  content[1] = contentAround(b, merged.center0, merged.exponent);
  const double r0 = scaled(double{merged.radius0}, -merged.exponent);

  // Caps along the operands' common axes, at the fit's half opening angle of 30 degrees.
  int k = 1;
  Vec first = Vec::Zero();
  for (int pair = 0; pair < 2; ++pair) {
    const double larger = std::max(ra, rb);
    Vec n = blend(content[0].axis(pair), ra / larger, content[1].axis(pair), rb / larger);
    n -= first.dot(n) * first;
    const double length = n.norm();
    if (!(length > 1e-3)) break;
    n /= length;
    first = n;
    constexpr double kCot30 = 1.7320508075688772;
    for (int side = 0; side < 2; ++side, ++k) {
      const Vec facing = side == 0 ? Vec(-n) : n;  // the side that this cap bounds
      const double height =
          std::max(content[0].heightAlong(facing), content[1].heightAlong(facing));
      const Vec center = -facing * std::max(0.0, kCot30 * r0 - height);
      const int i = k - 1;
      merged.cap_x[i] = static_cast<float>(center[0]);
      merged.cap_y[i] = static_cast<float>(center[1]);
      merged.cap_z[i] = static_cast<float>(center[2]);
      const double x = merged.cap_x[i], y = merged.cap_y[i], z = merged.cap_z[i];
      merged.cap_r[i] = roundUpFloat(
          grown(std::max(content[0].radiusFrom(x, y, z), content[1].radiusFrom(x, y, z))));
    }
  }
  completeCaps(merged, k);
  return merged;
}

template kIOS<double> kIOS<double>::operator+(const kIOS<double>&) const;
template kIOS<float> kIOS<float>::operator+(const kIOS<float>&) const;

}  // namespace kios
