// SPDX-FileCopyrightText: 2026 The fcl_kios authors
// SPDX-License-Identifier: BSD-3-Clause
#include "scene/motion_bound.h"

#include <cmath>

#include "volume/instantiate.h"
#include "volume/rounding.h"

namespace kios::scene {
namespace {

// Covers the roundings below: at most 20, each 2^-53 of terms that are summed by their magnitudes.
constexpr double kRelative = 0x1p-48;
// Covers squares that underflow, which lose less than 2^-537 sqrt(9) each.
constexpr double kSubnormal = 0x1p-530;

}  // namespace

double Sphere::reach() const {
  return addUp(std::abs(center[0]) + std::abs(center[1]) + std::abs(center[2]), radius) *
         (1 + kRelative);
}

// y = c + v, |v| <= r: the displacement is M c + dT + M v with M = R1 - R0 and dT = T1 - T0.
// |M|_2^4 is the square of M^T M's largest eigenvalue, and so at most the sum of the squares of all
// three, which is the squared Frobenius norm of M^T M. For two rotations, where the eigenvalues are
// (s, s, 0), s = 4 sin^2(angle / 2), that is 2^(1/4) of |M|_2 = 2 sin(angle / 2) too much.
template <typename S>
double displacement(const fcl::Matrix3<S>& R0, const fcl::Vector3<S>& T0, const fcl::Matrix3<S>& R1,
                    const fcl::Vector3<S>& T1, const Sphere& sphere) {
  double M[3][3], w[3];
  double terms = 0, largest = 0;
  bool equal = true;
  for (int i = 0; i < 3; ++i) {
    const double dT = double{T1[i]} - double{T0[i]};
    equal = equal && dT == 0;
    w[i] = dT;
    terms += std::abs(dT);
    for (int j = 0; j < 3; ++j) {
      M[i][j] = double{R1(i, j)} - double{R0(i, j)};
      equal = equal && M[i][j] == 0;
      largest = std::fmax(largest, std::abs(M[i][j]));
      w[i] += M[i][j] * sphere.center[j];
      terms += std::abs(M[i][j] * sphere.center[j]);
    }
  }
  if (equal) return 0;
  if (!(terms < 0x1p500 && sphere.radius < 0x1p500 && largest < 0x1p100)) return kInfinity;

  double squares = 0;
  for (int i = 0; i < 3; ++i) {
    for (int j = i; j < 3; ++j) {
      const double dot = M[0][i] * M[0][j] + M[1][i] * M[1][j] + M[2][i] * M[2][j];
      squares += (i == j ? 1 : 2) * dot * dot;
    }
  }
  // The fourth root of sums that may have lost 2^-1074 of largest^4 and more to underflow.
  const double norm = std::sqrt(std::sqrt(squares)) + 0x1p-260;
  const double centre = std::sqrt(w[0] * w[0] + w[1] * w[1] + w[2] * w[2]);
  return (centre + std::fmin(norm, 3 * largest) * sphere.radius) * (1 + kRelative) +
         terms * kRelative + kSubnormal;
}

KIOS_INSTANTIATE_FUNCTION(displacement);

}  // namespace kios::scene
