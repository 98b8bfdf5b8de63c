// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "fcl_kios/volume.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "volume/balls.h"
#include "volume/error_bounds.h"
#include "volume/errors.h"
#include "volume/lanes.h"
#include "volume/rotation.h"
#include "volume/rounding.h"

namespace kios {
namespace {

/// Centre of b's S0 relative to a's, in A, with the bound of every double rounding of a test.
struct Offset {
  double x, y, z;
  double norm1;
  double pad;
};

template <typename S, typename P>
[[gnu::hot]] Offset offset(const kIOS<S>& a, const kIOS<S>& b, const RelativePose<P>& X) {
  const double ax = a.center0[0], ay = a.center0[1], az = a.center0[2];
  const double bx = b.center0[0], by = b.center0[1], bz = b.center0[2];
  Offset d;
  d.x = ((X.R()(0, 0) * bx + X.R()(0, 1) * by) + X.R()(0, 2) * bz) + X.T()[0] - ax;
  d.y = ((X.R()(1, 0) * bx + X.R()(1, 1) * by) + X.R()(1, 2) * bz) + X.T()[1] - ay;
  d.z = ((X.R()(2, 0) * bx + X.R()(2, 1) * by) + X.R()(2, 2) * bz) + X.T()[2] - az;
  d.norm1 = std::abs(d.x) + std::abs(d.y) + std::abs(d.z);
  const double rb = b.radius0;
  d.pad = error_bounds::volumeError<P>(
              std::abs(bx) + std::abs(by) + std::abs(bz),
              detail::boundsOf(X).T_norm1 + (std::abs(ax) + std::abs(ay) + std::abs(az)), a.radius0,
              rb) +
          detail::boundsOf(X).stretch * rb;
  return d;
}

/// All sphere pairs with a cap in them, in float lanes; exponents 0, |d| < 2^40.
// Each lane's |D + R o_b - o_a| - r_a - r_b has at most 16 u (|D| + reach_a + reach_b) of error:
// u |D| and 11 u |o_b|, 2 u |o_a| from rounding D, R, products and sums, 3 u of the root, 2 u a
// subtraction. 2^-19 is 32 u. Squares that underflow make the bound smaller.
template <typename S, typename P>
[[gnu::hot]] double capSeparation(const kIOS<S>& a, const kIOS<S>& b, const RelativePose<P>& X,
                                  const Offset& d) {
  using lanes::Float4;
  const float dx = roundedTo<float>(d.x), dy = roundedTo<float>(d.y), dz = roundedTo<float>(d.z);
  const Float4 ox = lanes::load(b.cap_x), oy = lanes::load(b.cap_y), oz = lanes::load(b.cap_z);
  const Float4 rb = lanes::load(b.cap_r);
  const auto& R = detail::boundsOf(X).R;
  const Float4 bx = R[0][0] * ox + R[0][1] * oy + R[0][2] * oz + dx;
  const Float4 by = R[1][0] * ox + R[1][1] * oy + R[1][2] * oz + dy;
  const Float4 bz = R[2][0] * ox + R[2][1] * oy + R[2][2] * oz + dz;

  // b's caps against a's S0, then a's caps against b's S0, then caps against caps.
  Float4 best = lanes::sqrt(bx * bx + by * by + bz * bz) - rb - roundUpFloat(a.radius0);
  const Float4 ra = lanes::load(a.cap_r);
  const Float4 ex = dx - lanes::load(a.cap_x), ey = dy - lanes::load(a.cap_y),
               ez = dz - lanes::load(a.cap_z);
  best = lanes::max(best, lanes::sqrt(ex * ex + ey * ey + ez * ez) - ra - roundUpFloat(b.radius0));
  for (int i = 0; i < kIOS<S>::kCaps; ++i) {
    const Float4 wx = bx - a.cap_x[i], wy = by - a.cap_y[i], wz = bz - a.cap_z[i];
    best = lanes::max(best, lanes::sqrt(wx * wx + wy * wy + wz * wz) - rb - a.cap_r[i]);
  }
  const double scale = d.norm1 + a.reach + b.reach;
  return lanes::horizontalMax(best) -
         (error_bounds::laneError(scale) + detail::boundsOf(X).stretch * b.reach + d.pad);
}

/// The bound over all pairs in double at any scale, and the points that attain it.
struct ScaledBound {
  double value = -kInfinity;
  double P[3] = {}, Q[3] = {};  // relative to a's S0 centre, in A
};

// Scaled by a power of two so that the largest length is about 1: no overflow, and what underflows
// is below 2^-1000 of it. Roundings: as in offset(), in units of 2^-52 of lengths <= |d| + reach.
template <typename S, typename P>
ScaledBound scaledSeparation(const kIOS<S>& a, const kIOS<S>& b, const RelativePose<P>& X,
                             const Offset& d) {
  const double reach_a = std::max<double>(scaled(a.reach, a.exponent), a.radius0);
  const double reach_b = std::max<double>(scaled(b.reach, b.exponent), b.radius0);
  const double largest = std::max({d.norm1, reach_a, reach_b});
  if (!(largest > 0)) return ScaledBound{-d.pad, {}, {}};
  const int e = exponentOf(largest);

  Ball sa[kIOS<S>::kMaxSpheres], sb[kIOS<S>::kMaxSpheres];
  const int ka = toBalls(a, {0, 0, 0}, e, sa), kb = toBalls(b, {0, 0, 0}, e, sb);
  const double dx = scaled(d.x, -e), dy = scaled(d.y, -e), dz = scaled(d.z, -e);

  ScaledBound best;
  for (int j = 0; j < kb; ++j) {
    const double bx = X.R()(0, 0) * sb[j].x + X.R()(0, 1) * sb[j].y + X.R()(0, 2) * sb[j].z + dx;
    const double by = X.R()(1, 0) * sb[j].x + X.R()(1, 1) * sb[j].y + X.R()(1, 2) * sb[j].z + dy;
    const double bz = X.R()(2, 0) * sb[j].x + X.R()(2, 1) * sb[j].y + X.R()(2, 2) * sb[j].z + dz;
    for (int i = 0; i < ka; ++i) {
      const double w[3] = {bx - sa[i].x, by - sa[i].y, bz - sa[i].z};
      const double length = norm(w[0], w[1], w[2]);
      const double value = length - sa[i].r - sb[j].r;
      if (!(value > best.value)) continue;
      best.value = value;
      const double n[3] = {length > 0 ? w[0] / length : 1.0, length > 0 ? w[1] / length : 0.0,
                           length > 0 ? w[2] / length : 0.0};
      const double ca[3] = {sa[i].x, sa[i].y, sa[i].z}, cb[3] = {bx, by, bz};
      for (int c = 0; c < 3; ++c) {
        best.P[c] = ca[c] + sa[i].r * n[c];
        best.Q[c] = cb[c] - sb[j].r * n[c];
      }
    }
  }
  const double lengths = scaled(d.norm1 + reach_a + reach_b, -e);
  best.value -= error_bounds::sumError<double>(lengths) +
                detail::boundsOf(X).stretch * scaled(reach_b, -e) + 0x1p-960;
  best.value = std::nextafter(scaled(best.value, e) - d.pad, -kInfinity);
  for (int c = 0; c < 3; ++c) {
    best.P[c] = scaled(best.P[c], e);
    best.Q[c] = scaled(best.Q[c], e);
  }
  return best;
}

template <typename S, typename P>
[[gnu::hot]] double separationFrom(const kIOS<S>& a, const kIOS<S>& b, const RelativePose<P>& X,
                                   const Offset& d, double required) {
  constexpr double kFar = 0x1p40;
  if ((a.exponent | b.exponent) != 0 || !(d.norm1 < kFar)) {
    return scaledSeparation(a, b, X, d).value;
  }
  // S0 against S0. Squares below 2^-1022 lose at most 2^-510 of length.
  const double ra = a.radius0, rb = b.radius0;
  const double central =
      std::sqrt(d.x * d.x + d.y * d.y + d.z * d.z) - ra - rb - (d.pad + 0x1p-500);
  if (central > required || (a.num_spheres == 1 && b.num_spheres == 1)) return central;
  return std::max(central, capSeparation(a, b, X, d));
}

template <typename S>
S lowerBound(const kIOS<S>& a, const kIOS<S>& b, const RelativePose<S>& X, fcl::Vector3<S>* P,
             fcl::Vector3<S>* Q) {
  if (a.k() == 0 || b.k() == 0) return std::numeric_limits<S>::max();
  const Offset d = offset(a, b, X);
  if (!P && !Q) return roundDown<S>(std::max(0.0, separationFrom(a, b, X, d, kInfinity)));
  const ScaledBound bound = scaledSeparation(a, b, X, d);
  const S lower = roundDown<S>(std::max(0.0, bound.value));
  for (int c = 0; c < 3; ++c) {
    const double middle = 0.5 * (bound.P[c] + bound.Q[c]);
    if (P) (*P)[c] = roundedTo<S>(a.center0[c] + (lower > 0 ? bound.P[c] : middle));
    if (Q) (*Q)[c] = roundedTo<S>(a.center0[c] + (lower > 0 ? bound.Q[c] : middle));
  }
  return lower;
}

template <typename S>
const RelativePose<S>& identityPose() {
  static const RelativePose<S> identity(fcl::Matrix3<S>::Identity(), fcl::Vector3<S>::Zero());
  return identity;
}

[[noreturn]] void refuseTranslation(const char* what) {
  refuse("the ", what, " is NaN, infinite or too large to be bounded.");
}

}  // namespace

void refuseRotation(const char* what, double error, double allowed) {
  if (error <= allowed) {
    refuse("the ", what,
           " is not rigid: it is a reflection (det R < 0); mirror the vertices of the mesh "
           "instead.");
  }
  refuse("the ", what, " is not rigid: |R^T R - I| = ", error, ", at most ", allowed,
         " is allowed.");
}

template <typename S>
void requireRotations(const fcl::Transform3<S>& X_WA, const fcl::Transform3<S>& X_WB,
                      const lanes::Double2& squares) {
  const auto determinantOf = [](const fcl::Transform3<S>& X) {
    return determinant([&X](int i, int j) { return double{X.matrix()(i, j)}; });
  };
  requireRotation<S>(squares[0], determinantOf(X_WA), "first object's pose");
  requireRotation<S>(squares[1], determinantOf(X_WB), "second object's pose");
}

template <typename S>
void refuseTranslations(const fcl::Transform3<S>& X_WA, const fcl::Transform3<S>& X_WB) {
  const auto fits = [](const fcl::Transform3<S>& X) {
    return X.translation().template cast<double>().template lpNorm<1>() <= kMaxCoordinate<S>;
  };
  if (!fits(X_WA)) refuseTranslation("first object's translation");
  if (!fits(X_WB)) refuseTranslation("second object's translation");
  refuseTranslation("difference of the two objects' translations");
}

template <typename S>
RelativePose<S>::RelativePose(const fcl::Matrix3<S>& R_AB, const fcl::Vector3<S>& T_AB)
    : R_(R_AB), T_(T_AB) {
  const auto entries = [&](int i, int j) { return double{R_AB(i, j)}; };
  const double square = squaredRotationError(entries);
  requireRotation<S>(square, determinant(entries), "relative pose");
  computeBounds(square);
  if (!(bounds_.T_norm1 <= kMaxCoordinate<S>)) refuseTranslation("relative pose's translation");
}

template <typename S>
template <typename P>
RelativePose<S>::RelativePose(const fcl::Transform3<P>& X_WA, const fcl::Transform3<P>& X_WB)
    : RelativePose(X_WA, X_WB, squaredRotationErrors(X_WA, X_WB)) {}

template <typename S>
template <typename P>
[[gnu::hot]] RelativePose<S>::RelativePose(const fcl::Transform3<P>& X_WA,
                                           const fcl::Transform3<P>& X_WB, double squared_errors) {
  static_assert(sizeof(S) >= sizeof(P), "a pose is widened, never rounded");
  using Wide = S;
  const fcl::Matrix3<S> inverse = X_WA.linear().transpose().template cast<Wide>();
  for (int j = 0; j < 3; ++j) {
    R_.col(j) = detail::rotate<S>(inverse, X_WB.linear().col(j).template cast<Wide>());
  }
  // By the roundings of R^T R equal bodies at equal poses would miss each other. With I in its
  // place a coordinate of R x is off by the row of R^T R - I, 7 u |x| at most, and by no rounding:
  // by no more than any other. The u is the poses': docs/guarantees.md defines the frame so.
  if (X_WA.linear() == X_WB.linear() && R_ != fcl::Matrix3<S>::Identity() &&
      isRoundedRotation<P>(X_WA.linear())) {
    R_.setIdentity();
  }
  T_ = detail::rotate<S>(
      inverse, X_WB.translation().template cast<Wide>() - X_WA.translation().template cast<Wide>());
  computeBounds(squared_errors);
  if (!(bounds_.T_norm1 <= kMaxCoordinate<P>)) refuseTranslations(X_WA, X_WB);
}

template <typename S>
void RelativePose<S>::computeBounds(double squared_errors) {
  bounds_.T_norm1 = std::abs(double{T_[0]}) + std::abs(double{T_[1]}) + std::abs(double{T_[2]});
  bounds_.stretch = error_bounds::stretchOf<S>(squared_errors);
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) bounds_.R[i][j] = roundedTo<float>(R_(i, j));
  }
}

