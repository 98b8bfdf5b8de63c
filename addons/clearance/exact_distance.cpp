// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "fcl_kios/clearance.h"

#include <algorithm>
#include <cmath>

#include "clearance/nearest_pair.h"
#include "volume/error_bounds.h"
#include "volume/errors.h"
#include "volume/rounding.h"

namespace kios {
namespace {

fcl::Vector3d scaledBy(const fcl::Vector3d& v, int exponent) {
  return {scaled(v[0], exponent), scaled(v[1], exponent), scaled(v[2], exponent)};
}

/// Rounding of R c_b + T - c_a and of b's points on their way to A.
template <typename S>
double rounding(const kIOS<S>& a, const kIOS<S>& b, const RelativePose<S>& X) {
  const auto norm1 = [](const kIOS<S>& v) {
    return v.center0.template cast<double>().template lpNorm<1>();
  };
  return error_bounds::volumeError<S>(norm1(b), detail::boundsOf(X).T_norm1 + norm1(a), a.radius0,
                                      b.radius0);
}

}  // namespace

template <typename S>
ExactDistance exact::exactDistance(const kIOS<S>& a, const SphereIntersection& body_a,
                                   const kIOS<S>& b, const SphereIntersection& body_b,
                                   const RelativePose<S>& X) {
  const fcl::Matrix3d R = X.R().template cast<double>();
  const fcl::Vector3d center_a = a.center0.template cast<double>();
  const fcl::Vector3d arm = R * b.center0.template cast<double>();
  const fcl::Vector3d offset = (arm + X.T().template cast<double>()) - center_a;
  const NearestPair pair = nearestPair(body_a, body_b, R, offset);

  ExactDistance result;
  const double pad = rounding(a, b, X);
  result.distance =
      std::max({0.0, scaled(pair.lower, pair.exponent) - pad, separation(a, b, X, kInfinity)});
  result.error = std::max(0.0, scaled(pair.upper, pair.exponent) + pad - result.distance);
  result.p = center_a + scaledBy(pair.p, pair.exponent);
  result.q = center_a + scaledBy(pair.q, pair.exponent);
  if (!result.apart()) return result;
  result.normal = pair.normal;
  result.moment = (arm + scaledBy(pair.q_arm, pair.exponent)).cross(pair.normal);
  return result;
}

template <typename S>
ExactDistance exactDistance(const kIOS<S>& a, const kIOS<S>& b, const RelativePose<S>& X_AB) {
  if (a.k() == 0 || b.k() == 0) {
    ExactDistance result;
    result.distance = kInfinity;
    return result;
  }
  return exact::exactDistance(a, exact::SphereIntersection(a), b, exact::SphereIntersection(b),
                              X_AB);
}

template <typename S>
ExactDistance exactDistance(const kIOS<S>& a, const kIOS<S>& b) {
  static const RelativePose<S> identity(fcl::Matrix3<S>::Identity(), fcl::Vector3<S>::Zero());
  return exactDistance(a, b, identity);
}

template <typename S>
ExactDistance nearestPoint(const kIOS<S>& volume, const fcl::Vector3<S>& point) {
  for (int c = 0; c < 3; ++c) {
    if (!(std::abs(double{point[c]}) <= kMaxCoordinate<S>)) {
      refuse("a point is NaN, infinite or too large for its distance to be bounded.");
    }
  }
  kIOS<S> ball;
  ball += point;
  ExactDistance result = exactDistance(volume, ball);
  result.q = point.template cast<double>();
  if (!result.apart()) result.p = result.q;
  result.moment.setZero();
  return result;
}

#define KIOS_INSTANTIATE(S)                                                                     \
  template ExactDistance exact::exactDistance(const kIOS<S>&, const SphereIntersection&,        \
                                              const kIOS<S>&, const SphereIntersection&,        \
                                              const RelativePose<S>&);                          \
  template ExactDistance exactDistance(const kIOS<S>&, const kIOS<S>&, const RelativePose<S>&); \
  template ExactDistance exactDistance(const kIOS<S>&, const kIOS<S>&);                         \
  template ExactDistance nearestPoint(const kIOS<S>&, const fcl::Vector3<S>&);
KIOS_INSTANTIATE(double)
KIOS_INSTANTIATE(float)
#undef KIOS_INSTANTIATE

}  // namespace kios