template <typename S, typename P>
[[gnu::hot]] double separation(const kIOS<S>& a, const kIOS<S>& b, const RelativePose<P>& X_AB,
                               double required) {
  if (a.num_spheres == 0 || b.num_spheres == 0) return kInfinity;
  return separationFrom(a, b, X_AB, offset(a, b, X_AB), required);
}

template <typename S>
bool overlap(const fcl::Matrix3<S>& R, const fcl::Vector3<S>& T, const kIOS<S>& a,
             const kIOS<S>& b) {
  return !(separation(a, b, RelativePose<S>(R, T), 0.0) > 0);
}

template <typename S>
bool overlap(const fcl::Transform3<S>& X_AB, const kIOS<S>& a, const kIOS<S>& b) {
  return overlap<S>(X_AB.linear(), X_AB.translation(), a, b);
}

template <typename S>
S distance(const fcl::Matrix3<S>& R, const fcl::Vector3<S>& T, const kIOS<S>& a, const kIOS<S>& b,
           fcl::Vector3<S>* P, fcl::Vector3<S>* Q) {
  return lowerBound(a, b, RelativePose<S>(R, T), P, Q);
}

template <typename S>
S distance(const fcl::Transform3<S>& X_AB, const kIOS<S>& a, const kIOS<S>& b, fcl::Vector3<S>* P,
           fcl::Vector3<S>* Q) {
  return distance<S>(X_AB.linear(), X_AB.translation(), a, b, P, Q);
}

template <typename S>
bool kIOS<S>::overlap(const kIOS& other) const {
  return !(separation(*this, other, identityPose<S>(), 0.0) > 0);
}

template <typename S>
bool kIOS<S>::overlap(const kIOS& other, kIOS& /*overlap_part*/) const {
  return overlap(other);
}

template <typename S>
S kIOS<S>::distance(const kIOS& other, fcl::Vector3<S>* P, fcl::Vector3<S>* Q) const {
  return lowerBound(*this, other, identityPose<S>(), P, Q);
}

#define KIOS_INSTANTIATE(S)                                                                        \
  template void requireRotations(const fcl::Transform3<S>&, const fcl::Transform3<S>&,             \
                                 const lanes::Double2&);                                           \
  template void refuseTranslations(const fcl::Transform3<S>&, const fcl::Transform3<S>&);          \
  template class RelativePose<S>;                                                                  \
  template double separation(const kIOS<S>&, const kIOS<S>&, const RelativePose<S>&, double);      \
  template bool overlap(const fcl::Matrix3<S>&, const fcl::Vector3<S>&, const kIOS<S>&,            \
                        const kIOS<S>&);                                                           \
  template bool overlap(const fcl::Transform3<S>&, const kIOS<S>&, const kIOS<S>&);                \
  template S distance(const fcl::Matrix3<S>&, const fcl::Vector3<S>&, const kIOS<S>&,              \
                      const kIOS<S>&, fcl::Vector3<S>*, fcl::Vector3<S>*);                         \
  template S distance(const fcl::Transform3<S>&, const kIOS<S>&, const kIOS<S>&, fcl::Vector3<S>*, \
                      fcl::Vector3<S>*);                                                           \
  template bool kIOS<S>::overlap(const kIOS<S>&) const;                                            \
  template bool kIOS<S>::overlap(const kIOS<S>&, kIOS<S>&) const;                                  \
  template S kIOS<S>::distance(const kIOS<S>&, fcl::Vector3<S>*, fcl::Vector3<S>*) const;
KIOS_INSTANTIATE(double)
KIOS_INSTANTIATE(float)
#undef KIOS_INSTANTIATE
#define KIOS_INSTANTIATE_POSE(S, P)                                                             \
  template RelativePose<S>::RelativePose(const fcl::Transform3<P>&, const fcl::Transform3<P>&); \
  template RelativePose<S>::RelativePose(const fcl::Transform3<P>&, const fcl::Transform3<P>&,  \
                                         double);
KIOS_INSTANTIATE_POSE(double, double)
KIOS_INSTANTIATE_POSE(double, float)
KIOS_INSTANTIATE_POSE(float, float)
#undef KIOS_INSTANTIATE_POSE
template double separation(const kIOSf&, const kIOSf&, const RelativePosed&, double);

}  // namespace kios
